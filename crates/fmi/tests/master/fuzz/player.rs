//! The master that plays: its instance, what it knows of it, and the arguments it passes.

use super::super::{Api, Random, Slave, all_reals, parts};
use fmi_model::instance::Interface;
use fmi_model::phase::Phase;
use fmi_model::standard::Standard;
use fmi_model::status::Status;
use fmi_model::{Kind, Model, Simulation, Variable, table};
use std::collections::BTreeMap;
use std::ffi::c_void;
use std::fmt::Debug;
use std::ptr::null_mut;
use std::rc::Rc;

/// One argument in so many is unsound, of each kind of fault.
pub const RARELY: u64 = 24;
/// What stands where a function has not written: no value of any variable.
pub const BLANK: f64 = -1.234e-77;
pub const BLANK_INTEGER: i32 = -77_777;
/// Value reference of the independent variable of FMI 3.0.
const TIME: u32 = 2_147_483_647;

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
    pub state: *mut c_void,
    pub phase: Phase,
    pub has_experiment: bool,
    pub bytes: Vec<u8>,
}

/// What can be seen of an instance: its state, if it can be saved, or else the values that can be read.
pub enum Seen {
    Saved(u8, Vec<u8>),
    Values(Vec<(u32, u64)>),
}

impl Seen {
    /// Whether nothing has changed but the state by number; a value that is not known of both counts for nothing.
    pub fn same(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Saved(_, one), Self::Saved(_, other)) => one == other,
            (Self::Values(one), Self::Values(other)) => {
                let values: BTreeMap<_, _> = other.iter().copied().collect();
                one.iter().all(|(i, value)| values.get(i).is_none_or(|other| other == value))
            }
            _ => panic!("seen in two ways"),
        }
    }
}

/// An instance, the state in which it has to be, and FMU states with theirs.
pub struct Player<'a, A: Api> {
    pub slave: Rc<Slave<'a, A>>,
    pub interface: Interface,
    /// The instance, or NULL, for the next call.
    pub c: *mut c_void,
    pub phase: Phase,
    pub has_experiment: bool,
    pub saved: Vec<Saved>,
    /// Whether the last call had an argument that has to be refused.
    pub unsound: bool,
    /// Whether the last step ended the simulation.
    pub ended: bool,
    /// Whether a step is under way, and what was done within the last one.
    pub within: bool,
    pub looked: bool,
}

pub fn real<M: Model>(variable: &Variable<M>) -> bool {
    matches!(variable.kind, Kind::Real(_))
}

pub fn integer<M: Model>(variable: &Variable<M>) -> bool {
    matches!(variable.kind, Kind::Integer | Kind::Enumeration(..))
}

pub fn boolean<M: Model>(variable: &Variable<M>) -> bool {
    matches!(variable.kind, Kind::Boolean)
}

type Kinds<M> = fn(&Variable<M>) -> bool;

impl<'a, A: Api> Player<'a, A> {
    pub fn new(slave: Slave<'a, A>, interface: Interface) -> Self {
        let (c, phase, no) = (slave.c, Phase::Instantiated, false);
        Self {
            slave: Rc::new(slave),
            interface,
            c,
            phase,
            has_experiment: no,
            saved: Vec::new(),
            unsound: no,
            ended: no,
            within: no,
            looked: no,
        }
    }

    /// Value references: half of the arrays have fitting ones only, the others whatever comes.
    pub fn references(random: &mut Random, kinds: Kinds<A::Model>, settable: bool) -> Vec<u32> {
        let variables = A::Model::VARIABLES;
        let fit = |i: &u32| {
            let variable = &variables[*i as usize];
            kinds(variable) && (!settable || variable.settable())
        };
        let fitting: Vec<_> = (0..variables.len() as u32).filter(fit).collect();
        let any = random.below(2) == 0 || fitting.is_empty();
        let one = |random: &mut Random| match any {
            true => match random.below(variables.len() as u64 + 3) as u32 {
                beyond if beyond as usize > variables.len() + 1 => TIME,
                reference => reference,
            },
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

    /// A getter: all values are written or none, and nothing behind them. The status, and what was read of which
    /// variable.
    pub fn read<T: Copy + PartialEq + Debug>(
        &mut self,
        random: &mut Random,
        kinds: Kinds<A::Model>,
        blank: T,
        call: impl FnOnce(*mut c_void, *const u32, usize, *mut T) -> Status,
    ) -> (Status, Vec<(u32, T)>) {
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
        let read = references.items.into_iter().zip(values.items);
        (status, read.take(written).collect())
    }

    /// A setter: what it accepts is what the getter gives.
    pub fn write<T: Copy + PartialEq + Debug>(
        &mut self,
        random: &mut Random,
        kinds: Kinds<A::Model>,
        element: fn(&mut Random) -> T,
        as_read: fn(T) -> T,
        set: impl FnOnce(*mut c_void, *const u32, usize, *const T) -> Status,
        get: impl Fn(*mut c_void, *const u32, usize, *mut T) -> Status,
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
                let (expected, name) =
                    (as_read(given[last]), A::Model::VARIABLES[*reference as usize].name);
                let texts = [found, expected].map(|value| format!("{value:?}"));
                // NaN reads as NaN.
                assert!(found == expected || texts[0] == texts[1], "{name}: {texts:?}");
            }
        }
        status
    }

    /// A getter of one number for each state.
    pub fn read_states(
        &mut self,
        random: &mut Random,
        call: impl FnOnce(*mut c_void, *mut f64, usize) -> Status,
    ) -> Status {
        let states = table::states::<A::Model>();
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

    /// What can be seen of the instance. An output may not be asked for before the start: the refusal would
    /// end a run of FMI 3.0.
    pub fn seen(&self) -> Seen {
        if <A::Model as Model>::Simulation::SAVING.is_some() && !self.within {
            let (phase, rest) = parts(self.slave.present());
            return Seen::Saved(phase, rest);
        }
        let mut references = all_reals::<A::Model>();
        if [Phase::Instantiated, Phase::InitializationMode, Phase::Error].contains(&self.phase) {
            references.retain(|&i| A::Model::VARIABLES[i as usize].settable());
        }
        let (_, values) = self.slave.reals(&references);
        Seen::Values(references.into_iter().zip(values.into_iter().map(f64::to_bits)).collect())
    }

    /// The state after a call with an instance, which the standard allows or not.
    pub fn advance(&mut self, name: &str, status: Status, allowed: bool) {
        let ends_run = A::STANDARD == Standard::Fmi3 && status == Status::Error;
        if ends_run || !allowed {
            self.phase = if ends_run { Phase::Error } else { self.phase };
            return;
        }
        let (exchange, name) = (self.interface == Interface::ModelExchange, &name[4..]);
        self.phase = match (name, status) {
            ("EnterInitializationMode", Status::Ok) => Phase::InitializationMode,
            ("ExitInitializationMode", Status::Ok) if exchange => Phase::EventMode,
            ("ExitInitializationMode", Status::Ok) => Phase::StepComplete,
            ("EnterEventMode", Status::Ok) => Phase::EventMode,
            ("EnterContinuousTimeMode", Status::Ok) => Phase::ContinuousTimeMode,
            ("ExitInitializationMode", _) => Phase::Error,
            ("DoStep", Status::Discard) if A::STANDARD == Standard::Fmi2 => Phase::StepFailed,
            ("DoStep", Status::Ok) if self.ended => Phase::StepFailed,
            ("Terminate", Status::Ok) => Phase::Terminated,
            ("Reset", Status::Ok) => Phase::Instantiated,
            _ => self.phase,
        };
        match (name, status) {
            ("Reset", _) => self.has_experiment = false,
            ("SetupExperiment", Status::Ok) => self.has_experiment = true,
            _ => {}
        }
    }
}
