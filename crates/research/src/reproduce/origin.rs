//! Origin of the printed digits: evidence for and against hypotheses.

use super::operating_point::{Gamma, OperatingPoint};
use super::roots::{Name, find};
use super::tables::{COLUMNS, real_zeros, short_period};
use crate::identify::size;
use crate::published::Published;
use ahv::data::{AeroData, AeroSet, Data};
use ahv::dynamics::linear::LinearModel;
use ahv::dynamics::trim::trim;
use ahv::structure::FLEXIBLE;
use ahv::vehicle::{Configuration, H, V, Vehicle, VehicleDefinition, VehicleOptions};
use anyhow::{Result, anyhow};
use nalgebra::{Complex, Matrix2, Vector2};
use serde::Serialize;

/// Inertia with which the published set gives the printed rigid column, kg m^2/m.
pub const INERTIA: f64 = 6.4e5;
/// Printed inertia, kg m^2/m.
const PRINTED_INERTIA: f64 = 2.224e5;
/// Factors on the derived elastic terms.
const ELASTIC: [f64; 5] = [1.0, 2.0, 5.0, 10.0, 20.0];
/// Mass centre aft of 55 ft, m.
const SHIFTS: [f64; 4] = [0.0, 1.0, 2.0, 3.0];
/// Changes that make the rigid zeros unequal: share of theta in the output, also used as lift due to q in the
/// gamma equation, s; pitch damping, 1/s.
pub const OUTPUT: f64 = 0.0044;
pub const PITCH_DAMPING: f64 = -1.79;

const CONFIGURATIONS: [Configuration; 3] =
    [Configuration::Rigid, Configuration::EvenMassBeam, Configuration::SloshBeam];

/// Real poles and zeros of one vehicle, rad/s.
#[derive(Debug, Clone, Serialize)]
pub struct Case {
    pub what: String,
    pub poles: [f64; 2],
    pub zeros: [f64; 2],
    /// Imaginary parts of the aeroelastic zeros.
    pub pairs: Vec<f64>,
}

impl Case {
    pub fn pole_product(&self) -> f64 {
        size(self.poles).powi(2)
    }

    pub fn zero_product(&self) -> f64 {
        size(self.zeros).powi(2)
    }

    fn of(what: impl Into<String>, point: &OperatingPoint) -> Result<Self> {
        let what = what.into();
        let none = || anyhow!("{what}: no real short period or no real zeros");
        let poles = short_period(&point.poles).ok_or_else(none)?;
        let zeros = real_zeros(&point.zeros).ok_or_else(none)?;
        let pair = |i| Some(find(&point.zeros, Name::Flexible(i))?.value.im);
        Ok(Self { poles, zeros, pairs: (0..FLEXIBLE).filter_map(pair).collect(), what })
    }

    /// Of a linear system without slosh and bending.
    fn rigid(what: &str, linear: &LinearModel) -> Result<Self> {
        let outer = |roots: Vec<Complex<f64>>| {
            let real = roots.iter().filter(|root| root.im == 0.0).map(|root| root.re);
            [real.clone().fold(0.0, f64::max), real.fold(0.0, f64::min)]
        };
        let (poles, zeros) = (outer(linear.poles()), outer(linear.zeros()));
        Ok(Self { what: what.into(), poles, zeros, pairs: Vec::new() })
    }
}

/// Inertia and mass centre of one column, from its poles and real zeros.
#[derive(Debug, Clone, Serialize)]
pub struct Asked {
    pub column: &'static str,
    pub inertia: f64,
    pub mass_centre_m: f64,
}

#[derive(Debug, Clone, Serialize)]
pub struct Origin {
    pub printed: [Case; 3],
    /// Published set with [`INERTIA`] and the mass centre at 55 ft.
    pub rigid: Case,
    pub inertias: Vec<Case>,
    pub printed_inertia: Vec<Case>,
    pub elastic: Vec<Case>,
    pub shifts: Vec<Case>,
    pub asked: Vec<Asked>,
    /// The even column of the default set, with gamma of the mean axes and of the body.
    pub gamma: [Case; 2],
    pub unequal: Vec<Case>,
    /// Coefficient of the lift due to q that gives the printed zeros.
    pub lift_q: f64,
}

struct Lab<'a> {
    data: &'a Data,
    base: VehicleOptions,
}

impl Lab<'_> {
    /// The published set with another inertia, elastic terms and mass centre.
    fn definition(
        &self,
        column: usize,
        inertia: f64,
        elastic: f64,
        shift: f64,
    ) -> VehicleDefinition {
        let mut set: AeroData = (*self.data.parker2007).clone();
        set.inertia.i_yy_kg_m2_per_m.value = inertia;
        set.reference.elastic_scale.value *= elastic;
        let mut options = VehicleOptions { configuration: CONFIGURATIONS[column], ..self.base };
        options.aero = AeroSet::Parker2007;
        options.factors.mass_centre_shift_m = shift;
        VehicleDefinition::with_coefficients(self.data, &options, &set)
    }

    fn point(
        &self,
        column: usize,
        inertia: f64,
        elastic: f64,
        shift: f64,
    ) -> Result<OperatingPoint> {
        OperatingPoint::of(self.definition(column, inertia, elastic, shift), Gamma::Printed)
    }

    /// Newton's method on the logarithms of both products.
    fn asked(&self, column: usize, printed: &Case) -> Result<Asked> {
        let wanted = Vector2::new(printed.pole_product(), printed.zero_product()).map(libm::log);
        let off = |at: Vector2<f64>| -> Result<Vector2<f64>> {
            let case = Case::of("", &self.point(column, libm::exp(at[0]), 1.0, at[1])?)?;
            Ok(Vector2::new(case.pole_product(), case.zero_product()).map(libm::log) - wanted)
        };
        let mut at = Vector2::new(libm::log(INERTIA), if column == 0 { 0.0 } else { 2.0 });
        for _ in 0..8 {
            let here = off(at)?;
            let step = 1e-4;
            let slope = |i: usize| -> Result<Vector2<f64>> {
                let mut beside = at;
                beside[i] += step;
                Ok((off(beside)? - here) / step)
            };
            let jacobian = Matrix2::from_columns(&[slope(0)?, slope(1)?]);
            at -= jacobian.lu().solve(&here).ok_or_else(|| anyhow!("no inertia found"))?;
        }
        let definition = self.definition(column, libm::exp(at[0]), 1.0, at[1]);
        let (beam, oscillators) = definition.structure()?;
        let mass_centre_m = beam.mass_properties(&oscillators).centre_m;
        Ok(Asked { column: COLUMNS[column], inertia: libm::exp(at[0]), mass_centre_m })
    }
}

fn printed(published: &Published) -> [Case; 3] {
    let Published { table2, table3, .. } = published;
    std::array::from_fn(|i| {
        let [right, left, _] = table3.all()[i].real;
        Case {
            what: COLUMNS[i].into(),
            poles: table2.all()[i].short_term,
            zeros: [right, left],
            pairs: table3.all()[i].aeroelastic.iter().map(|pair| pair[1]).collect(),
        }
    })
}

/// gamma' = k q as a coefficient: k = C_Lq (cbar/2V) qbar S/(m V).
fn lift_coefficient(vehicle: &Vehicle, set: &AeroData, state: [f64; 2], k: f64) -> f64 {
    let [speed, height] = state;
    let pressure = 0.5 * vehicle.atmosphere.air(height).density * speed * speed;
    let area = set.reference.area_m2_per_m.value;
    let time = 0.5 * set.reference.chord_m.value / speed;
    k * vehicle.airframe.mass * speed / (pressure * area * time)
}

impl Origin {
    pub fn new(data: &Data, base: &VehicleOptions, published: &Published) -> Result<Self> {
        let lab = Lab { data, base: *base };
        let printed = printed(published);
        let own = data.parker2007.inertia.i_yy_kg_m2_per_m.value;
        let kg = |inertia: f64| {
            let written = format!("{inertia:.3e} kg m²/m");
            written.replace("e5", "·10⁵").replace("e6", "·10⁶")
        };
        let rigid = lab.point(0, INERTIA, 1.0, 0.0)?;
        let at_inertia = |inertia: f64| Case::of(kg(inertia), &lab.point(0, inertia, 1.0, 0.0)?);
        let with_printed = |column: usize| {
            Case::of(COLUMNS[column], &lab.point(column, PRINTED_INERTIA, 1.0, 0.0)?)
        };
        let elastic =
            |scale: f64| Case::of(format!("× {scale}"), &lab.point(1, INERTIA, scale, 0.0)?);
        let shift =
            |shift: f64| Case::of(format!("{shift} m"), &lab.point(1, INERTIA, 1.0, shift)?);
        let even = VehicleOptions { configuration: Configuration::EvenMassBeam, ..*base };
        let seen = |what: &str, gamma| {
            Case::of(what, &OperatingPoint::of(VehicleDefinition::new(data, &even), gamma)?)
        };

        let trim = trim(&rigid.vehicle, &base.condition)?;
        let system = &rigid.linear;
        let mut output = system.clone();
        output.c[(1, 2)] -= OUTPUT;
        output.c[(1, 3)] -= OUTPUT;
        let mut lift = system.clone();
        lift.a[(2, 4)] -= OUTPUT;
        lift.a[(3, 4)] += OUTPUT;
        let mut damped = system.clone();
        damped.a[(4, 4)] += PITCH_DAMPING;
        let lift_q = lift_coefficient(
            &rigid.vehicle,
            &data.parker2007,
            [trim.state[V], trim.state[H]],
            -OUTPUT,
        );
        Ok(Self {
            rigid: Case::of(format!("published set, {}, 55 ft", kg(INERTIA)), &rigid)?,
            inertias: [own, INERTIA, PRINTED_INERTIA]
                .into_iter()
                .map(at_inertia)
                .collect::<Result<_>>()?,
            printed_inertia: (0..3).map(with_printed).collect::<Result<_>>()?,
            elastic: ELASTIC.into_iter().map(elastic).collect::<Result<_>>()?,
            shifts: SHIFTS.into_iter().map(shift).collect::<Result<_>>()?,
            asked: (0..3).map(|i| lab.asked(i, &printed[i])).collect::<Result<_>>()?,
            gamma: [seen("mean axes", Gamma::MeanAxes)?, seen("the body", Gamma::Printed)?],
            unequal: vec![
                Case::rigid("eqs (3)-(4)", system)?,
                Case::rigid("output γ − 0.0044 θ", &output)?,
                Case::rigid("lift due to q", &lift)?,
                Case::rigid("pitch damping", &damped)?,
            ],
            lift_q,
            printed,
        })
    }
}
