//! Legal order of calls, as the standards have it.

mod v2;
mod v3;

use super::{Api, Slave};
use fmi_model::instance::Interface;
use fmi_model::phase::{PHASES, Phase};
use fmi_model::standard::Standard;
use fmi_model::status::Status;
use fmi_model::{Model, Variable, table};
use std::ffi::c_void;
use std::ptr::null_mut;

/// What a standard says of calls: x if a state allows one, m and c if it does for model exchange or
/// co-simulation only.
pub trait Order: Api {
    /// Name of each function, and a column for each state that the standard knows.
    const TABLE: &'static [(&'static str, &'static str)];
    /// The states that have a column, in the order of the columns.
    const COLUMNS: &'static [Phase];
    /// Does what a new instance needs to leave its first state.
    fn prepare(_slave: &Slave<Self>) {}
    /// Calls a function with harmless arguments; `other` has a state that can be restored.
    fn call(slave: &Slave<Self>, other: &Slave<Self>, name: &str) -> Status;
    /// What a legal call with those arguments returns.
    fn legal_result(name: &str, phase: Phase) -> Status;

    /// Whether the standard allows a call in a state.
    fn allows(name: &str, phase: Phase, interface: Interface) -> bool {
        let (_, row) = Self::TABLE.iter().find(|(row, _)| *row == name).expect(name);
        let Some(column) = Self::COLUMNS.iter().position(|column| *column == phase) else {
            return false;
        };
        match row.as_bytes()[column] {
            b'x' => true,
            b'm' | b'M' => interface == Interface::ModelExchange,
            b'c' => interface == Interface::CoSimulation,
            b' ' => false,
            other => panic!("{name}: {other}"),
        }
    }
}

/// The library's own table says what the standard says.
pub fn compare_tables<A: Order>() {
    assert_eq!(A::CALLS.len(), A::TABLE.len());
    for call in A::CALLS {
        for interface in [Interface::CoSimulation, Interface::ModelExchange] {
            let ours = |phase| {
                call.allowed_in(phase) && call.interface.is_none_or(|only| only == interface)
            };
            for phase in PHASES.into_iter().filter(|&phase| reaches(interface, phase)) {
                let allowed = A::allows(call.name, phase, interface);
                assert_eq!(ours(phase), allowed, "{} {phase:?} {interface}", call.name);
            }
        }
    }
}

/// Whether an interface has a state.
pub fn reaches(interface: Interface, phase: Phase) -> bool {
    match phase {
        Phase::EventMode | Phase::ContinuousTimeMode => interface == Interface::ModelExchange,
        Phase::StepComplete
        | Phase::StepInProgress
        | Phase::StepFailed
        | Phase::StepCanceled
        | Phase::IntermediateUpdateMode => interface == Interface::CoSimulation,
        _ => true,
    }
}

/// Value reference of the first variable that fits, or of none.
fn first<M: Model>(fits: fn(&Variable<M>) -> bool) -> Vec<u32> {
    (0..).zip(M::VARIABLES).filter(|(_, variable)| fits(variable)).map(|(i, _)| i).take(1).collect()
}

/// A number for each state.
fn nominals<M: Model>() -> Vec<f64> {
    (0..table::states::<M>()).map(|i| table::state::<M>(i).nominal.unwrap_or(1.0)).collect()
}

/// The calls on FMU states, which have the same names but for a letter.
fn call_on_states<A: Api>(slave: &Slave<A>, other: &Slave<A>, name: &str) -> Status {
    let (api, c) = (slave.api, slave.c);
    let (mut made, mut size): (*mut c_void, _) = (null_mut(), 0);
    let saved = other.save();
    let mut bytes = other.bytes(saved);
    let status = match name[4..].to_ascii_lowercase().as_str() {
        "getfmustate" => api.get_state(c, &mut made),
        "freefmustate" => api.free_state(c, &mut made),
        "setfmustate" => slave.load(saved),
        "serializedfmustatesize" => api.state_size(c, saved, &mut size),
        "serializefmustate" => api.serialize(c, saved, &mut bytes),
        "deserializefmustate" => api.deserialize(c, &bytes, &mut made),
        _ => panic!("{name} has no arguments here"),
    };
    other.free(saved);
    if !made.is_null() {
        other.free(made);
    }
    status
}

/// Every function in every state, of a model that can be saved: done or refused, and then nothing changes.
/// `bring` takes a new instance to a state.
pub fn follow<A: Order>(phases: &[Phase], bring: impl Fn(&Slave<A>, Phase)) {
    let api = A::load();
    for interface in [Interface::CoSimulation, Interface::ModelExchange] {
        for &phase in phases.iter().filter(|&&phase| reaches(interface, phase)) {
            for (name, _) in A::TABLE {
                let slave = Slave::with(&api, interface, false);
                bring(&slave, phase);
                if phase == Phase::Instantiated {
                    A::prepare(&slave);
                }
                slave.log();
                let other = Slave::with(&api, interface, false);
                bring(&other, Phase::Terminated);
                if A::allows(name, phase, interface) {
                    let (status, expected) =
                        (A::call(&slave, &other, name), A::legal_result(name, phase));
                    let log = slave.log();
                    assert_eq!(status, expected, "{name} {phase:?} {interface} {log:?}");
                } else {
                    let begin = refusal::<A>(name, phase, interface);
                    slave.refuses(Status::Error, &[&begin], |slave| A::call(slave, &other, name));
                }
            }
        }
    }
}

/// How the message of a call begins that is out of order.
fn refusal<A: Order>(name: &str, phase: Phase, interface: Interface) -> String {
    let only = A::CALLS.iter().find(|call| call.name == name).expect(name).interface;
    if A::STANDARD == Standard::Fmi3 && only.is_some_and(|only| only != interface) {
        return format!("{name}: not a function of {interface}");
    }
    format!("{name}: not allowed in state {}; allowed in: ", phase.name(A::STANDARD))
}
