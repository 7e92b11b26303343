//! What a master does within a step of FMI 3.0.

use super::{Api, UNKNOWN, flag, record};
use crate::master::{Package, Sink, Slave};
use fmi_model::Model;
use fmi_model::identity::guid;
use fmi_model::v3::sys::{Boolean, IntermediateUpdateCallback, Status};
use std::cell::Cell;
use std::ffi::{CString, c_void};
use std::ptr::NonNull;

/// What a master is told within a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moment {
    pub time: f64,
    pub set_requested: bool,
    pub get_allowed: bool,
    pub step_finished: bool,
    pub can_return_early: bool,
}

/// What a master does within a step: it may ask for an early return at a time.
type Update = dyn FnMut(&Moment) -> Option<f64>;

/// What the environment pointer leads to. The sink comes first.
#[derive(Default)]
#[repr(C)]
pub struct Environment {
    pub sink: Sink,
    update: Cell<Option<NonNull<Update>>>,
}

unsafe extern "C" fn update(
    environment: *mut c_void,
    time: f64,
    set_requested: Boolean,
    get_allowed: Boolean,
    step_finished: Boolean,
    can_return_early: Boolean,
    early_return_requested: *mut Boolean,
    early_return_time: *mut f64,
) {
    // SAFETY: the environment is that of the instance; what is in it lives until the step ends.
    unsafe {
        let environment = environment.cast::<Environment>();
        // Taken while it runs: a step within it has none.
        let Some(mut update) = (*environment).update.take() else { return };
        let moment = Moment {
            time,
            set_requested: flag(set_requested),
            get_allowed: flag(get_allowed),
            step_finished: flag(step_finished),
            can_return_early: flag(can_return_early),
        };
        if let Some(wanted) = update.as_mut()(&moment) {
            early_return_requested.write(Boolean::TRUE);
            early_return_time.write(wanted);
        }
        (*environment).update.set(Some(update));
    }
}

impl<M: Model> Api<M> {
    pub(super) fn co_simulation(
        &self,
        package: Package,
        on: bool,
        early_return_allowed: bool,
        intermediate: &[u32],
        update: Option<IntermediateUpdateCallback>,
        at: &Environment,
    ) -> *mut c_void {
        let (name, token) = (c"one".as_ptr(), package.token.as_ptr());
        let (no, on, early) = (Boolean::FALSE, on.into(), early_return_allowed.into());
        let (at, log) = (std::ptr::from_ref(at).cast_mut().cast(), Some(record as _));
        let (variables, count) = (intermediate.as_ptr(), intermediate.len());
        let (function, place) = (self.instantiate_co_simulation, package.resources());
        // SAFETY: valid arguments; the environment outlives the instance.
        unsafe {
            function(name, token, place, no, on, no, early, variables, count, at, log, update)
        }
    }
}

/// All that a step answers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Answers {
    pub status: Status,
    pub event: bool,
    pub end: bool,
    pub early: bool,
    pub time: f64,
}

/// What FMI 3.0 alone has.
impl<'a, M: Model> Slave<'a, Api<M>> {
    /// An instance that lets its master look in within a step.
    pub fn open(api: &'a Api<M>, early_return_allowed: bool, intermediate: &[u32]) -> Self {
        let environment = Box::new(Environment::default());
        let token = CString::new(guid::<M>()).unwrap();
        let package = Package { token: &token, resources: None };
        let c = api.co_simulation(
            package,
            false,
            early_return_allowed,
            intermediate,
            Some(update),
            &environment,
        );
        assert!(!c.is_null(), "{:?}", environment.sink);
        Self { api, c, environment }
    }

    /// A step within which the master looks in; it may use the instance there.
    pub fn step_with(
        &self,
        point: f64,
        step: f64,
        mut update: impl FnMut(&Moment) -> Option<f64>,
    ) -> Answers {
        let update: &mut (dyn FnMut(&Moment) -> Option<f64> + '_) = &mut update;
        // SAFETY: the lifetime is only left out until the step has ended.
        let update: &'static mut Update = unsafe { std::mem::transmute(update) };
        self.environment.update.set(Some(NonNull::from(update)));
        let [mut event, mut end, mut early] = [UNKNOWN; 3];
        let (no, mut time, function) = (Boolean::FALSE, f64::NAN, self.api.do_step);
        // SAFETY: a live instance, room for the answers.
        let status = unsafe {
            function(self.c, point, step, no, &mut event, &mut end, &mut early, &mut time)
        };
        self.environment.update.set(None);
        let done = status == Status::Ok;
        assert_eq!((time.is_nan(), end == UNKNOWN), (!done, !done), "all answers or none");
        let [event, end, early] = [event, end, early].map(|answer| done && flag(answer));
        Answers { status, event, end, early, time }
    }
}
