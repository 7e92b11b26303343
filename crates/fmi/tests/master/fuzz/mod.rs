//! Random sequences of legal and illegal calls with sound and unsound arguments, for any model.
//!
//! `AHV_FUZZ=<number of sequences>` tries another number than `cargo test` does.

mod player;
mod plays;

use super::{Api, Random};
use fmi_model::phase::{Call, Phase};
use fmi_model::v2::calls::CALLS;
use fmi_model::v2::sys::Status;
use fmi_model::{Model, Simulation};
use player::{Player, RARELY};
use plays::plays;
use std::collections::BTreeSet;
use std::io::{Write, stderr};
use std::ptr::null_mut;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
use std::thread::{self, ScopedJoinHandle};
use std::time::{Duration, Instant};

const SEQUENCES: u64 = 2_000;
const CALLS_PER_SEQUENCE: u64 = 40;
/// No sequence takes so long: the longest are steps of 1e300 s.
const HANGING: Duration = Duration::from_secs(600);

/// The function that moves the lifecycle on, so that sequences get beyond their first states.
fn onward<M: Model>(player: &Player<M>) -> &'static str {
    match player.phase {
        Phase::Instantiated if !player.has_experiment => "fmi2SetupExperiment",
        Phase::Instantiated => "fmi2EnterInitializationMode",
        Phase::InitializationMode => "fmi2ExitInitializationMode",
        Phase::StepComplete => "fmi2DoStep",
        Phase::EventMode => "fmi2EnterContinuousTimeMode",
        Phase::ContinuousTimeMode => "fmi2SetContinuousStates",
        _ => "fmi2Reset",
    }
}

/// Functions that leave the instance as it is, whatever they return. In initialization mode a
/// getter may compute the initial state.
fn only_looks(name: &str, phase: Phase) -> bool {
    (name.starts_with("fmi2Get") && phase != Phase::InitializationMode)
        || name.starts_with("fmi2Serialize")
        || ["fmi2DeSerializeFMUstate", "fmi2FreeFMUstate", "fmi2SetDebugLogging"].contains(&name)
}

/// What came out of all calls.
#[derive(Debug, Default)]
struct Tally {
    done: u64,
    discarded: u64,
    refused: u64,
    phases: BTreeSet<u8>,
}

fn call_named(name: &str) -> &'static Call {
    CALLS.iter().find(|call| call.name == name).expect(name)
}

fn play_sequence<M: Model>(api: &Api<M>, seed: u64, tally: &mut Tally) {
    let plays = plays::<M>();
    let mut random = Random(seed);
    let exchange = M::Simulation::EXCHANGE.is_some() && seed % 2 == 1;
    let mut player = Player::new(api, exchange);
    let mut before = player.bytes();
    for _ in 0..CALLS_PER_SEQUENCE {
        let name = match random.below(4) {
            0 => onward(&player),
            _ => random.pick(&plays).0,
        };
        let (_, play) = plays.iter().find(|(known, _)| *known == name).unwrap();
        let phase = player.phase;
        let no_instance = random.below(RARELY) == 0;
        player.c = if no_instance { null_mut() } else { player.slave.c };
        player.unsound = false;
        let mut allowed = call_named(name).allowed_in(phase) && !no_instance;
        if name == "fmi2EnterInitializationMode" {
            allowed &= player.has_experiment;
        }
        player.slave.log();
        let status = play(&mut player, &mut random);
        let log = player.slave.log();
        let legal = allowed && !player.unsound;
        let scene = || format!("seed {seed}: {name} in {phase:?}: {status:?} {log:?}");
        match status {
            Status::Ok => tally.done += 1,
            Status::Discard => tally.discarded += 1,
            Status::Error => tally.refused += 1,
            _ => panic!("{}", scene()),
        }
        assert!(legal || status != Status::Ok, "{}", scene());
        assert!(allowed || status == Status::Error, "{}", scene());
        // What is not done is said once, with its reason.
        let complaints: Vec<_> = log.iter().filter(|record| record.status != Status::Ok).collect();
        let ends = name == "fmi2CompletedIntegratorStep" && status == Status::Ok;
        assert!(
            complaints.len() == usize::from(status != Status::Ok && !no_instance)
                || ends && complaints.len() == 1,
            "{}",
            scene()
        );
        for record in complaints {
            let reason = record.message.split_once(": ").map_or("", |(_, reason)| reason);
            assert!(reason.len() > 10 && (record.status == status || ends), "{}", scene());
        }
        if allowed {
            player.advance(name, status);
        }
        tally.phases.insert(player.phase as u8);
        let after = player.bytes();
        let fails = name == "fmi2ExitInitializationMode" && allowed;
        if only_looks(name, phase) || status == Status::Error && !fails {
            assert!(before == after, "{} changed something", scene());
        }
        before = after;
    }
    for saved in std::mem::take(&mut player.saved) {
        player.slave.free(saved.state);
    }
}

/// Ends the process if a sequence does not end: a call that hangs would take the test with it.
fn watch<T>(running: &[ScopedJoinHandle<T>], playing: &[AtomicU64]) {
    let mut known: Vec<_> = playing.iter().map(|_| (0, Instant::now())).collect();
    while running.iter().any(|thread| !thread.is_finished()) {
        thread::sleep(Duration::from_millis(50));
        for ((thread, playing), (seed, since)) in running.iter().zip(playing).zip(&mut known) {
            let now = playing.load(Relaxed);
            if now != *seed || thread.is_finished() {
                (*seed, *since) = (now, Instant::now());
            } else if since.elapsed() > HANGING {
                // The test's own output is lost at an exit.
                let _ = writeln!(stderr(), "seed {seed} has not ended for {HANGING:?}");
                std::process::exit(1);
            }
        }
    }
}

pub fn assert_every_function_is_played<M: Model>() {
    let played: BTreeSet<_> = plays::<M>().iter().map(|(name, _)| *name).collect();
    let known: BTreeSet<_> = CALLS.iter().map(|call| call.name).collect();
    assert_eq!(played, known);
}

/// Plays. A good number of sequences gets to so many states of the standard's table.
pub fn play<M: Model>(states: usize) {
    let api = Api::<M>::load();
    let wanted = std::env::var("AHV_FUZZ").ok().map(|text| text.parse().expect("AHV_FUZZ"));
    let sequences = wanted.unwrap_or(SEQUENCES);
    let threads = thread::available_parallelism().map_or(1, usize::from) as u64;
    let playing: Vec<_> = (0..threads).map(AtomicU64::new).collect();
    let tallies: Vec<Tally> = thread::scope(|scope| {
        let running: Vec<_> = playing
            .iter()
            .zip(0..)
            .map(|(playing, first)| {
                let api = &api;
                scope.spawn(move || {
                    let mut tally = Tally::default();
                    for seed in (first..sequences).step_by(threads as usize) {
                        playing.store(seed, Relaxed);
                        play_sequence(api, seed, &mut tally);
                    }
                    tally
                })
            })
            .collect();
        watch(&running, &playing);
        running.into_iter().map(|thread| thread.join().unwrap()).collect()
    });
    let sum = |part: fn(&Tally) -> u64| tallies.iter().map(part).sum::<u64>();
    let (done, discarded, refused) = (sum(|t| t.done), sum(|t| t.discarded), sum(|t| t.refused));
    println!("{sequences} sequences: {done} calls done, {discarded} discarded, {refused} refused");
    assert_eq!(done + discarded + refused, sequences * CALLS_PER_SEQUENCE);
    let phases: BTreeSet<u8> = tallies.into_iter().flat_map(|tally| tally.phases).collect();
    let enough = sequences >= 1000;
    assert!(phases.len() == states || !enough, "all states that can be reached were: {phases:?}");
}
