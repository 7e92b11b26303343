//! The actuator.

ahv_wasm::component!(ahv_actuator::Actuator);
