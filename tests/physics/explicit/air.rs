//! Air and its forces on the body, in complex numbers: derivatives by complex steps.

use super::books::{Total, Wanted};
use ahv::data::{AeroData, AirData, EarthData, PolynomialData, Quantity, VehicleData};
use ahv::vehicle::Condition;
use nalgebra::Complex;

pub type C = Complex<f64>;

pub fn real(value: f64) -> C {
    C::new(value, 0.0)
}

/// First order in the imaginary part, which is all that a complex step needs; a sum of complex logarithms
/// loses it.
pub fn atan(z: C) -> C {
    C::new(z.re.atan(), z.im / (1.0 + z.re * z.re))
}

/// Temperature, K, and density, kg/m^3, at an altitude, m (US Standard Atmosphere 1976, eqs 23, 33).
pub fn atmosphere(air: &AirData, radius: f64, gravity: f64, altitude: C) -> [C; 2] {
    let height = altitude * radius / (altitude + radius);
    let per_kelvin = gravity / air.gas_constant_j_per_kg_k.value;
    let mut temperature = real(air.sea_level_temperature_k.value);
    let mut pressure = real(air.sea_level_pressure_pa.value);
    let (bases, lapses) = (&air.layer_base_m.value, &air.layer_lapse_k_per_m.value);
    for (i, (&base, &lapse)) in bases.iter().zip(lapses).enumerate() {
        let top = bases.get(i + 1).copied().unwrap_or(air.top_m.value);
        if base > height.re {
            break;
        }
        let climb = if height.re < top { height - base } else { real(top - base) };
        let next = temperature + climb * lapse;
        pressure *= if lapse == 0.0 {
            (-climb * per_kelvin / temperature).exp()
        } else {
            (temperature / next).powf(per_kelvin / lapse)
        };
        temperature = next;
    }
    [temperature, pressure / (temperature * air.gas_constant_j_per_kg_k.value)]
}

/// Speed, m/s, and gravity less the centrifugal part across the path, m/s^2.
pub fn speed_and_gravity(data: &EarthData, condition: &Condition) -> [f64; 2] {
    let (air, radius) = (&data.air, data.earth.radius_m.value);
    let sea_level = data.earth.gravity_m_per_s2.value;
    let [temperature, _] = atmosphere(air, radius, sea_level, real(condition.altitude));
    let gas = air.heat_capacity_ratio.value * air.gas_constant_j_per_kg_k.value;
    let speed = condition.mach * (gas * temperature.re).sqrt();
    let distance = radius + condition.altitude;
    let gravity = sea_level * (radius / distance).powi(2);
    [speed, (gravity - speed * speed / distance) * condition.gamma.cos()]
}

fn of(entry: &Option<Quantity>) -> f64 {
    entry.as_ref().map_or(0.0, |quantity| quantity.value)
}

pub fn fit(p: &PolynomialData, a: C, d: C) -> C {
    a * of(&p.alpha)
        + a * a * of(&p.alpha2)
        + a * a * a * of(&p.alpha3)
        + d * of(&p.delta_e)
        + d * d * of(&p.delta_e2)
        + d * d * d * of(&p.delta_e3)
        + a * d * of(&p.alpha_delta_e)
        + of(&p.constant)
}

pub fn fit_phi(p: &Option<PolynomialData>, a: C) -> C {
    p.as_ref().map_or(real(0.0), |p| fit(p, a, real(0.0)))
}

/// A part of the vehicle on which lift acts, evenly from one station to another, m from the nose.
#[derive(Debug, Clone, Copy)]
pub struct Surface {
    pub from: f64,
    pub to: f64,
    /// Lift coefficient by powers of the incidence.
    pub load: [f64; 3],
    /// Its slope where the elastic derivatives are taken.
    pub slope: f64,
}

/// Two uniform strips, cut at the end of the fore-body, that have the lift and the moment of the body
/// without its elevator at every incidence; and the elevator, where its lift and moment put it.
pub fn surfaces(data: &VehicleData, set: &AeroData) -> [Surface; 3] {
    let reference = &set.reference;
    let (about, chord) = (reference.moment_centre_m.value, reference.chord_m.value);
    let at = of(&reference.elastic_delta_e_rad);
    let elevator = |p: &PolynomialData| of(&p.delta_e) + 3.0 * of(&p.delta_e3) * at * at;
    let [lift_e, moment_e] = [elevator(&set.lift), elevator(&set.moment)];
    let powers = |p: &PolynomialData, elevator: f64| {
        [of(&p.constant), of(&p.alpha) - elevator, of(&p.alpha2)]
    };
    let (lift, moment) = (powers(&set.lift, lift_e), powers(&set.moment, moment_e));

    let (cut, end) = (data.geometry.fore_body_m.value, data.geometry.length_m.value);
    let [x1, x2] = [0.5 * cut, 0.5 * (cut + end)].map(|x| x - about);
    // Lift f of the fore strip: f + g = lift, -(x1 f + x2 g) = moment.
    let fore = [0, 1, 2].map(|k| (chord * moment[k] + x2 * lift[k]) / (x2 - x1));
    let aft = [0, 1, 2].map(|k| lift[k] - fore[k]);
    let place = about - chord * moment_e / lift_e;
    let all = [(0.0, cut, fore), (cut, end, aft), (place, place, [0.0, lift_e, 0.0])];
    all.map(|(from, to, load)| {
        let slope = load[1] + 2.0 * load[2] * reference.elastic_alpha_rad.value;
        Surface { from, to, load, slope }
    })
}

/// What pitching does: coefficients per q/V, m.
#[derive(Debug, Clone, Copy)]
struct Pitching {
    lift: f64,
    drag: f64,
    moment: f64,
    /// Incidence of the engine's inflow.
    inflow: f64,
}

fn pitching(data: &VehicleData, set: &AeroData, centre: f64) -> Pitching {
    let reference = &set.reference;
    let (about, chord) = (reference.moment_centre_m.value, reference.chord_m.value);
    let inflow = 0.5 * data.geometry.fore_body_m.value - centre;
    let mut pitching = Pitching { lift: 0.0, drag: 0.0, moment: 0.0, inflow };
    for Surface { from, to, slope, .. } in surfaces(data, set) {
        let (middle, spread) = (0.5 * (from + to), (to - from) * (to - from) / 12.0);
        pitching.lift += slope * (middle - centre);
        // Mean of (x - about)(x - centre).
        let second = (middle - about) * (middle - centre) + spread;
        pitching.moment -= slope * second / chord;
    }
    let at = reference.elastic_alpha_rad.value;
    let slope = |p: &PolynomialData| {
        let of_elevator = of(&p.alpha_delta_e) * of(&reference.elastic_delta_e_rad);
        of(&p.alpha) + 2.0 * of(&p.alpha2) * at + 3.0 * of(&p.alpha3) * at * at + of_elevator
    };
    pitching.drag = pitching.lift * slope(&set.drag) / slope(&set.lift);
    pitching
}

/// Motion of the body through the air.
#[derive(Debug, Clone, Copy)]
pub struct Met {
    pub altitude: C,
    pub speed: C,
    /// Incidence of the body.
    pub alpha: C,
    /// Pitch rate of the body, rad/s.
    pub q: C,
}

/// Forces, N/m, and moments, N, nose up.
pub struct Force {
    pub lift: C,
    pub drag: C,
    pub thrust: C,
    /// Of the air about the moment centre, and of the thrust.
    pub couple: C,
}

/// The air around one vehicle.
pub struct Air<'a> {
    set: &'a AeroData,
    air: &'a AirData,
    radius: f64,
    gravity: f64,
    pitching: Pitching,
    part: f64,
    centre: f64,
}

impl<'a> Air<'a> {
    pub fn new(
        data: &VehicleData,
        set: &'a AeroData,
        earth: &'a EarthData,
        total: &Total,
        wanted: &Wanted,
    ) -> Self {
        Self {
            set,
            air: &earth.air,
            radius: earth.earth.radius_m.value,
            gravity: earth.earth.gravity_m_per_s2.value,
            pitching: pitching(data, set, total.centre),
            part: wanted.pitch_rate,
            centre: total.centre,
        }
    }

    pub fn force(&self, met: &Met, [delta_e, phi]: [C; 2]) -> Force {
        let Met { altitude, speed, alpha, q } = *met;
        let (set, reference) = (self.set, &self.set.reference);
        let [_, density] = atmosphere(self.air, self.radius, self.gravity, altitude);
        let pressure = density * speed * speed * 0.5 * reference.area_m2_per_m.value;
        let turn = q / speed * self.part;
        let c_l = fit(&set.lift, alpha, delta_e)
            + phi * fit_phi(&set.lift_phi, alpha)
            + turn * self.pitching.lift;
        let c_d = fit(&set.drag, alpha, delta_e)
            + phi * fit_phi(&set.drag_phi, alpha)
            + turn * self.pitching.drag;
        let c_m = fit(&set.moment, alpha, delta_e)
            + phi * fit_phi(&set.moment_phi, alpha)
            + turn * self.pitching.moment;
        let inflow = alpha + turn * self.pitching.inflow;
        let none = real(0.0);
        let c_t = fit(&set.thrust, inflow, none) + phi * fit(&set.thrust_phi, inflow, none);
        let couple = c_m * reference.chord_m.value + c_t * reference.thrust_arm_m.value;
        Force {
            lift: pressure * c_l,
            drag: pressure * c_d,
            thrust: pressure * c_t,
            couple: pressure * couple,
        }
    }

    /// How far the mass centre is behind the moment centre, m.
    pub fn arm(&self) -> f64 {
        self.centre - self.set.reference.moment_centre_m.value
    }
}
