//! US Standard Atmosphere 1976 and the gravity of a spherical, non-rotating earth.
//!
//! In a layer with temperature `T = T_m + L z`, z the geopotential height above its middle, hydrostatic
//! equilibrium and the gas law give
//!
//! ```text
//! T rho' = -(g0/R + L) rho                                  closed form: eqs 33a and 33b of the standard
//! T_m (n+1) c_(n+1) = -(g0/R + L + n L) c_n                 Taylor series rho = sum_n c_n z^n
//! ```
//!
//! The series costs half as much as an exponential and a logarithm, and needs no special case for L = 0.

use crate::data::{EarthData, MAX_LAYERS};
use crate::solve::Scalar;

/// Terms of the series, in pairs: full double precision in every layer of the standard; that from 32 to
/// 47 km needs the most.
const PAIRS: usize = 12;

#[derive(Debug, Clone, Copy, Default)]
struct Layer {
    middle_m: f64,
    lapse_k_per_m: f64,
    /// T_m.
    temperature_k: f64,
    /// g0/R + L, K/m.
    fall_k_per_m: f64,
    /// c_n in kg/m^3 and m, as pairs of an even and an odd power.
    density: [[f64; 2]; PAIRS],
}

/// Air and gravity as functions of the geometric altitude.
#[derive(Debug, Clone, Copy)]
pub struct Atmosphere {
    layers: [Layer; MAX_LAYERS],
    /// Lower edges of the layers above the first, m; infinite where there is no layer.
    edges_m: [f64; MAX_LAYERS - 1],
    top_m: f64,
    gas_constant: f64,
    heat_capacity_ratio: f64,
    gravity: f64,
    radius: f64,
}

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
    /// The layers from sea level upwards (US Standard Atmosphere 1976, eqs 23, 33a, 33b).
    pub fn new(data: &EarthData) -> Self {
        let (air, gravity) = (&data.air, data.earth.gravity_m_per_s2.value);
        let gas_constant = air.gas_constant_j_per_kg_k.value;
        let (bases, top_m) = (&air.layer_base_m.value, air.top_m.value);
        let edges = bases.iter().zip(bases.iter().skip(1).chain([&top_m]));

        let mut temperature = air.sea_level_temperature_k.value;
        let mut density = air.sea_level_pressure_pa.value / (gas_constant * temperature);
        let mut layers = [Layer::default(); MAX_LAYERS];
        let steps = edges.zip(&air.layer_lapse_k_per_m.value);
        for (layer, ((&base, &top), &lapse)) in layers.iter_mut().zip(steps) {
            *layer = Layer::new([base, top], [temperature, density], lapse, gravity / gas_constant);
            (temperature, density) =
                (layer.temperature(top - layer.middle_m), layer.density(top - layer.middle_m));
        }
        Self {
            layers,
            edges_m: std::array::from_fn(|i| bases.get(i + 1).copied().unwrap_or(f64::INFINITY)),
            top_m,
            gas_constant,
            heat_capacity_ratio: air.heat_capacity_ratio.value,
            gravity,
            radius: data.earth.radius_m.value,
        }
    }

    /// Air at the geometric altitude `h` (m); outside the layers that of the nearest edge, which only trial
    /// states of an integrator reach.
    // Inlining would load the series early and spill it across the next call.
    #[inline(never)]
    pub fn air<S: Scalar>(&self, h: S) -> Air<S> {
        let (layer, height) = self.layer(h);
        let (density, temperature) = (layer.density(height), layer.temperature(height));
        Air { density, temperature, sound_speed: self.sound_speed_at(temperature) }
    }

    /// Speed of sound alone, m/s.
    pub fn sound_speed<S: Scalar>(&self, h: S) -> S {
        let (layer, height) = self.layer(h);
        self.sound_speed_at(layer.temperature(height))
    }

    #[inline]
    fn sound_speed_at<S: Scalar>(&self, temperature: S) -> S {
        (temperature * (self.heat_capacity_ratio * self.gas_constant)).sqrt()
    }

    /// The layer at a geometric altitude, and the geopotential height above its middle, m.
    #[inline]
    fn layer<S: Scalar>(&self, h: S) -> (&Layer, S) {
        let geopotential = h * self.radius / (h + self.radius);
        let clamped = match geopotential.value() {
            value if value > self.top_m => S::constant(self.top_m),
            value if value >= 0.0 => geopotential,
            _ => S::constant(0.0),
        };
        let below = self.edges_m.iter().take_while(|edge| **edge <= clamped.value()).count();
        let layer = &self.layers[below];
        (layer, clamped - layer.middle_m)
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
    /// A layer between two edges, m, with temperature, K, and density, kg/m^3, at the lower edge.
    fn new(
        [base_m, top_m]: [f64; 2],
        [temperature, density]: [f64; 2],
        lapse_k_per_m: f64,
        gravity_over_gas_constant: f64,
    ) -> Self {
        let middle_m = 0.5 * (base_m + top_m);
        let temperature_k = temperature + lapse_k_per_m * (middle_m - base_m);
        let fall_k_per_m = gravity_over_gas_constant + lapse_k_per_m;
        let mut series = [[0.0; 2]; PAIRS];
        let mut term = 1.0;
        for (n, coefficient) in series.as_flattened_mut().iter_mut().enumerate() {
            *coefficient = term;
            let n = n as f64;
            term *= -(fall_k_per_m + n * lapse_k_per_m) / (temperature_k * (n + 1.0));
        }
        let mut layer =
            Self { middle_m, lapse_k_per_m, temperature_k, fall_k_per_m, density: series };
        let scale = density / layer.density(base_m - middle_m);
        layer.density = series.map(|pair| pair.map(|coefficient| coefficient * scale));
        layer
    }

    /// Temperature, K, at a geopotential height above the middle, m.
    #[inline]
    fn temperature<S: Scalar>(&self, height: S) -> S {
        height * self.lapse_k_per_m + self.temperature_k
    }

    /// Density, kg/m^3, at a geopotential height above the middle, m.
    #[inline]
    fn density<S: Scalar>(&self, height: S) -> S {
        let z = height.value();
        let pairs = self.density.iter().rev().copied();
        let sum = pairs.reduce(|[even, odd], [c, d]| [even * (z * z) + c, odd * (z * z) + d]);
        let [even, odd] = sum.unwrap_or_default();
        let density = even + odd * z;
        height.chain(density, -self.fall_k_per_m / self.temperature(z) * density)
    }
}
