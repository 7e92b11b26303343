//! The vehicle.

ahv_wasm::component!(ahv::flight::Setup);
