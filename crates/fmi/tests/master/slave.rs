//! An instance with a recording logger.

use super::{Api, Package, Record, Stepped};
use fmi_model::identity::guid;
use fmi_model::instance::Interface;
use fmi_model::phase::Phase;
use fmi_model::standard::Standard;
use fmi_model::status::Status;
use fmi_model::{Kind, Model};
use std::ffi::{CString, c_void};
use std::ptr::null_mut;

/// Value reference of a variable.
pub fn reference<M: Model>(name: &str) -> u32 {
    M::VARIABLES.iter().position(|variable| variable.name == name).expect(name) as u32
}

/// Where the bytes of an FMU state have the number of the phase, and how many a checksum has at their end.
const PHASE: usize = 32;
const CHECKSUM: usize = 8;

/// The phase in the bytes of an FMU state, and everything else that they say.
pub fn parts(mut bytes: Vec<u8>) -> (u8, Vec<u8>) {
    bytes.truncate(bytes.len() - CHECKSUM);
    (bytes.remove(PHASE), bytes)
}

/// An instance.
pub struct Slave<'a, A: Api> {
    pub api: &'a A,
    pub c: *mut c_void,
    pub environment: Box<A::Environment>,
}

impl<A: Api> Drop for Slave<'_, A> {
    fn drop(&mut self) {
        self.api.free(self.c);
    }
}

impl<'a, A: Api> Slave<'a, A> {
    pub fn new(api: &'a A) -> Self {
        Self::with_logging(api, false)
    }

    /// An instance for model exchange.
    pub fn exchange(api: &'a A) -> Self {
        Self::with(api, Interface::ModelExchange, false)
    }

    pub fn with_logging(api: &'a A, on: bool) -> Self {
        Self::with(api, Interface::CoSimulation, on)
    }

    pub fn with(api: &'a A, interface: Interface, on: bool) -> Self {
        let made = Self::of_package(api, interface, &guid::<A::Model>(), None, on);
        made.unwrap_or_else(|log| panic!("{log:?}"))
    }

    /// An instance of a package with this GUID and these resources, or why there is none.
    pub fn of_package(
        api: &'a A,
        interface: Interface,
        guid: &str,
        resources: Option<&str>,
        on: bool,
    ) -> Result<Self, Vec<Record>> {
        let environment = Box::new(A::Environment::default());
        let (token, place) = (CString::new(guid), resources.map(CString::new).transpose());
        let (token, place) = (token.unwrap(), place.unwrap());
        let package = Package { token: &token, resources: place.as_deref() };
        let c = api.instantiate(interface, package, on, &environment);
        match c.is_null() {
            true => Err(std::mem::take(&mut *A::sink(&environment).lock().unwrap())),
            false => Ok(Self { api, c, environment }),
        }
    }

    /// What was logged since the last call.
    pub fn log(&self) -> Vec<Record> {
        std::mem::take(&mut *A::sink(&self.environment).lock().unwrap())
    }

    /// The only message since the last call.
    pub fn message(&self) -> Record {
        let log = self.log();
        assert_eq!(log.len(), 1, "{log:?}");
        log[0].clone()
    }

    /// A call that is refused with these words in its only message, and changes nothing. The error of FMI 3.0
    /// ends the run; it is then taken up again.
    pub fn refuses(&self, expected: Status, words: &[&str], call: impl FnOnce(&Self) -> Status) {
        self.log();
        let saved = self.save();
        let (phase, before) = parts(self.bytes(saved));
        let (status, record) = (call(self), self.message());
        assert_eq!((status, record.status), (expected, expected), "{words:?} {record:?}");
        assert_eq!(record.category, format!("logStatus{expected:?}"));
        for word in words {
            assert!(record.message.contains(word), "{word}: {}", record.message);
        }
        let now = self.save();
        let (after, rest) = parts(self.bytes(now));
        self.free(now);
        assert!(rest == before, "{words:?} changed something");
        if A::STANDARD == Standard::Fmi3 && expected == Status::Error {
            assert_eq!(after, Phase::Error as u8, "{words:?}: an error ends the run");
            assert_eq!(self.load(saved), Status::Ok);
        } else {
            assert_eq!(after, phase, "{words:?} changed the state");
        }
        self.free(saved);
    }

    /// Switches the logging of categories, or of all if none is named.
    pub fn switch_logging(&self, on: bool, categories: &[&str]) -> Status {
        let names: Vec<_> = categories.iter().map(|&name| CString::new(name).unwrap()).collect();
        let pointers: Vec<_> = names.iter().map(|name| name.as_ptr()).collect();
        self.api.switch_logging(self.c, on, &pointers)
    }

    /// Enters the initialization mode.
    pub fn begin(&self) -> Status {
        self.begin_with(None, 0.0, None)
    }

    /// Enters the initialization mode of an experiment.
    pub fn begin_with(&self, tolerance: Option<f64>, start: f64, stop: Option<f64>) -> Status {
        self.api.begin(self.c, tolerance, start, stop)
    }

    pub fn exit(&self) -> Status {
        self.api.exit(self.c)
    }

    pub fn terminate(&self) -> Status {
        self.api.terminate(self.c)
    }

    pub fn reset(&self) -> Status {
        self.api.reset(self.c)
    }

    pub fn step(&self, point: f64, step: f64) -> Status {
        self.stepped(point, step).status
    }

    pub fn stepped(&self, point: f64, step: f64) -> Stepped {
        self.api.step(self.c, point, step)
    }

    /// The end of the last step, s.
    pub fn time(&self) -> f64 {
        self.api.time(self.c)
    }

    pub fn set(&self, name: &str, value: f64) -> Status {
        self.set_reals(&[reference::<A::Model>(name)], &[value])
    }

    pub fn set_reals(&self, references: &[u32], values: &[f64]) -> Status {
        assert_eq!(references.len(), values.len());
        self.api.set_reals(self.c, references, values)
    }

    pub fn set_enumeration(&self, name: &str, value: i32) -> Status {
        self.api.set_enumeration(self.c, reference::<A::Model>(name), value)
    }

    pub fn set_boolean(&self, name: &str, value: bool) -> Status {
        self.api.set_boolean(self.c, reference::<A::Model>(name), value)
    }

    /// Status and values; what was not written is NaN.
    pub fn reals(&self, references: &[u32]) -> (Status, Vec<f64>) {
        let mut values = vec![f64::NAN; references.len()];
        (self.api.get_reals(self.c, references, &mut values), values)
    }

    pub fn get(&self, name: &str) -> f64 {
        let (status, values) = self.reals(&[reference::<A::Model>(name)]);
        assert_eq!(status, Status::Ok, "{name}");
        values[0]
    }

    /// Bits of all real variables.
    pub fn bits(&self) -> Vec<u64> {
        let (status, values) = self.reals(&all_reals::<A::Model>());
        assert_eq!(status, Status::Ok, "{:?}", self.log());
        assert!(values.iter().all(|value| value.is_finite()));
        values.into_iter().map(f64::to_bits).collect()
    }

    /// First derivative of an output by time, or NaN if it is refused.
    pub fn output_derivative(&self, name: &str, order: i32) -> (Status, f64) {
        let (output, mut value) = (reference::<A::Model>(name), [f64::NAN]);
        (self.api.output_derivatives(self.c, &[output], &[order], &mut value), value[0])
    }

    pub fn save(&self) -> *mut c_void {
        let mut state = null_mut();
        assert_eq!(self.api.get_state(self.c, &mut state), Status::Ok);
        state
    }

    pub fn load(&self, state: *mut c_void) -> Status {
        self.api.set_state(self.c, state)
    }

    pub fn free(&self, mut state: *mut c_void) {
        assert_eq!(self.api.free_state(self.c, &mut state), Status::Ok);
        assert!(state.is_null());
    }

    pub fn bytes(&self, state: *mut c_void) -> Vec<u8> {
        let mut size = 0;
        assert_eq!(self.api.state_size(self.c, state, &mut size), Status::Ok);
        let mut bytes = vec![0_u8; size];
        assert_eq!(self.api.serialize(self.c, state, &mut bytes), Status::Ok);
        bytes
    }

    /// Bytes of the present state.
    pub fn present(&self) -> Vec<u8> {
        let state = self.save();
        let bytes = self.bytes(state);
        self.free(state);
        bytes
    }

    pub fn state_of(&self, bytes: &[u8]) -> (Status, *mut c_void) {
        let mut state = null_mut();
        (self.api.deserialize(self.c, bytes, &mut state), state)
    }
}

/// Value references of all real variables.
pub fn all_reals<M: Model>() -> Vec<u32> {
    let is_real = |&i: &u32| matches!(M::VARIABLES[i as usize].kind, Kind::Real(_));
    (0..M::VARIABLES.len() as u32).filter(is_real).collect()
}
