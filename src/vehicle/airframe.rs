//! Properties of a vehicle at one fuel level.

use super::state::{State, eta};
use crate::air::curve_fits::{Elastic, ModalForces, PerMode};
use crate::solve::{Over, Scalar};
use crate::structure::{MODES, SLOSH};

/// Mass, elastic terms and modes at one fuel level, per metre of width; as real numbers, or as dual
/// numbers with derivatives with respect to fuel.
#[derive(Debug, Clone, Copy, Default)]
pub struct Airframe<C = f64> {
    /// Mass, kg/m.
    pub mass: C,
    /// Pitch inertia, kg m^2/m.
    pub inertia: C,
    /// Station of the mass centre, m from the nose.
    pub mass_centre: C,
    /// Elastic terms of the curve fits; modal forces already divided by the modal mass.
    pub elastic: Elastic<C>,
    /// Modal stiffness matrix K, 1/s^2: eta-dd + D eta-d + K eta = N. Diagonal, with the squares of the
    /// frequencies, unless fuel burns.
    pub stiffness: [PerMode<C>; MODES],
    /// Modal damping matrix D, 1/s, by columns.
    pub damping: [PerMode<C>; MODES],
    /// Modal acceleration due to the tank floors, which carry the weight of the liquid, m/s^2: the
    /// springs of the sloshing masses are unloaded in steady flight.
    pub floor: PerMode<C>,
    /// Displacement of the sloshing masses relative to the tank, per modal coordinate.
    pub slosh: [PerMode<C>; SLOSH],
    /// Rate of change of the shapes with the fuel f: `phi_i^T M (d phi_k / df) / mu_i`, m/kg.
    pub turning: [PerMode<C>; MODES],
    /// Deflection and slope (1/m) of the modes at the IMU.
    pub imu: [PerMode<C>; 2],
    /// The same at the probe.
    pub probe: [PerMode<C>; 2],
    /// Depth of the liquid in the fore and aft tank, m; 0 without sloshing.
    pub depth: [C; SLOSH],
}

/// Number of coefficients of an airframe.
pub const COEFFICIENTS: usize = size_of::<Airframe>() / size_of::<f64>();

impl<C> Airframe<C> {
    /// All coefficients, in a fixed order.
    fn parts(&mut self) -> [&mut [C]; 18] {
        use std::slice::from_mut as one;
        let Self { mass, inertia, mass_centre, elastic, .. } = self;
        let Self { stiffness, damping, floor, slosh, turning, imu, probe, depth, .. } = self;
        let Elastic { per, pitch_rate, force } = elastic;
        let ModalForces { alpha, delta_e, plume, thrust_across, thrust_couple } = force;
        [
            one(mass),
            one(inertia),
            one(mass_centre),
            per.as_flattened_mut().as_flattened_mut(),
            alpha.as_flattened_mut(),
            delta_e,
            plume,
            pitch_rate,
            thrust_across,
            thrust_couple,
            stiffness.as_flattened_mut(),
            damping.as_flattened_mut(),
            floor,
            slosh.as_flattened_mut(),
            turning.as_flattened_mut(),
            imu.as_flattened_mut(),
            probe.as_flattened_mut(),
            depth,
        ]
    }
}

impl<C: Copy> Airframe<C> {
    /// Displacement of the sloshing mass in the fore and aft tank, m.
    pub fn sloshing<S: Scalar + Over<C>>(&self, x: &State<S>) -> [S; SLOSH] {
        self.slosh.map(|tank| {
            let parts = tank.iter().enumerate();
            parts.fold(S::constant(0.0), |sum, (i, per)| sum + x[eta(i)] * *per)
        })
    }
}

impl<C: Copy + Default> Airframe<C> {
    /// All coefficients in a row.
    pub fn to_row(mut self) -> [C; COEFFICIENTS] {
        let mut row = [C::default(); COEFFICIENTS];
        let mut rest = &mut row[..];
        for part in self.parts() {
            let (first, others) = rest.split_at_mut(part.len());
            first.copy_from_slice(part);
            rest = others;
        }
        row
    }

    /// Inverse of [`Airframe::to_row`].
    #[inline]
    pub fn from_row(row: &[C; COEFFICIENTS]) -> Self {
        let mut airframe = Self::default();
        let mut rest = &row[..];
        for part in airframe.parts() {
            let (first, others) = rest.split_at(part.len());
            part.copy_from_slice(first);
            rest = others;
        }
        airframe
    }
}
