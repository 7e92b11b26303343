//! US Standard Atmosphere 1976 and the gravity of a round, non-rotating earth.

use crate::params::EarthData;
use crate::scalar::Scalar;

#[derive(Debug, Clone, Copy)]
struct Layer {
    base_m: f64,
    lapse_k_per_m: f64,
    temperature_k: f64,
    pressure_pa: f64,
    /// g0/(R L), or g0/(R T_b) in a layer of constant temperature.
    exponent: f64,
}

/// Air and gravity as functions of the geometric altitude.
#[derive(Debug, Clone, Copy)]
pub struct Atmosphere {
    layers: [Layer; MAX_LAYERS],
    count: usize,
    top_m: f64,
    gas_constant: f64,
    heat_capacity_ratio: f64,
    gravity: f64,
    radius: f64,
}

/// The standard has seven layers below 84.852 km.
pub const MAX_LAYERS: usize = 8;

/// Air at one altitude.
#[derive(Debug, Clone, Copy)]
pub struct Air<S> {
    /// Density, kg/m^3.
    pub density: S,
    /// Temperature, K.
    pub temperature: S,
    /// Speed of sound, m/s.
    pub sound_speed: S,
}

impl Atmosphere {
    /// Pressures and temperatures of the layers' bases by recursion from sea level
    /// (US Standard Atmosphere 1976, eqs. 23, 33a and 33b).
    pub fn new(data: &EarthData) -> Self {
        let (air, gravity) = (&data.air, data.earth.gravity_m_per_s2.value);
        let gas_constant = air.gas_constant_j_per_kg_k.value;
        let mut atmosphere = Self {
            layers: [Layer {
                base_m: 0.0,
                lapse_k_per_m: 0.0,
                temperature_k: air.sea_level_temperature_k.value,
                pressure_pa: air.sea_level_pressure_pa.value,
                exponent: 0.0,
            }; MAX_LAYERS],
            count: 0,
            top_m: air.top_m.value,
            gas_constant,
            heat_capacity_ratio: air.heat_capacity_ratio.value,
            gravity,
            radius: data.earth.radius_m.value,
        };
        let steps = air.layer_base_m.value.iter().zip(&air.layer_lapse_k_per_m.value);
        for (i, (&base_m, &lapse_k_per_m)) in steps.enumerate().take(MAX_LAYERS) {
            let (temperature_k, pressure_pa) = match i {
                0 => (air.sea_level_temperature_k.value, air.sea_level_pressure_pa.value),
                _ => {
                    let below = &atmosphere.layers[i - 1];
                    let height = base_m - below.base_m;
                    let temperature = below.temperature(height);
                    (temperature, below.pressure(height, temperature))
                }
            };
            let per_kelvin = if lapse_k_per_m == 0.0 { temperature_k } else { lapse_k_per_m };
            atmosphere.layers[i] = Layer {
                base_m,
                lapse_k_per_m,
                temperature_k,
                pressure_pa,
                exponent: gravity / (gas_constant * per_kelvin),
            };
            atmosphere.count = i + 1;
        }
        atmosphere
    }

    /// Air at the geometric altitude `h` (m). Below sea level and above the last layer the nearest
    /// edge is taken: an integrator may look there, a flight never gets there.
    #[inline]
    pub fn air<S: Scalar>(&self, h: S) -> Air<S> {
        let (layer, height) = self.layer(h);
        let temperature = layer.temperature(height);
        let density = layer.pressure(height, temperature) / (temperature * self.gas_constant);
        Air { density, temperature, sound_speed: self.sound_speed_at(temperature) }
    }

    /// Speed of sound, m/s, without the rest of [`Atmosphere::air`].
    pub fn sound_speed<S: Scalar>(&self, h: S) -> S {
        let (layer, height) = self.layer(h);
        self.sound_speed_at(layer.temperature(height))
    }

    #[inline]
    fn sound_speed_at<S: Scalar>(&self, temperature: S) -> S {
        (temperature * (self.heat_capacity_ratio * self.gas_constant)).sqrt()
    }

    /// The layer at a geometric altitude, and the geopotential height above its base, m.
    #[inline]
    fn layer<S: Scalar>(&self, h: S) -> (&Layer, S) {
        let geopotential = h * self.radius / (h + self.radius);
        let clamped = match geopotential.value() {
            value if value > self.top_m => S::constant(self.top_m),
            value if value >= 0.0 => geopotential,
            _ => S::constant(0.0),
        };
        let above = self.layers[1..self.count].iter();
        let below = above.take_while(|layer| layer.base_m <= clamped.value()).count();
        let layer = &self.layers[below];
        (layer, clamped - layer.base_m)
    }

    /// g = g0 (R/(R+h))^2, m/s^2, and the distance R+h from the earth's centre, m.
    #[inline]
    pub fn gravity<S: Scalar>(&self, h: S) -> (S, S) {
        let distance = h + self.radius;
        let ratio = S::constant(self.radius) / distance;
        (ratio * ratio * self.gravity, distance)
    }

    /// Gravity at sea level, m/s^2.
    pub fn sea_level_gravity(&self) -> f64 {
        self.gravity
    }
}

impl Layer {
    /// Temperature, K, at a geopotential height above the base, m.
    #[inline]
    fn temperature<S: Scalar>(&self, height: S) -> S {
        height * self.lapse_k_per_m + self.temperature_k
    }

    /// Pressure, Pa, at a geopotential height above the base, m.
    #[inline]
    fn pressure<S: Scalar>(&self, height: S, temperature: S) -> S {
        // exp and ln instead of a power: half the work, and the logarithm is small within a layer.
        let fall = if self.lapse_k_per_m == 0.0 {
            height
        } else {
            (temperature * (1.0 / self.temperature_k)).ln()
        };
        (fall * -self.exponent).exp() * self.pressure_pa
    }
}
