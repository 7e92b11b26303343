//! From data and parameters to a vehicle that can fly.

use crate::aero::Aero;
use crate::aeroelastic::{Strips, derive};
use crate::assembly::Chosen;
use crate::atmosphere::Atmosphere;
use crate::beam::{Beam, MassProperties, Oscillator};
use crate::burn::Burn;
use crate::choking::Choking;
use crate::dynamics::{Airframe, Stations, Vehicle};
use crate::error::Error;
use crate::factors::Factors;
use crate::intake::Intake;
use crate::modes::{MODES, Modes, SLOSH};
use crate::params::{
    AeroData, DataFile, EARTH, EarthData, Embedded, OWN, PARKER2007, SHOCK_EXPANSION, VEHICLE,
    VehicleData, XU2015,
};
use crate::slosh::fuel_kg_per_m;
use crate::trim::Condition;
use std::sync::Arc;

/// Which parts of the vehicle can move. The numbers are those of the FMU's enumeration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Configuration {
    /// Rigid body: 5 states.
    Rigid = 1,
    /// Flexible beam with its mass spread evenly: 11 states.
    EvenMassBeam = 2,
    /// Flexible beam with sloshing propellant: 15 states.
    SloshBeam = 3,
}

/// Coefficient set of eq. (4). The numbers are those of the FMU's enumeration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AeroSet {
    /// Published set, moved as little as possible towards Tables 2 and 3.
    Xu2015 = 1,
    /// Published rigid part, derived elastic part.
    Parker2007 = 2,
    /// Regression of the first-principles model.
    ShockExpansion = 3,
    /// That of the user, in a library that was built with one.
    Own = 4,
}

/// What shapes a vehicle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Build {
    /// Which parts can move.
    pub configuration: Configuration,
    /// Coefficient set.
    pub aero: AeroSet,
    /// Propellant at the start, 0 to 1.
    pub fuel_fraction: f64,
    /// Whether it burns in flight.
    pub fuel_burn: bool,
    /// Damping ratio of the sloshing masses.
    pub slosh_damping: f64,
    /// Sloshing frequency, rad/s; 0 takes the geometry of the tanks.
    pub slosh_frequency: f64,
    /// Flight condition: the tanks' geometry gives a frequency only under its effective gravity.
    pub condition: Condition,
    /// Where the sensors sit.
    pub stations: Stations,
    /// What is uncertain.
    pub factors: Factors,
}

/// All data files, read and checked; boxed, as together they are too large for a small stack.
#[derive(Debug, Clone)]
pub struct Data {
    /// Vehicle.
    pub vehicle: Box<VehicleData>,
    /// Gravity and air.
    pub earth: Box<EarthData>,
    /// Identified coefficient set.
    pub xu2015: Box<AeroData>,
    /// Published coefficient set.
    pub parker2007: Box<AeroData>,
    /// Coefficient set fitted to the first-principles model.
    pub shock_expansion: Box<AeroData>,
    /// Coefficient set of the user.
    pub own: Option<Box<AeroData>>,
}

/// A file's data, in a frame of its own: reading takes several times their room.
#[inline(never)]
fn boxed<T: DataFile>(file: &Embedded) -> Result<Box<T>, Error> {
    T::embedded(file).map(Box::new)
}

impl Data {
    /// The data that the library was built with.
    ///
    /// # Errors
    /// [`Error::Data`] with file, key and limit.
    pub fn embedded() -> Result<Self, Error> {
        Ok(Self {
            vehicle: boxed(&VEHICLE)?,
            earth: boxed(&EARTH)?,
            xu2015: boxed(&XU2015)?,
            parker2007: boxed(&PARKER2007)?,
            shock_expansion: boxed(&SHOCK_EXPANSION)?,
            own: OWN.as_ref().map(boxed).transpose()?,
        })
    }

    /// The data of a coefficient set.
    pub fn aero(&self, set: AeroSet) -> &AeroData {
        match set {
            AeroSet::Xu2015 => &self.xu2015,
            AeroSet::Parker2007 => &self.parker2007,
            AeroSet::ShockExpansion => &self.shock_expansion,
            AeroSet::Own => self.own.as_ref().unwrap_or(&self.xu2015),
        }
    }
}

/// [`Chosen::structure`] of a build.
///
/// # Errors
/// Those of [`Chosen::structure`].
pub fn structure(data: &Data, build: &Build) -> Result<(Beam, Vec<Oscillator>), Error> {
    Chosen::new(data, build).structure()
}

/// Beam, sloshing masses and modes of a vehicle at one fuel level.
#[derive(Debug, Clone)]
pub struct Body {
    /// Beam.
    pub beam: Beam,
    /// Sloshing masses.
    pub oscillators: Vec<Oscillator>,
    /// Modes of both together.
    pub modes: Modes,
    /// Mass, mass centre and pitch inertia of both together.
    pub properties: MassProperties,
    strips: Strips,
}

impl Body {
    /// Assembles the beam and solves for its modes.
    ///
    /// # Errors
    /// Those of [`Chosen::structure`]; [`Error::Modes`] if the modes cannot be found.
    pub fn new(chosen: &Chosen) -> Result<Self, Error> {
        let (beam, oscillators) = chosen.structure()?;
        let properties = beam.mass_properties(&oscillators);
        let modes = match chosen.build.configuration {
            Configuration::Rigid => Modes::default(),
            _ => Modes::solve(&beam, &oscillators)?,
        };
        let strips = Strips::new(&beam, &modes, &chosen.vehicle.geometry);
        Ok(Self { beam, oscillators, modes, strips, properties })
    }

    /// The same body, its modes in the basis nearest to those of another fuel level.
    ///
    /// # Errors
    /// Those of [`Modes::turned`].
    pub fn turned(mut self, chosen: &Chosen, reference: &Self) -> Result<Self, Error> {
        let reference = (&reference.modes, &reference.oscillators[..]);
        self.modes = self.modes.turned(&self.beam, &self.oscillators, reference)?;
        self.strips = Strips::new(&self.beam, &self.modes, &chosen.vehicle.geometry);
        Ok(self)
    }

    /// Displacement of the beam and of each sloshing mass, for each mode.
    pub fn displacements(&self) -> Vec<Vec<f64>> {
        self.modes.displacements(&self.oscillators)
    }

    /// `phi_i^T M v_k / mu_i` of the modes phi and of any displacements v.
    pub fn products(&self, displacements: &[Vec<f64>]) -> [[f64; MODES]; MODES] {
        self.modes.products(&self.beam, &self.oscillators, displacements)
    }

    /// What the equations of flight need of it, with the coefficient set around it.
    ///
    /// # Errors
    /// [`Error::Value`] if the tanks' geometry gives no sloshing frequency.
    pub fn airframe(&self, chosen: &Chosen) -> Result<Airframe, Error> {
        let Self { beam, oscillators, modes, strips, properties } = self;
        let Chosen { aero, build, .. } = chosen;
        // A force m g up on each sloshing mass and down on its tank.
        let gravity = chosen.effective_gravity();
        let damping = modes.damping(oscillators, &aero.inertia.structural_damping.value);
        let floor = std::array::from_fn(|i| {
            let weights = oscillators.iter().zip(&modes.slosh_displacement);
            let work: f64 = weights.map(|(o, relative)| o.mass * gravity * relative[i]).sum();
            // Of a mode that does not exist both are zero.
            work / modes.modal_mass[i].max(f64::MIN_POSITIVE)
        });
        let rate = build.factors.pitch_rate;
        let tanks = chosen.tanks(build.fuel_fraction)?;
        Ok(Airframe {
            mass: properties.mass,
            inertia: properties.inertia,
            mass_centre: properties.centre_m,
            elastic: derive(&Aero::new(aero), beam, modes, strips, properties.centre_m, rate),
            stiffness: modes.stiffness(),
            damping: std::array::from_fn(|k| damping.map(|row| row[k])),
            floor,
            slosh: modes.slosh_displacement,
            turning: Default::default(),
            imu: modes.at(&beam.point(build.stations.imu)),
            probe: modes.at(&beam.point(build.stations.probe)),
            depth: tanks.map_or([0.0; SLOSH], |tanks| tanks.map(|tank| tank.depth_m)),
        })
    }
}

impl Vehicle {
    /// Puts a vehicle together.
    ///
    /// # Errors
    /// [`Error::Value`] if a sensor is off the body; those of [`Body::new`]; [`Error::Value`] if the
    /// modes cannot be followed while fuel burns.
    pub fn new(data: &Data, build: &Build) -> Result<Self, Error> {
        Self::chosen(&Chosen::new(data, build))
    }

    /// [`Vehicle::new`] with any coefficient set.
    ///
    /// # Errors
    /// Those of [`Vehicle::new`].
    pub fn chosen(chosen: &Chosen) -> Result<Self, Error> {
        Self::with_body(chosen, &Body::new(chosen)?)
    }

    /// The same around a body that is known: that of [`Body::new`].
    ///
    /// # Errors
    /// Those of [`Vehicle::new`].
    pub fn with_body(chosen: &Chosen, body: &Body) -> Result<Self, Error> {
        let build = &chosen.build;
        build.stations.check(chosen.vehicle.geometry.length_m.value)?;
        let burn = build.fuel_burn.then(|| Burn::new(chosen, body)).transpose()?;
        Self::assembled(chosen, body, burn)
    }

    // A frame of its own, beside that of the burning vehicle.
    #[inline(never)]
    fn assembled(chosen: &Chosen, body: &Body, burn: Option<Burn>) -> Result<Self, Error> {
        let Chosen { vehicle, earth, aero, build } = chosen;
        Ok(Self {
            atmosphere: Atmosphere::new(earth),
            aero: Aero::new(aero),
            modes: body.modes.count,
            fuel: fuel_kg_per_m(vehicle, build.fuel_fraction),
            omega: body.modes.omega_rad_per_s,
            airframe: body.airframe(chosen)?,
            burn: burn.map(Arc::new),
            intake: Intake::new(vehicle, earth),
            choking: Choking::new(vehicle, earth),
            stations: build.stations,
            limits: [vehicle.actuation.delta_e_limit_rad.value, vehicle.actuation.phi_limit.value],
        })
    }
}
