//! The master that plays: its instance, what it knows of it, and the arguments it passes.

use super::super::{Api, Random, Slave, all_reals};
use fmi_model::phase::Phase;
use fmi_model::v2::sys::{Component, FmuState, Status, ValueReference};
use fmi_model::{Kind, Model, Simulation, Variable, table};
use std::fmt::Debug;
use std::ptr::null_mut;

/// One argument in so many is unsound, of each kind of fault.
pub const RARELY: u64 = 24;
/// What stands where a function has not written: no value of any variable.
pub const BLANK: f64 = -1.234e-77;
pub const BLANK_INTEGER: i32 = -77_777;

/// An array as a careless master passes it: sound, NULL or misaligned, with a guard at its end.
pub struct Array<T> {
    pub items: Vec<T>,
    pub pointer: *mut T,
    pub sound: bool,
}

impl<T: Copy> Array<T> {
    pub fn new(random: &mut Random, mut items: Vec<T>, guard: T) -> Self {
        let empty = items.is_empty();
        // No slack behind the guard: a memory checker sees what goes beyond.
        items.reserve_exact(1);
        items.push(guard);
        let start = items.as_mut_ptr();
        let pointer = match random.below(RARELY) {
            0 => null_mut(),
            1 if align_of::<T>() > 1 => start.cast::<u8>().wrapping_add(1).cast(),
            _ => start,
        };
        Self { sound: empty || pointer == start, items, pointer }
    }

    /// So many random elements.
    pub fn of(random: &mut Random, count: usize, element: fn(&mut Random) -> T) -> Self {
        let items = (0..count).map(|_| element(random)).collect();
        let guard = element(random);
        Self::new(random, items, guard)
    }
}

/// A saved state: what it has to restore.
#[derive(Clone)]
pub struct Saved {
    pub state: FmuState,
    pub phase: Phase,
    pub has_experiment: bool,
    pub bytes: Vec<u8>,
}

/// An instance, the state in which it has to be, and FMU states with theirs.
pub struct Player<'a, M: Model> {
    pub slave: Slave<'a, M>,
    /// For model exchange, not for co-simulation.
    exchange: bool,
    /// The instance, or NULL, for the next call.
    pub c: Component,
    pub phase: Phase,
    pub has_experiment: bool,
    pub saved: Vec<Saved>,
    /// Whether the last call had an argument that has to be refused.
    pub unsound: bool,
}

pub fn real<M: Model>(variable: &Variable<M>) -> bool {
    matches!(variable.kind, Kind::Real(_))
}

pub fn integer<M: Model>(variable: &Variable<M>) -> bool {
    matches!(variable.kind, Kind::Enumeration(..))
}

pub fn boolean<M: Model>(variable: &Variable<M>) -> bool {
    matches!(variable.kind, Kind::Boolean)
}

type Kinds<M> = fn(&Variable<M>) -> bool;

impl<'a, M: Model> Player<'a, M> {
    pub fn new(api: &'a Api<M>, exchange: bool) -> Self {
        let slave = if exchange { Slave::exchange(api) } else { Slave::new(api) };
        let c = slave.c;
        let (phase, has_experiment) = (Phase::Instantiated, false);
        Self { slave, exchange, c, phase, has_experiment, saved: Vec::new(), unsound: false }
    }

    /// Value references: half of the arrays have fitting ones only, the others whatever comes.
    pub fn references(random: &mut Random, kinds: Kinds<M>, settable: bool) -> Vec<ValueReference> {
        let fit = |i: &u32| {
            let variable = &M::VARIABLES[*i as usize];
            kinds(variable) && (!settable || variable.settable())
        };
        let fitting: Vec<_> = (0..M::VARIABLES.len() as u32).filter(fit).collect();
        let any = random.below(2) == 0 || fitting.is_empty();
        let one = |random: &mut Random| match any {
            true => random.below(M::VARIABLES.len() as u64 + 2) as u32,
            false => random.pick(&fitting),
        };
        (0..random.below(4)).map(|_| one(random)).collect()
    }

    /// The number of elements that the master states: now and then -1, cast to `size_t`.
    pub fn claim(&mut self, random: &mut Random, count: usize) -> usize {
        let absurd = random.below(RARELY) == 0;
        self.unsound |= absurd;
        if absurd { usize::MAX } else { count }
    }

    /// A getter: all values are written or none, and nothing behind them.
    pub fn read<T: Copy + PartialEq + Debug>(
        &mut self,
        random: &mut Random,
        kinds: Kinds<M>,
        blank: T,
        call: impl FnOnce(Component, *const ValueReference, usize, *mut T) -> Status,
    ) -> (Status, Vec<T>) {
        let references = Self::references(random, kinds, false);
        let count = references.len();
        let references = Array::new(random, references, 0);
        let values = Array::new(random, vec![blank; count], blank);
        self.unsound = !(references.sound && values.sound);
        let claim = self.claim(random, count);
        let status = call(self.c, references.pointer, claim, values.pointer);
        let written = values.items.iter().filter(|&&value| value != blank).count();
        assert_eq!(written, if status == Status::Ok { count } else { 0 }, "{:?}", values.items);
        assert_eq!(values.items[count], blank);
        (status, values.items[..written].to_vec())
    }

    /// A setter: what it accepts is what the getter gives.
    pub fn write<T: Copy + PartialEq + Debug>(
        &mut self,
        random: &mut Random,
        kinds: Kinds<M>,
        element: fn(&mut Random) -> T,
        set: impl FnOnce(Component, *const ValueReference, usize, *const T) -> Status,
        get: impl Fn(Component, *const ValueReference, usize, *mut T) -> Status,
    ) -> Status {
        let references = Self::references(random, kinds, true);
        let count = references.len();
        let references = Array::new(random, references, 0);
        let values = Array::of(random, count, element);
        let given = values.items.clone();
        self.unsound = !(references.sound && values.sound);
        let claim = self.claim(random, count);
        let status = set(self.c, references.pointer, claim, values.pointer);
        if status == Status::Ok && self.phase != Phase::Instantiated {
            for (i, reference) in references.items[..count].iter().enumerate() {
                let last = (0..count).rfind(|&k| references.items[k] == *reference).unwrap_or(i);
                let mut found = given[last];
                assert_eq!(get(self.c, reference, 1, &mut found), Status::Ok);
                assert_eq!(found, given[last], "{}", M::VARIABLES[*reference as usize].name);
            }
        }
        status
    }

    /// A getter of one number for each state.
    pub fn read_states(
        &mut self,
        random: &mut Random,
        call: impl FnOnce(Component, *mut f64, usize) -> Status,
    ) -> Status {
        let states = table::states::<M>();
        let count = states.saturating_sub(usize::from(random.below(8) == 0));
        let values = Array::new(random, vec![BLANK; count], BLANK);
        self.unsound = !values.sound || count != states;
        let status = call(self.c, values.pointer, count);
        let written = values.items.iter().filter(|&&value| value != BLANK).count();
        assert_eq!(written, if status == Status::Ok { count } else { 0 }, "{:?}", values.items);
        assert!(values.items.iter().all(|value| value.is_finite()), "{:?}", values.items);
        status
    }

    /// A place for one value, or NULL.
    pub fn place<T: Copy>(&mut self, random: &mut Random, value: T) -> Array<T> {
        let place = Array::new(random, vec![value], value);
        self.unsound |= !place.sound;
        place
    }

    /// One of the saved states, or NULL.
    pub fn any_saved(&mut self, random: &mut Random) -> Option<Saved> {
        let null = self.saved.is_empty() || random.below(RARELY) == 0;
        self.unsound |= null;
        (!null).then(|| self.saved[random.below(self.saved.len() as u64) as usize].clone())
    }

    /// All that can be seen of the instance: its state, or else its values.
    pub fn bytes(&self) -> Vec<u8> {
        if M::Simulation::SAVING.is_none() {
            let (_, values) = self.slave.reals(&all_reals::<M>());
            return values.into_iter().flat_map(f64::to_le_bytes).collect();
        }
        let state = self.slave.save();
        let bytes = self.slave.bytes(state);
        self.slave.free(state);
        bytes
    }

    /// The state after a call that the standard allows.
    pub fn advance(&mut self, name: &str, status: Status) {
        self.phase = match (name, status) {
            ("fmi2EnterInitializationMode", Status::Ok) => Phase::InitializationMode,
            ("fmi2ExitInitializationMode", Status::Ok) if self.exchange => Phase::EventMode,
            ("fmi2ExitInitializationMode", Status::Ok) => Phase::StepComplete,
            ("fmi2EnterEventMode", Status::Ok) => Phase::EventMode,
            ("fmi2EnterContinuousTimeMode", Status::Ok) => Phase::ContinuousTimeMode,
            ("fmi2ExitInitializationMode", _) => Phase::Error,
            ("fmi2DoStep", Status::Discard) => Phase::StepFailed,
            ("fmi2Terminate", Status::Ok) => Phase::Terminated,
            ("fmi2Reset", Status::Ok) => Phase::Instantiated,
            _ => self.phase,
        };
        match (name, status) {
            ("fmi2Reset", _) => self.has_experiment = false,
            ("fmi2SetupExperiment", Status::Ok) => self.has_experiment = true,
            _ => {}
        }
    }
}
