//! A block with the input `u` and the output `y` as its master flies it: for the tests of such models.
#![allow(dead_code)]

use fmi_model::failure::Failure;
use fmi_model::instance::{Instance, Interface};
use fmi_model::{Kind, Model, table};

/// Value reference of a variable.
pub fn reference<M: Model>(name: &str) -> u32 {
    M::VARIABLES.iter().position(|variable| variable.name == name).expect(name) as u32
}

/// Sets variables of any type.
pub fn set<M: Model>(block: &mut Instance<M>, values: &[(&str, f64)]) -> Result<(), Failure> {
    values.iter().try_for_each(|&(name, value)| {
        let reference = [reference::<M>(name)];
        match table::find::<M>(name).expect(name).kind {
            Kind::Real(_) => block.set_real(&reference, &[value]),
            _ => block.set_integer(&reference, &[value as i32]),
        }
    })
}

/// A block with these values that starts at a time, s.
pub fn start<M: Model>(values: &[(&str, f64)], time: f64) -> Result<Instance<M>, Failure> {
    let mut block = Instance::new(Interface::CoSimulation, true)?;
    begin(&mut block, values, time)?;
    Ok(block)
}

/// Starts a block that is new or was reset.
pub fn begin<M: Model>(
    block: &mut Instance<M>,
    values: &[(&str, f64)],
    time: f64,
) -> Result<(), Failure> {
    set(block, values)?;
    block.setup_experiment(None, time, None)?;
    block.enter_initialization_mode()?;
    block.exit_initialization_mode()
}

/// The same at time 0, which nothing refuses.
pub fn started<M: Model>(values: &[(&str, f64)]) -> Instance<M> {
    start(values, 0.0).expect("a start")
}

/// A value.
pub fn get<M: Model>(block: &mut Instance<M>, name: &str) -> f64 {
    let mut found = 0.0;
    block.get_real(&[reference::<M>(name)], |_, value| found = value).expect(name);
    found
}

/// The output.
pub fn y<M: Model>(block: &mut Instance<M>) -> f64 {
    get(block, "y")
}

/// Sets the input, which moves at a slope (1/s) within the next step.
pub fn input<M: Model>(block: &mut Instance<M>, value: f64, slope: f64) {
    set(block, &[("u", value)]).expect("an input");
    block.set_input_derivatives(&[reference::<M>("u")], &[1], &[slope]).expect("a slope");
}

/// Steps to a time, s.
pub fn step_to<M: Model>(block: &mut Instance<M>, end: f64) {
    let time = block.time();
    block.do_step(time, end - time).expect("a step");
}

/// The block, by way of the bytes of its state, in another instance.
pub fn moved<M: Model>(block: &Instance<M>) -> Instance<M> {
    let bytes = block.state().and_then(|state| state.encode()).expect("bytes of a state");
    let mut other = started::<M>(&[]);
    let state = other.deserialize(&bytes).expect("a state");
    other.set_state(&state).expect("a state that can be set");
    other
}

/// What it has said, once.
pub fn heard<M: Model>(block: &mut Instance<M>) -> Vec<String> {
    block.log.take().into_iter().map(|message| message.text).collect()
}

/// Bytes of a state with another number at a place among its numbers, and the right checksum (64-bit FNV-1a).
pub fn forged(bytes: &[u8], number: usize, value: f64) -> Vec<u8> {
    /// Magic, version, length, identity, phase, flags; start, stop, tolerance.
    const FIRST: usize = 8 + 4 + 4 + 16 + 2 + 3 * 8;
    let (mut forged, end) = (bytes.to_vec(), bytes.len() - 8);
    let at = FIRST + 8 * number;
    forged[at..at + 8].copy_from_slice(&value.to_le_bytes());
    let sum = forged[..end].iter().fold(0xcbf2_9ce4_8422_2325_u64, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    });
    forged[end..].copy_from_slice(&sum.to_le_bytes());
    forged
}
