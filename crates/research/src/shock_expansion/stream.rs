//! A uniform stream of a gas, and its changes at walls and in ducts.

use crate::gas::{Gas, GasError};
use ahv::air::Atmosphere;
use ahv::data::EarthData;

/// A gas with its specific gas constant.
#[derive(Debug, Clone, Copy)]
pub struct Medium {
    /// Ratio of specific heats.
    pub gas: Gas,
    /// Specific gas constant, J/(kg K).
    pub gas_constant: f64,
}

/// A uniform stream.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stream {
    /// Mach number.
    pub mach: f64,
    /// Pressure, Pa.
    pub pressure: f64,
    /// Temperature, K.
    pub temperature: f64,
}

impl Medium {
    /// Air of the data file.
    pub fn new(data: &EarthData) -> Self {
        Self {
            gas: Gas { gamma: data.air.heat_capacity_ratio.value },
            gas_constant: data.air.gas_constant_j_per_kg_k.value,
        }
    }

    /// The air ahead of a vehicle at a Mach number and a geometric altitude (m).
    pub fn ahead(&self, atmosphere: &Atmosphere, mach: f64, altitude: f64) -> Stream {
        let air = atmosphere.air(altitude);
        let pressure = air.density * self.gas_constant * air.temperature;
        Stream { mach, pressure, temperature: air.temperature }
    }

    /// Speed, m/s.
    pub fn speed(&self, stream: &Stream) -> f64 {
        stream.mach * (self.gas.gamma * self.gas_constant * stream.temperature).sqrt()
    }

    /// Mass flow per area, kg/(m^2 s).
    pub fn mass_flux(&self, stream: &Stream) -> f64 {
        stream.pressure / (self.gas_constant * stream.temperature) * self.speed(stream)
    }

    /// Momentum flow per area, Pa.
    pub fn momentum_flux(&self, stream: &Stream) -> f64 {
        2.0 * self.gas.dynamic_pressure(stream.mach) * stream.pressure
    }

    /// Specific heat at constant pressure, J/(kg K).
    pub fn heat_capacity(&self) -> f64 {
        self.gas_constant * self.gas.gamma / (self.gas.gamma - 1.0)
    }

    /// The stream isentropically at another Mach number.
    pub fn isentropic(&self, stream: &Stream, mach: f64) -> Stream {
        let gas = self.gas;
        Stream {
            mach,
            pressure: stream.pressure * gas.total_pressure(stream.mach) / gas.total_pressure(mach),
            temperature: stream.temperature * gas.total_temperature(stream.mach)
                / gas.total_temperature(mach),
        }
    }

    /// The stream turned isentropically by a wall that bends by a small angle into it (positive) or away.
    ///
    /// # Errors
    /// [`GasError::Expansion`] if the bend would bring it to the speed of sound or to vacuum.
    pub fn bent(&self, stream: &Stream, angle: f64) -> Result<Stream, GasError> {
        if angle == 0.0 {
            return Ok(*stream);
        }
        let before = self.gas.prandtl_meyer(stream.mach)?;
        Ok(self.isentropic(stream, self.gas.mach_from_prandtl_meyer(before - angle)?))
    }

    /// The stream behind a sharp corner: a shock if it turns into the stream (positive), else an expansion.
    ///
    /// # Errors
    /// [`GasError`] if the shock is detached or the corner too sharp.
    pub fn turned(&self, stream: &Stream, angle: f64) -> Result<Stream, GasError> {
        if angle <= 0.0 {
            return self.bent(stream, angle);
        }
        let jump = self.gas.oblique_shock(stream.mach, angle)?.jump;
        Ok(Stream {
            mach: jump.mach,
            pressure: stream.pressure * jump.pressure,
            temperature: stream.temperature * jump.temperature,
        })
    }

    /// The stream after an isentropic duct with area ratio `ratio`; it stays supersonic.
    ///
    /// # Errors
    /// [`GasError::Choked`] if the duct is narrower than the throat.
    pub fn through(&self, stream: &Stream, ratio: f64) -> Result<Stream, GasError> {
        let mach = self.gas.mach_from_area(self.gas.area(stream.mach) * ratio)?;
        Ok(self.isentropic(stream, mach))
    }

    /// The stream heated at constant area; `ratio` is that of stagnation temperatures.
    ///
    /// # Errors
    /// [`GasError::ThermallyChoked`] if the stream cannot take the heat.
    pub fn heated(&self, stream: &Stream, ratio: f64) -> Result<Stream, GasError> {
        let gas = self.gas;
        let mach = gas.heated(stream.mach, ratio)?;
        Ok(Stream {
            mach,
            pressure: stream.pressure * gas.rayleigh_pressure(mach)
                / gas.rayleigh_pressure(stream.mach),
            temperature: stream.temperature * ratio * gas.total_temperature(stream.mach)
                / gas.total_temperature(mach),
        })
    }
}
