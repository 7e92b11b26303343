//! First-principles model of air and engine, from which curve fits like eq. (4) are made.
//!
//! The two-dimensional vehicle of Bolender and Doman (J. Spacecraft and Rockets 44(2), 2007): a
//! shock or an expansion at the nose, above and below; an inlet whose lip captures the stream
//! behind the bow shock; an engine; an aft-body that is half of a nozzle, with the plume as
//! its other half; a flat plate as elevator. Inviscid, per metre of width.
//!
//! Forces are those on a control volume: pressures on the outer surfaces, minus that of
//! the free stream, and momentum fluxes through inlet and exit. One part is defined as thrust, the rest
//! is lift, drag and moment, so that every force is counted once.
//!
//! Bending changes the local incidence (see [`ahv::air::strip_theory`]): the stream turns at the nose
//! through a shock, then follows the wall without losses (the shock-expansion method: Eggers,
//! Syvertson and Kraus, NACA Report 1123). Panels keep their undeformed normals and places.

pub mod elastic;
pub mod engine;
pub mod stream;
pub mod surface;

use crate::gas::GasError;
use ahv::data::{EarthData, VehicleData};
use engine::Engine;
use stream::{Medium, Stream};
use surface::{Force, Wall};

/// Aerodynamic loads on the vehicle.
#[derive(Debug, Clone, PartialEq)]
pub struct AirLoads {
    /// Incidence of the free stream, rad.
    pub alpha: f64,
    /// Thrust along the axis, N/m.
    pub thrust: f64,
    /// All other forces.
    pub forces: Vec<Force>,
    /// Air through the engine, kg/(s m).
    pub mass_flow: f64,
    /// The stream in the engine's exit plane.
    pub exhaust: Stream,
}

impl AirLoads {
    fn total(&self) -> (f64, f64) {
        self.forces.iter().fold((0.0, 0.0), |(aft, up), f| (aft + f.aft, up + f.up))
    }

    /// Force across the free stream, without the thrust, N/m.
    pub fn lift(&self) -> f64 {
        let (aft, up) = self.total();
        let (sin, cos) = libm::sincos(self.alpha);
        up * cos - aft * sin
    }

    /// Force along the free stream, without the thrust, N/m.
    pub fn drag(&self) -> f64 {
        let (aft, up) = self.total();
        let (sin, cos) = libm::sincos(self.alpha);
        up * sin + aft * cos
    }

    /// Nose-up moment about a place, without the thrust, N.
    pub fn moment(&self, x: f64, z: f64) -> f64 {
        self.forces.iter().map(|f| (f.z - z) * f.aft - (f.x - x) * f.up).sum()
    }

    /// Generalised force of a mode shape, N/m: the work of the forces on it.
    pub fn generalised(&self, shape: impl Fn(f64) -> f64) -> f64 {
        self.forces.iter().map(|f| f.up * shape(f.x)).sum()
    }
}

/// Attitude and controls.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Attitude {
    /// Incidence, rad.
    pub alpha: f64,
    /// Elevator deflection, rad.
    pub delta_e: f64,
    /// Fuel equivalence ratio.
    pub phi: f64,
}

/// Geometry, air and engine of the vehicle.
#[derive(Debug, Clone, Copy)]
pub struct ShockExpansion {
    /// The air.
    pub medium: Medium,
    /// The engine.
    pub engine: Engine,
    /// Height of the moment centre, m.
    pub moment_height: f64,
    length: f64,
    fore_body: f64,
    nacelle: f64,
    lower_angle: f64,
    upper_angle: f64,
    elevator: [f64; 3],
}

/// Air captured by the lip.
struct Capture {
    /// kg/(s m).
    mass_flow: f64,
    /// Whether the bow shock passes ahead of the lip, so that part of the shock layer spills below the nacelle.
    spills: bool,
}

impl ShockExpansion {
    /// The vehicle of the data files.
    pub fn new(vehicle: &VehicleData, earth: &EarthData) -> Self {
        let outline = &vehicle.outline;
        Self {
            medium: Medium::new(earth),
            engine: Engine::new(&vehicle.engine),
            moment_height: outline.moment_height_m.value,
            length: vehicle.geometry.length_m.value,
            fore_body: vehicle.geometry.fore_body_m.value,
            nacelle: vehicle.geometry.nacelle_m.value,
            lower_angle: outline.lower_angle_rad.value,
            upper_angle: outline.upper_angle_rad.value,
            elevator: [
                outline.elevator_station_m.value,
                outline.elevator_height_m.value,
                outline.elevator_area_m2_per_m.value,
            ],
        }
    }

    /// Height of the end of the fore-body, where the duct begins and the aft-body too, m.
    pub fn shoulder_height(&self) -> f64 {
        -self.fore_body * libm::tan(self.lower_angle)
    }

    /// Height of the thrust line, the middle of the duct, m.
    pub fn thrust_height(&self) -> f64 {
        self.shoulder_height() - 0.5 * self.engine.height
    }

    /// Angle between upper side and aft-body at the tail, rad.
    pub fn tail_angle(&self) -> f64 {
        let [x, z] = [self.length - self.fore_body - self.nacelle, self.tail_height()];
        libm::atan((z - self.shoulder_height()) / x) - self.upper_angle
    }

    fn tail_height(&self) -> f64 {
        self.length * libm::tan(self.upper_angle)
    }

    /// Forces in a free stream; `bend(x)` (rad) is added to the local incidence.
    ///
    /// # Errors
    /// [`GasError`] where the flow does not exist: a detached shock, a choked duct or burner.
    pub fn loads(
        &self,
        ahead: &Stream,
        attitude: &Attitude,
        bend: &dyn Fn(f64) -> f64,
    ) -> Result<AirLoads, GasError> {
        let Attitude { alpha, delta_e, phi } = *attitude;
        let (medium, ambient) = (&self.medium, ahead.pressure);
        let incidence = |x: f64| alpha + bend(x);
        let shoulder = [self.fore_body, self.shoulder_height()];
        let tail = [self.length, self.tail_height()];
        let mut forces = Vec::new();

        let upper = Wall { from: [0.0, 0.0], to: tail, side: -1.0 };
        let angle = |x| self.upper_angle - incidence(x);
        upper.washed(medium, ahead, ambient, angle, &mut forces)?;
        let lower = Wall { from: [0.0, 0.0], to: shoulder, side: 1.0 };
        let angle = |x| self.lower_angle + incidence(x);
        let inflow = lower.washed(medium, ahead, ambient, angle, &mut forces)?;

        let capture = self.capture(ahead, &inflow, incidence(0.0));
        let lip = shoulder[1] - self.engine.height;
        let behind = self.fore_body + self.nacelle;
        let base = Wall { from: [self.fore_body, lip], to: [behind, lip], side: 1.0 };
        if capture.spills {
            // The shock layer follows the fore-body down and turns back around the lip.
            let angle = |x| incidence(x) - incidence(self.fore_body) - self.lower_angle;
            base.washed(medium, &inflow, ambient, angle, &mut forces)?;
        } else {
            base.washed(medium, ahead, ambient, incidence, &mut forces)?;
        }

        let mass_flow = capture.mass_flow;
        let exhaust = self.engine.exhaust(medium, &inflow, self.lower_angle, mass_flow, phi)?;
        let aft_body = Wall { from: [behind, shoulder[1]], to: tail, side: 1.0 };
        // Chavez and Schmidt 1994, J. Guidance, Control, and Dynamics 17(6): this pressure law follows
        // from the edge of the plume along the aft-body.
        let excess = exhaust.pressure / ambient - 1.0;
        let plume = aft_body.pressed(|place| exhaust.pressure / (1.0 + place * excess) - ambient);
        let first = forces.len();
        forces.extend(plume);
        let pull: f64 = forces[first..].iter().map(|f| f.aft).sum();
        forces.push(self.elevator(ahead, incidence(self.elevator[0]), delta_e)?);

        // Momentum enters along the fore-body and leaves along the axis. The ram of the free stream
        // and the pull of the plume on the aft-body count as thrust, so they are taken out here.
        let (sin, cos) = libm::sincos(self.lower_angle);
        let (height, ram) = (self.engine.height, mass_flow * medium.speed(ahead));
        let entering = mass_flow * medium.speed(&inflow);
        forces.push(Force {
            x: self.fore_body,
            z: self.thrust_height(),
            aft: entering * cos + (inflow.pressure - ambient) * height - ram - pull,
            up: -entering * sin,
        });
        let gross = (medium.momentum_flux(&exhaust) + exhaust.pressure - ambient) * height;
        Ok(AirLoads { alpha, thrust: gross - ram - pull, forces, mass_flow, exhaust })
    }

    /// A lip below the bow shock captures the free stream between the heights of nose and lip; one in the
    /// shock layer captures the flow between fore-body and lip. On the shock both agree.
    fn capture(&self, ahead: &Stream, inflow: &Stream, alpha: f64) -> Capture {
        let (sin, cos) = libm::sincos(alpha);
        let depth = self.engine.height - self.shoulder_height();
        let whole = self.medium.mass_flux(ahead) * (self.fore_body * sin + depth * cos);
        let height = self.engine.height * libm::cos(self.lower_angle);
        let layer = self.medium.mass_flux(inflow) * height;
        Capture { mass_flow: layer.min(whole), spills: layer < whole }
    }

    /// A flat plate in the free stream: a shock on one side, an expansion on the other.
    fn elevator(&self, ahead: &Stream, alpha: f64, delta_e: f64) -> Result<Force, GasError> {
        let [x, z, area] = self.elevator;
        let angle = alpha + delta_e;
        let [below, above] =
            [self.medium.turned(ahead, angle)?, self.medium.turned(ahead, -angle)?];
        let load = (below.pressure - above.pressure) * area;
        let (sin, cos) = libm::sincos(delta_e);
        Ok(Force { x, z, aft: load * sin, up: load * cos })
    }
}
