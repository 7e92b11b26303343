//! The FMU state: plain numbers, no pointers, so it fits any instance of the same model, in any
//! process, on any platform.
//!
//! Bytes, little-endian:
//!
//! | bytes | content |
//! |---|---|
//! | 8 | magic |
//! | 4 | version of this layout |
//! | 4 | length of everything |
//! | 16 | [`Model::identity`] |
//! | 1 | [`Phase`] |
//! | 1 | flags |
//! | 8 each | start time, stop time, tolerance |
//! | 8 each | the simulation's numbers or, before it starts, inputs and their derivatives; then zeros |
//! | 8 each | parameters by row |
//! | 8 | FNV-1a of all before |

use crate::failure::{Failure, Outcome};
use crate::instance::{Experiment, Instance, Interface, LARGEST, Life, start};
use crate::model::{Model, Saving, Simulation};
use crate::pending::Pending;
use crate::phase::{PHASES, Phase};
use crate::table::inputs;
use crate::variable::{Role, Variable};

const MAGIC: [u8; 8] = *b"FMUSTATE";
const VERSION: u32 = 1;
const HEADER: usize = 8 + 4 + 4 + 16;
const FLAGS: usize = 2;
const EXPERIMENT_NUMBERS: usize = 3;
const CHECKSUM: usize = 8;

const EXPERIMENT: u8 = 1 << 0;
const ENDED: u8 = 1 << 1;
const STARTED: u8 = 1 << 2;
const MOVING: u8 = 1 << 3;

/// What is remembered of the simulation.
#[derive(Debug, Clone, PartialEq)]
enum Memory {
    /// It has not started: the inputs that were set.
    Pending(Pending),
    /// The numbers of [`Saving`].
    Started(Vec<f64>),
}

/// All that has to be remembered of an instance.
#[derive(Debug, Clone, PartialEq)]
pub struct FmuState<M> {
    model: M,
    life: Life,
    memory: Memory,
}

fn saving<M: Model>() -> Result<&'static Saving<M::Simulation>, Failure> {
    let saving: &Option<Saving<M::Simulation>> = &M::Simulation::SAVING;
    let missing = Failure::NotProvided { capability: "that its state can be saved" };
    saving.as_ref().ok_or(missing)
}

impl<M: Model> Instance<M> {
    /// `fmi2GetFMUstate`.
    ///
    /// # Errors
    /// [`Failure::NotProvided`].
    pub fn state(&self) -> Result<FmuState<M>, Failure> {
        let saving = saving::<M>()?;
        let memory = match &self.simulation {
            // Until the end of initialisation a simulation follows from parameters and inputs.
            Some(simulation) if !self.before_start() => {
                let mut numbers = Vec::with_capacity(saving.count);
                (saving.save)(simulation, &mut numbers);
                Memory::Started(numbers)
            }
            _ => Memory::Pending(self.pending.clone()),
        };
        Ok(FmuState { model: self.model.clone(), life: self.life, memory })
    }

    /// `fmi2SetFMUstate`: becomes the instance that the state was taken of, bit for bit. A simulation
    /// with the same parameters is kept: a master that repeats steps does this often.
    ///
    /// # Errors
    /// [`Failure::NotProvided`], [`Failure::OtherInterface`]; [`Failure::Model`] if the simulation cannot
    /// be started. The instance is then as it was.
    pub fn set_state(&mut self, state: &FmuState<M>) -> Outcome {
        let saving = saving::<M>()?;
        let other = match state.life.phase {
            Phase::StepComplete | Phase::StepFailed => Some(Interface::CoSimulation),
            Phase::EventMode | Phase::ContinuousTimeMode => Some(Interface::ModelExchange),
            _ => None,
        };
        if let Some(interface) = other.filter(|&interface| interface != self.interface) {
            return Err(Failure::OtherInterface { interface });
        }
        match &state.memory {
            Memory::Pending(pending) => {
                self.pending = pending.clone();
                self.simulation = None;
            }
            Memory::Started(numbers) => {
                let simulation = match &mut self.simulation {
                    Some(simulation) if self.model == state.model => simulation,
                    slot => slot.insert(start(&state.model, state.life.experiment)?),
                };
                (saving.load)(simulation, numbers);
            }
        }
        self.model = state.model.clone();
        self.life = state.life;
        Ok(())
    }

    /// `fmi2DeSerializeFMUstate`.
    ///
    /// # Errors
    /// [`Failure::NotProvided`]; [`Failure::Bytes`] unless the bytes are whole, unchanged and of this
    /// model.
    pub fn deserialize(&self, bytes: &[u8]) -> Result<FmuState<M>, Failure> {
        let saving = saving::<M>()?;
        decode(bytes, &self.pristine, saving)
            .map_err(|problem| Failure::Bytes { length: bytes.len(), problem })
    }
}

fn parameters<M: Model>() -> impl Iterator<Item = &'static Variable<M>> {
    M::VARIABLES.iter().filter(|variable| matches!(variable.role, Role::Parameter { .. }))
}

/// Whether the input of this number takes NaN and infinities.
fn input_accepts_any<M: Model>(number: usize) -> bool {
    let is_input = |variable: &&Variable<M>| matches!(variable.role, Role::Input(i) if i == number);
    M::VARIABLES.iter().find(is_input).is_some_and(|input| input.accepts_non_finite)
}

/// Highest order of the derivatives of inputs.
fn highest<M: Model>() -> usize {
    M::Simulation::INPUT_DERIVATIVES.map_or(0, |moving| moving.highest)
}

/// Numbers that the simulation or the inputs before it take.
fn room<M: Model>(saving: &Saving<M::Simulation>) -> usize {
    saving.count.max(inputs::<M>() * (1 + highest::<M>()))
}

/// Length of the bytes, the same for every state of a model.
fn encoded_len<M: Model>(saving: &Saving<M::Simulation>) -> usize {
    let numbers = EXPERIMENT_NUMBERS + room::<M>(saving) + parameters::<M>().count();
    HEADER + FLAGS + 8 * numbers + CHECKSUM
}

/// 64-bit FNV-1a (Fowler, Noll, Vo). Each step is a bijection, so any change within one byte shows.
fn checksum(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

impl<M: Model> FmuState<M> {
    /// `fmi2SerializedFMUstateSize`: the length of [`FmuState::encode`]'s result, the same for every
    /// state.
    ///
    /// # Errors
    /// [`Failure::NotProvided`].
    pub fn encoded_len() -> Result<usize, Failure> {
        saving::<M>().map(encoded_len::<M>)
    }

    /// `fmi2SerializeFMUstate`.
    ///
    /// # Errors
    /// [`Failure::NotProvided`].
    pub fn encode(&self) -> Result<Vec<u8>, Failure> {
        let saving = saving::<M>()?;
        let Self { model, life, memory } = self;
        let length = encoded_len::<M>(saving);
        let mut bytes = Vec::with_capacity(length);
        bytes.extend(MAGIC);
        bytes.extend(VERSION.to_le_bytes());
        bytes.extend((length as u32).to_le_bytes());
        bytes.extend(model.identity().to_le_bytes());
        bytes.push(life.phase as u8);
        let flag = |on: bool, bit: u8| if on { bit } else { 0 };
        let moving = matches!(memory, Memory::Pending(Pending { derivatives: Some(_), .. }));
        bytes.push(
            flag(life.experiment.is_some(), EXPERIMENT)
                | flag(life.ended, ENDED)
                | flag(matches!(memory, Memory::Started(_)), STARTED)
                | flag(moving, MOVING),
        );
        let experiment = life.experiment.map_or([0.0; EXPERIMENT_NUMBERS], |experiment| {
            [experiment.start, experiment.stop, experiment.tolerance]
        });
        let (first, second): (&[f64], &[f64]) = match memory {
            Memory::Started(numbers) => (numbers, &[]),
            Memory::Pending(Pending { values, derivatives }) => {
                (values, derivatives.as_deref().unwrap_or_default())
            }
        };
        let gap = room::<M>(saving) - first.len() - second.len();
        let parameters = parameters::<M>().map(|parameter| match parameter.role {
            Role::Parameter { get, .. } => get(model),
            _ => 0.0,
        });
        let memory = first.iter().chain(second).copied().chain(std::iter::repeat_n(0.0, gap));
        for number in experiment.into_iter().chain(memory).chain(parameters) {
            bytes.extend(number.to_le_bytes());
        }
        bytes.extend(checksum(&bytes).to_le_bytes());
        Ok(bytes)
    }
}

/// Takes bytes from the front.
struct Reader<'a>(&'a [u8]);

impl Reader<'_> {
    fn take<const N: usize>(&mut self) -> Result<[u8; N], String> {
        let (head, tail) = self.0.split_first_chunk().ok_or("they end too early")?;
        self.0 = tail;
        Ok(*head)
    }

    fn number(&mut self) -> Result<f64, String> {
        self.take().map(f64::from_le_bytes)
    }

    fn numbers(&mut self, count: usize) -> Result<Vec<f64>, String> {
        (0..count).map(|_| self.number()).collect()
    }
}

fn decode<M: Model>(
    bytes: &[u8],
    pristine: &M,
    saving: &Saving<M::Simulation>,
) -> Result<FmuState<M>, String> {
    let expect = |right: bool, problem: &str| right.then_some(()).ok_or(problem.to_string());
    let mut reader = Reader(bytes);
    expect(reader.take()? == MAGIC, "they do not begin like one")?;
    expect(u32::from_le_bytes(reader.take()?) == VERSION, "their layout has another version")?;
    let length = u32::from_le_bytes(reader.take()?) as usize;
    expect(length == bytes.len(), "their length is not the one they state")?;
    expect(length == encoded_len::<M>(saving), "their length is not that of this model's states")?;
    expect(
        u128::from_le_bytes(reader.take()?) == pristine.identity(),
        "they belong to another model",
    )?;
    let (body, sum) = bytes.split_at(length - CHECKSUM);
    expect(checksum(body).to_le_bytes() == sum, "their checksum does not match")?;

    // The checksum shows damage; the checks below refuse bytes that were made up.
    let [phase, flags] = reader.take()?;
    let phase = *PHASES.get(usize::from(phase)).ok_or("their lifecycle state does not exist")?;
    expect(
        !matches!(
            phase,
            Phase::StepInProgress
                | Phase::StepCanceled
                | Phase::Fatal
                | Phase::IntermediateUpdateMode
        ),
        "their lifecycle state cannot be saved",
    )?;
    const NOT_OURS: &str = "they hold numbers that no instance has";
    let flag = |bit: u8| flags & bit != 0;
    let experiment =
        Experiment { start: reader.number()?, stop: reader.number()?, tolerance: reader.number()? };
    let [least, largest] = M::TOLERANCES;
    let experiment = flag(EXPERIMENT).then_some(experiment);
    expect(
        experiment.is_none_or(|Experiment { start, stop, tolerance }| {
            start.is_finite() && stop >= start && (least..=largest).contains(&tolerance)
        }),
        NOT_OURS,
    )?;
    let mut numbers = reader.numbers(room::<M>(saving))?;
    let memory = if flag(STARTED) {
        numbers.truncate(saving.count);
        expect((saving.check)(&numbers), NOT_OURS)?;
        Memory::Started(numbers)
    } else {
        let inputs = inputs::<M>();
        let rates = numbers[inputs..].iter().take(inputs * highest::<M>());
        let derivatives: Vec<_> = rates.copied().collect();
        numbers.truncate(inputs);
        expect(
            numbers
                .iter()
                .enumerate()
                .all(|(i, value)| value.is_finite() || input_accepts_any::<M>(i))
                && derivatives.iter().all(|rate| rate.abs() <= LARGEST),
            NOT_OURS,
        )?;
        let derivatives = flag(MOVING).then_some(derivatives);
        Memory::Pending(Pending { values: numbers, derivatives })
    };
    let mut model = pristine.clone();
    for parameter in parameters::<M>() {
        parameter.set(&mut model, reader.number()?).map_err(|refused| refused.to_string())?;
    }
    Ok(FmuState { model, life: Life { phase, experiment, ended: flag(ENDED) }, memory })
}
