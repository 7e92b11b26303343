//! An instance with a recording logger.

use super::{Api, Record, Sink, callbacks};
use fmi_model::v2::sys::{self, Status, StatusKind};
use fmi_model::{Kind, Model, identity::guid};
use std::ffi::CString;
use std::ptr::{null, null_mut};

/// Value reference of a variable.
pub fn reference<M: Model>(name: &str) -> u32 {
    M::VARIABLES.iter().position(|variable| variable.name == name).expect(name) as u32
}

/// An instance.
pub struct Slave<'a, M: Model> {
    pub api: &'a Api<M>,
    pub c: sys::Component,
    sink: Box<Sink>,
}

impl<M: Model> Drop for Slave<'_, M> {
    fn drop(&mut self) {
        // SAFETY: a live instance, freed once.
        unsafe { (self.api.free_instance)(self.c) }
    }
}

// SAFETY of all calls below: the instance lives, and the arrays have the lengths given.
impl<'a, M: Model> Slave<'a, M> {
    pub fn new(api: &'a Api<M>) -> Self {
        Self::with_logging(api, false)
    }

    /// An instance for model exchange.
    pub fn exchange(api: &'a Api<M>) -> Self {
        Self::with(api, sys::Type::MODEL_EXCHANGE, false)
    }

    pub fn with_logging(api: &'a Api<M>, on: bool) -> Self {
        Self::with(api, sys::Type::CO_SIMULATION, on)
    }

    pub fn with(api: &'a Api<M>, kind: sys::Type, on: bool) -> Self {
        let made = Self::of_package(api, kind, &guid::<M>(), None, on);
        made.unwrap_or_else(|log| panic!("{log:?}"))
    }

    /// An instance of a package with this GUID and these resources, or why there is none.
    pub fn of_package(
        api: &'a Api<M>,
        kind: sys::Type,
        guid: &str,
        resources: Option<&str>,
        on: bool,
    ) -> Result<Self, Vec<Record>> {
        let sink = Box::new(Sink::default());
        let [guid, resources] =
            [Some(guid), resources].map(|it| it.map(|it| CString::new(it).unwrap()));
        let [guid, resources] =
            [&guid, &resources].map(|it| it.as_ref().map_or(null(), |it| it.as_ptr()));
        let (name, functions) = (c"one".as_ptr(), callbacks(&sink));
        let c = unsafe { (api.instantiate)(name, kind, guid, resources, &functions, 0, on.into()) };
        match c.is_null() {
            true => Err(std::mem::take(&mut *sink.lock().unwrap())),
            false => Ok(Self { api, c, sink }),
        }
    }

    /// What was logged since the last call.
    pub fn log(&self) -> Vec<Record> {
        std::mem::take(&mut *self.sink.lock().unwrap())
    }

    /// The only message since the last call.
    pub fn message(&self) -> Record {
        let log = self.log();
        assert_eq!(log.len(), 1, "{log:?}");
        log[0].clone()
    }

    pub fn setup(&self) -> Status {
        self.setup_with(None, 0.0, None)
    }

    pub fn setup_with(&self, tolerance: Option<f64>, start: f64, stop: Option<f64>) -> Status {
        let (defined, tolerance) = (tolerance.is_some().into(), tolerance.unwrap_or(f64::NAN));
        let (stops, stop) = (stop.is_some().into(), stop.unwrap_or(f64::NAN));
        unsafe { (self.api.setup_experiment)(self.c, defined, tolerance, start, stops, stop) }
    }

    pub fn enter(&self) -> Status {
        unsafe { (self.api.enter_initialization_mode)(self.c) }
    }

    pub fn exit(&self) -> Status {
        unsafe { (self.api.exit_initialization_mode)(self.c) }
    }

    pub fn terminate(&self) -> Status {
        unsafe { (self.api.terminate)(self.c) }
    }

    pub fn reset(&self) -> Status {
        unsafe { (self.api.reset)(self.c) }
    }

    pub fn step(&self, point: f64, step: f64) -> Status {
        unsafe { (self.api.do_step)(self.c, point, step, 0) }
    }

    pub fn set(&self, name: &str, value: f64) -> Status {
        self.set_reals(&[reference::<M>(name)], &[value])
    }

    pub fn set_reals(&self, references: &[u32], values: &[f64]) -> Status {
        assert_eq!(references.len(), values.len());
        unsafe { (self.api.set_real)(self.c, references.as_ptr(), values.len(), values.as_ptr()) }
    }

    /// The derivative of an order of an input, for the next step.
    pub fn set_input_derivative(&self, name: &str, order: i32, value: f64) -> Status {
        unsafe {
            (self.api.set_input_derivatives)(self.c, &reference::<M>(name), 1, &order, &value)
        }
    }

    pub fn set_integer(&self, name: &str, value: i32) -> Status {
        unsafe { (self.api.set_integer)(self.c, &reference::<M>(name), 1, &value) }
    }

    pub fn set_boolean(&self, name: &str, value: i32) -> Status {
        unsafe { (self.api.set_boolean)(self.c, &reference::<M>(name), 1, &value) }
    }

    /// Status and values; what was not written is NaN.
    pub fn reals(&self, references: &[u32]) -> (Status, Vec<f64>) {
        let mut values = vec![f64::NAN; references.len()];
        let (from, to) = (references.as_ptr(), values.as_mut_ptr());
        let status = unsafe { (self.api.get_real)(self.c, from, references.len(), to) };
        (status, values)
    }

    pub fn get(&self, name: &str) -> f64 {
        let (status, values) = self.reals(&[reference::<M>(name)]);
        assert_eq!(status, Status::Ok, "{name}");
        values[0]
    }

    /// Bits of all variables of type Real.
    pub fn bits(&self) -> Vec<u64> {
        let (status, values) = self.reals(&all_reals::<M>());
        assert_eq!(status, Status::Ok, "{:?}", self.log());
        assert!(values.iter().all(|value| value.is_finite()));
        values.into_iter().map(f64::to_bits).collect()
    }

    pub fn last_successful_time(&self) -> f64 {
        let (mut value, kind) = (f64::NAN, StatusKind::LAST_SUCCESSFUL_TIME);
        let status = unsafe { (self.api.get_real_status)(self.c, kind, &mut value) };
        assert_eq!(status, Status::Ok);
        value
    }

    pub fn wants_to_end(&self) -> bool {
        let (mut value, kind) = (-1, StatusKind::TERMINATED);
        let status = unsafe { (self.api.get_boolean_status)(self.c, kind, &mut value) };
        assert_eq!(status, Status::Ok);
        value == sys::TRUE
    }

    pub fn save(&self) -> sys::FmuState {
        let mut state = null_mut();
        assert_eq!(unsafe { (self.api.get_state)(self.c, &mut state) }, Status::Ok);
        state
    }

    pub fn load(&self, state: sys::FmuState) -> Status {
        unsafe { (self.api.set_state)(self.c, state) }
    }

    pub fn free(&self, mut state: sys::FmuState) {
        assert_eq!(unsafe { (self.api.free_state)(self.c, &mut state) }, Status::Ok);
        assert!(state.is_null());
    }

    pub fn bytes(&self, state: sys::FmuState) -> Vec<u8> {
        let mut size = 0;
        assert_eq!(unsafe { (self.api.state_size)(self.c, state, &mut size) }, Status::Ok);
        let mut bytes = vec![0_u8; size];
        let to = bytes.as_mut_ptr().cast();
        assert_eq!(unsafe { (self.api.serialize)(self.c, state, to, size) }, Status::Ok);
        bytes
    }

    pub fn state_of(&self, bytes: &[u8]) -> (Status, sys::FmuState) {
        let mut state = null_mut();
        let from = bytes.as_ptr().cast();
        let status = unsafe { (self.api.deserialize)(self.c, from, bytes.len(), &mut state) };
        (status, state)
    }
}

/// Value references of all variables of type Real.
pub fn all_reals<M: Model>() -> Vec<u32> {
    let is_real = |&i: &u32| matches!(M::VARIABLES[i as usize].kind, Kind::Real(_));
    (0..M::VARIABLES.len() as u32).filter(is_real).collect()
}

/// SplitMix64 (Steele, Lea, Flood 2014): the same sequence everywhere.
pub struct Random(pub u64);

impl Random {
    pub fn below(&mut self, limit: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) % limit
    }

    pub fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[self.below(from.len() as u64) as usize]
    }
}
