//! The vehicle's library and its instances.
#![allow(unsafe_code, dead_code)]

use crate::master;
#[allow(unused_imports)]
pub use crate::master::{Random, Record, Sink, callbacks, recorder};
use ahv::flight::Setup;
use fmi_model::v2::sys::Status;
use fmi_model::{Kind, table::find};

pub type Api = master::Api<Setup>;
pub type Slave<'a> = master::Slave<'a, Setup>;

/// Value reference of a variable.
pub fn reference(name: &str) -> u32 {
    master::reference::<Setup>(name)
}

/// Numbers of all items of the enumeration `configuration`.
pub fn configurations() -> Vec<i32> {
    match find::<Setup>("configuration").expect("a parameter").kind {
        Kind::Enumeration(_, items) => items.iter().map(|&(_, number, _)| number).collect(),
        _ => panic!("configuration is no enumeration"),
    }
}

impl<'a> Slave<'a> {
    /// A rigid vehicle, ready for its first step.
    pub fn flying(api: &'a Api) -> Self {
        Self::flying_as(api, 1)
    }

    /// A vehicle of this configuration, ready for its first step.
    pub fn flying_as(api: &'a Api, configuration: i32) -> Self {
        let slave = Self::new(api);
        slave.start_as(configuration);
        slave
    }

    /// From just instantiated to ready for the first step, with a rigid vehicle.
    pub fn start(&self) {
        self.start_as(1);
    }

    /// From just instantiated to ready for the first step.
    pub fn start_as(&self, configuration: i32) {
        assert_eq!(self.set_integer("configuration", configuration), Status::Ok);
        assert_eq!(self.setup(), Status::Ok);
        assert_eq!(self.enter(), Status::Ok);
        assert_eq!(self.exit(), Status::Ok);
    }

    /// Flies with nearly all of the elevator until a step ends early; the communication point of that step.
    pub fn leave_envelope(&self) -> f64 {
        assert_eq!(self.set("delta_e", 0.15), Status::Ok);
        let step = 0.0625;
        for i in 0..200 {
            let point = f64::from(i) * step;
            match self.step(point, step) {
                Status::Ok => {}
                Status::Discard => return point,
                other => panic!("{other:?} {:?}", self.log()),
            }
        }
        panic!("so much elevator for 12.5 s and still inside the envelope");
    }
}
