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
//! | 16 | [`MODEL_HASH`] |
//! | 1 | state in the standard's table |
//! | 1 | flags |
//! | 8 each | stop time, time, tolerance, step proposal, states, derivatives of the inputs by order |
//! | 8 each | inputs and parameters by row |
//! | 8 | FNV-1a of all before |

use crate::flight::{Flight, INPUT_ORDER, INPUTS, Snapshot};
use crate::fmi::failure::Failure;
use crate::fmi::instance::{LARGEST, Life, TOLERANCES};
use crate::fmi::lifecycle::{PHASES, Phase};
use crate::variables::{MODEL_HASH, Role, TABLE, Variable};
use crate::vehicle::STATES;

const MAGIC: [u8; 8] = *b"AHVSTATE";
const VERSION: u32 = 4;
const HEADER: usize = 8 + 4 + 4 + 16;
const CHECKSUM: usize = 8;
/// Stop time, time, tolerance, step proposal.
const CLOCK: usize = 4;

const EXPERIMENT: u8 = 1 << 0;
const ENDED: u8 = 1 << 1;
const INITIALISED: u8 = 1 << 2;
const AHEAD: u8 = 1 << 3;

/// All that has to be remembered of an instance.
#[derive(Debug, Clone, PartialEq)]
pub struct FmuState {
    /// The flight.
    pub flight: Snapshot,
    /// The lifecycle.
    pub life: Life,
}

fn settable() -> impl Iterator<Item = &'static Variable> {
    TABLE.iter().filter(|variable| variable.settable())
}

/// 64-bit FNV-1a (Fowler, Noll, Vo). Each step is a bijection, so any change within one byte shows.
fn checksum(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

impl FmuState {
    /// Length of [`FmuState::encode`]'s result, the same for every state.
    pub fn encoded_len() -> usize {
        HEADER + 2 + 8 * (CLOCK + STATES + INPUTS * INPUT_ORDER + settable().count()) + CHECKSUM
    }

    /// The bytes. `pristine` is any flight of this model.
    pub fn encode(&self, pristine: &Flight) -> Vec<u8> {
        let Self { flight, life } = self;
        let length = Self::encoded_len();
        let mut bytes = Vec::with_capacity(length);
        bytes.extend(MAGIC);
        bytes.extend(VERSION.to_le_bytes());
        bytes.extend((length as u32).to_le_bytes());
        bytes.extend(MODEL_HASH.to_le_bytes());
        let flag = |on: bool, bit: u8| if on { bit } else { 0 };
        bytes.push(life.phase as u8);
        bytes.push(
            flag(life.stop.is_some(), EXPERIMENT)
                | flag(life.ended, ENDED)
                | flag(flight.initialised, INITIALISED)
                | flag(flight.inputs.ahead, AHEAD),
        );
        let integrator = &flight.integrator;
        let clock =
            [life.stop.unwrap_or(0.0), flight.time, integrator.tolerance, integrator.proposal];
        // The table's rows read values from a flight: give them one with these.
        let mut scratch = pristine.clone();
        scratch.change(|parameters| *parameters = flight.parameters);
        for (i, &input) in flight.inputs.values.iter().enumerate() {
            scratch.set_input(i, input);
        }
        let rows = settable().map(|variable| variable.get(&scratch));
        let courses = flight.inputs.derivatives.into_iter().flatten();
        for number in clock.into_iter().chain(flight.state).chain(courses).chain(rows) {
            bytes.extend(number.to_le_bytes());
        }
        bytes.extend(checksum(&bytes).to_le_bytes());
        bytes
    }

    /// The state that was encoded.
    ///
    /// # Errors
    /// [`Failure::Bytes`] unless the bytes are whole, unchanged and of this model.
    pub fn decode(bytes: &[u8], pristine: &Flight) -> Result<Self, Failure> {
        decode(bytes, pristine)
            .map_err(|problem| Failure::Bytes { length: bytes.len(), problem: problem.to_string() })
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
}

fn decode(bytes: &[u8], pristine: &Flight) -> Result<FmuState, String> {
    let expect = |right: bool, problem: &str| right.then_some(()).ok_or(problem.to_string());
    let mut reader = Reader(bytes);
    expect(reader.take()? == MAGIC, "they do not begin like one")?;
    expect(u32::from_le_bytes(reader.take()?) == VERSION, "their layout has another version")?;
    let length = u32::from_le_bytes(reader.take()?) as usize;
    expect(length == bytes.len(), "their length is not the one they state")?;
    expect(length == FmuState::encoded_len(), "their length is not that of this model's states")?;
    expect(u128::from_le_bytes(reader.take()?) == MODEL_HASH, "they belong to another model")?;
    let (body, sum) = bytes.split_at(length - CHECKSUM);
    expect(checksum(body).to_le_bytes() == sum, "their checksum does not match")?;

    // The checksum shows damage; the checks below refuse bytes that were made up.
    let [phase, flags] = reader.take()?;
    let phase = *PHASES.get(usize::from(phase)).ok_or("their lifecycle state does not exist")?;
    expect(
        !matches!(phase, Phase::StepInProgress | Phase::StepCanceled | Phase::Fatal),
        "their lifecycle state cannot be saved",
    )?;
    let flag = |bit: u8| flags & bit != 0;
    let stop = reader.number()?;
    let mut flight = pristine.snapshot();
    flight.initialised = flag(INITIALISED);
    flight.time = reader.number()?;
    flight.integrator.tolerance = reader.number()?;
    flight.integrator.proposal = reader.number()?;
    let courses = flight.inputs.derivatives.iter_mut().flatten();
    for number in flight.state.iter_mut().chain(courses) {
        *number = reader.number()?;
    }
    let [least, largest] = TOLERANCES;
    // Behind the step that they were for, they are what it made of them.
    let fastest = if flag(AHEAD) { LARGEST } else { f64::MAX };
    expect(
        !stop.is_nan()
            && flight.time.is_finite()
            && (least..=largest).contains(&flight.integrator.tolerance)
            && flight.integrator.proposal > 0.0
            && flight.integrator.proposal.is_finite()
            && flight.state.iter().all(|state| state.is_finite())
            && flight.inputs.derivatives.iter().flatten().all(|rate| rate.abs() <= fastest),
        "they hold numbers that no instance has",
    )?;
    let mut scratch = pristine.clone();
    for variable in settable() {
        let value = reader.number()?;
        match variable.role {
            // Within a step it may leave the range in which it can be set.
            Role::Input(number) => {
                expect(value.is_finite(), &format!("{} = {value} in them", variable.name))?;
                flight.inputs.values[number] = value;
            }
            _ => variable.set(&mut scratch, value).map_err(|error| error.to_string())?,
        }
    }
    flight.parameters = *scratch.parameters();
    flight.inputs.ahead = flag(AHEAD);
    let stop = flag(EXPERIMENT).then_some(stop);
    Ok(FmuState { flight, life: Life { phase, stop, ended: flag(ENDED) } })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_state_takes_at_most_one_kilobyte() {
        assert!(FmuState::encoded_len() <= 1024, "{}", FmuState::encoded_len());
    }

    #[test]
    fn made_up_numbers_are_refused_even_with_a_right_checksum() {
        let pristine = Flight::new().unwrap();
        let life = Life { phase: Phase::StepComplete, stop: Some(f64::INFINITY), ended: false };
        let good = FmuState { flight: pristine.snapshot(), life };
        let again = |state: &FmuState| FmuState::decode(&state.encode(&pristine), &pristine);
        assert_eq!(again(&good).as_ref(), Ok(&good));
        type Forgery = fn(&mut FmuState);
        let forgeries: [Forgery; 9] = [
            |s| s.life.phase = Phase::Fatal,
            |s| s.life.phase = Phase::StepInProgress,
            |s| s.life.stop = Some(f64::NAN),
            |s| s.flight.time = f64::INFINITY,
            |s| s.flight.integrator.tolerance = 0.0,
            |s| s.flight.integrator.proposal = -1.0,
            |s| s.flight.state[0] = f64::NAN,
            |s| s.flight.inputs.derivatives[1][0] = f64::INFINITY,
            |s| s.flight.parameters.build.condition.mach = f64::MAX,
        ];
        for forge in forgeries {
            let mut forged = good.clone();
            forge(&mut forged);
            assert!(matches!(again(&forged), Err(Failure::Bytes { .. })));
        }
    }
}
