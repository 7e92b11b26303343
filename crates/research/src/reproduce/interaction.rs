//! Effect of the sloshing liquid on flexible modes, short period and zeros.

use super::operating_point::OperatingPoint;
use super::roots::{Name, Root, find};
use super::sweep::Sweep;
use super::tables::COLUMNS;
use ahv::data::Data;
use ahv::vehicle::{Configuration, VehicleOptions};
use anyhow::Result;
use serde::Serialize;

/// Sloshing frequencies, rad/s, at which zeros are quoted.
const QUOTED: [f64; 5] = [2.0, 5.0, 10.0, 20.0, 30.0];
/// Name of the vehicle with empty tanks.
pub const EMPTY: &str = "sloshing mass, empty tanks";
/// Sloshing frequency at which the first flexible mode and the liquid share their energy, rad/s.
pub const HYBRID: f64 = 20.0;

/// A pole or zero with and without the two slosh modes in the equations of motion.
#[derive(Debug, Clone, Serialize)]
pub struct Dropped {
    pub name: Name,
    pub kind: &'static str,
    pub kept: [f64; 2],
    /// `None` for those of the slosh modes.
    pub dropped: Option<[f64; 2]>,
    /// Distance between the two over the frequency.
    pub moved: Option<f64>,
}

/// The same vehicle with 15 and with 11 states.
#[derive(Debug, Clone, Serialize)]
pub struct Order {
    pub title: String,
    pub roots: Vec<Dropped>,
}

/// The real pair of zeros.
#[derive(Debug, Clone, Serialize)]
pub struct RealZeros {
    pub of: String,
    pub right: f64,
    pub left: f64,
    /// right + left: 0 for a symmetric pair.
    pub sum: f64,
}

/// Limits on a feedback loop by unstable pole and right-half-plane zero.
#[derive(Debug, Clone, Serialize)]
pub struct Limit {
    pub of: &'static str,
    pub pole: f64,
    pub zero: f64,
    /// Of the first aeroelastic pole, rad/s; none for a rigid body.
    pub flexible: Option<f64>,
    /// (z + p)/(z - p): least peak of the sensitivity of a single loop with both.
    pub peak: f64,
}

/// Distance of a pole from its zero, which determines how much a loop on V and gamma affects the mode.
#[derive(Debug, Clone, Serialize)]
pub struct Dipole {
    pub name: Name,
    pub pole: [f64; 2],
    pub zero: [f64; 2],
    /// Distance over the frequency of the pole.
    pub apart: f64,
}

#[derive(Debug, Clone, Serialize)]
pub struct Interaction {
    pub orders: [Order; 2],
    pub zeros: Vec<RealZeros>,
    pub limits: Vec<Limit>,
    pub dipoles: Vec<Dipole>,
    /// Sloshing part of the elastic energy in the unstable short-period motion, and elastic part of
    /// all of its energy.
    pub short_period_slosh: f64,
    pub short_period_elastic: f64,
    /// Sloshing part of the energy in the first flexible pole, half fuel, at [`HYBRID`].
    pub hybrid_share: f64,
    /// Damping ratio of the first flexible pole, at 2 and at [`HYBRID`] rad/s, half fuel.
    pub hybrid_damping: [f64; 2],
}

fn pair(root: &Root) -> [f64; 2] {
    [root.value.re, root.value.im]
}

fn order(title: String, point: &OperatingPoint) -> Order {
    let [poles, zeros] = point.without_slosh();
    let mut roots = Vec::new();
    for (kind, kept, dropped) in [("pole", &point.poles, poles), ("zero", &point.zeros, zeros)] {
        for root in kept {
            let Some(name) = root.name else { continue };
            let other = find(&dropped, name);
            let size = root.frequency();
            roots.push(Dropped {
                name,
                kind,
                kept: pair(root),
                dropped: other.map(pair),
                moved: other
                    .filter(|_| size > 1e-6)
                    .map(|other| (other.value - root.value).norm() / size),
            });
        }
    }
    Order { title, roots }
}

fn real_zeros(of: String, zeros: &[Root]) -> Option<RealZeros> {
    let value = |name| find(zeros, name).filter(|z| z.value.im == 0.0).map(|z| z.value.re);
    let (right, left) = (value(Name::RightZero)?, value(Name::LeftZero)?);
    Some(RealZeros { of, right, left, sum: right + left })
}

fn limit(of: &'static str, point: &OperatingPoint) -> Option<Limit> {
    let pole = find(&point.poles, Name::UnstableShortPeriod)?.value.re;
    let zero = find(&point.zeros, Name::RightZero)?.value.re;
    let flexible = find(&point.poles, Name::Flexible(0)).map(Root::frequency);
    Some(Limit { of, pole, zero, flexible, peak: (zero + pole) / (zero - pole).abs() })
}

impl Interaction {
    pub fn new(
        data: &Data,
        base: &VehicleOptions,
        points: &[OperatingPoint; 3],
        frequency: &Sweep,
    ) -> Result<Self> {
        let slosh = &points[2];
        let hybrid = OperatingPoint::new(
            data,
            &VehicleOptions {
                configuration: Configuration::SloshBeam,
                fuel_fraction: 0.5,
                slosh_frequency: HYBRID,
                ..*base
            },
        )?;
        let orders = [
            order("full tanks, their own sloshing frequency".into(), slosh),
            order(format!("half fuel, sloshing at {HYBRID} rad/s"), &hybrid),
        ];

        let mut zeros: Vec<RealZeros> = COLUMNS
            .into_iter()
            .zip(points)
            .filter_map(|(name, point)| real_zeros(name.into(), &point.zeros))
            .collect();
        let [_, without] = slosh.without_slosh();
        zeros.extend(real_zeros("sloshing mass, without slosh modes".into(), &without));
        let step_of = |name| frequency.zero(name);
        if let (Some(right), Some(left)) = (step_of(Name::RightZero), step_of(Name::LeftZero)) {
            zeros.extend(QUOTED.into_iter().map(|at| {
                let step = frequency.step_at(at);
                let [right, left] = [right, left].map(|branch| branch.values[step].re);
                let of = format!("half fuel, sloshing at {at} rad/s");
                RealZeros { of, right, left, sum: right + left }
            }));
        }

        let empty =
            VehicleOptions { configuration: Configuration::SloshBeam, fuel_fraction: 0.0, ..*base };
        let empty = OperatingPoint::new(data, &empty)?;
        let limits = COLUMNS
            .into_iter()
            .zip(points)
            .chain([(EMPTY, &empty)])
            .filter_map(|(of, point)| limit(of, point))
            .collect();
        let names =
            [Name::Slosh(0), Name::Slosh(1)].into_iter().chain([0, 1, 2].map(Name::Flexible));
        let dipoles = names
            .filter_map(|name| {
                let (pole, zero) = (find(&slosh.poles, name)?, find(&slosh.zeros, name)?);
                let apart = (pole.value - zero.value).norm() / pole.frequency();
                Some(Dipole { name, pole: pair(pole), zero: pair(zero), apart })
            })
            .collect();
        let short = find(&slosh.poles, Name::UnstableShortPeriod);
        let first = frequency.pole(Name::Flexible(0));
        let at = |step: usize| first.map(|branch| (branch.values[step], branch.slosh[step]));
        let hybrid_step = frequency.step_at(HYBRID);
        let ratio = |step| at(step).map_or(0.0, |(value, _)| -value.re / value.norm());
        Ok(Self {
            orders,
            zeros,
            limits,
            dipoles,
            short_period_slosh: short.map_or(0.0, |root| root.slosh),
            short_period_elastic: short.map_or(0.0, |root| root.elastic),
            hybrid_share: at(hybrid_step).map_or(0.0, |(_, share)| share),
            hybrid_damping: [ratio(0), ratio(hybrid_step)],
        })
    }

    /// Relative change of a root without the slosh modes.
    pub fn moved(&self, order: usize, kind: &str, name: Name) -> f64 {
        let roots = &self.orders[order].roots;
        let found = roots.iter().find(|root| root.kind == kind && root.name == name);
        found.and_then(|root| root.moved).unwrap_or(0.0)
    }
}
