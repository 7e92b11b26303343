//! The autopilot.

ahv_wasm::component!(ahv_autopilot::Autopilot);
