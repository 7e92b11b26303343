//! The sensor.

ahv_wasm::component!(ahv_sensor::Sensor);
