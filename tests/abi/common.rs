//! The vehicle's library and its instances, in both versions of the standard.
#![allow(unsafe_code, dead_code)]

use crate::master;
use ahv::flight::Setup;
use fmi_model::status::Status;
use fmi_model::{Kind, table::find};

/// FMI 2.0.
pub mod fmi2 {
    pub type Api = crate::master::v2::Api<ahv::flight::Setup>;
    pub type Slave<'a> = crate::master::Slave<'a, Api>;
}

/// FMI 3.0.
pub mod fmi3 {
    pub type Api = crate::master::v3::Api<ahv::flight::Setup>;
    pub type Slave<'a> = crate::master::Slave<'a, Api>;
}

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

impl<'a, A: master::Api<Model = Setup>> master::Slave<'a, A> {
    /// A rigid vehicle, ready for its first step.
    pub fn flying(api: &'a A) -> Self {
        Self::flying_as(api, 1)
    }

    /// A vehicle of this configuration, ready for its first step.
    pub fn flying_as(api: &'a A, configuration: i32) -> Self {
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
        assert_eq!(self.set_enumeration("configuration", configuration), Status::Ok);
        assert_eq!(self.begin(), Status::Ok);
        assert_eq!(self.exit(), Status::Ok);
    }

    /// Flies with nearly all of the elevator until a step ends early; the communication point of that step.
    pub fn leave_envelope(&self) -> f64 {
        assert_eq!(self.set("delta_e", 0.15), Status::Ok);
        let step = 0.0625;
        for i in 0..200 {
            let point = f64::from(i) * step;
            let stepped = self.stepped(point, step);
            if stepped.ended {
                return point;
            }
            assert_eq!(stepped.status, Status::Ok, "{:?}", self.log());
        }
        panic!("so much elevator for 12.5 s and still inside the envelope");
    }
}
