//! Random sequences of legal and illegal calls with sound and unsound arguments, for any model.
//!
//! `AHV_FUZZ=<number of sequences>` tries another number than `cargo test` does.

mod player;
mod shared;
mod v2;
mod v3;

use super::{Api, Random, Slave};
use fmi_model::instance::Interface;
use fmi_model::phase::Phase;
use fmi_model::standard::Standard;
use fmi_model::status::Status;
use fmi_model::{Model, Simulation};
use player::{Player, RARELY, Seen};
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

/// How a version of the standard is played.
pub trait Game: Api {
    /// Every function that works on an instance: one row each.
    fn plays() -> Vec<(&'static str, Play<Self>)>;
    /// One call in so many moves the lifecycle on: the more, the more often a refusal ends the run.
    const ONWARD: u64;
    /// The function that moves the lifecycle on, so that sequences get beyond their first states.
    fn onward(player: &Player<Self>) -> &'static str;
    /// A new instance; some of FMI 3.0 let their master look in within a step.
    fn instance(api: &Self, interface: Interface, seed: u64) -> Slave<'_, Self>;
}

/// Makes one call. What is known of its result is checked there.
pub type Play<A> = fn(&mut Player<'_, A>, &mut Random) -> Status;

/// Functions that leave the instance as it is, whatever they return. In initialization mode a
/// getter may compute the initial state.
fn only_looks(name: &str, phase: Phase) -> bool {
    let name = &name[4..];
    (name.starts_with("Get") && phase != Phase::InitializationMode)
        || name.to_ascii_lowercase().contains("serialize")
        || ["FreeFMUstate", "FreeFMUState", "SetDebugLogging"].contains(&name)
}

/// What came out of all calls.
#[derive(Debug, Default)]
struct Tally {
    done: u64,
    discarded: u64,
    refused: u64,
    /// Steps within which the master did something.
    looked: u64,
    phases: BTreeSet<u8>,
}

/// Plays one function, and checks what is true of all: order, message, nothing changed by a refusal.
fn play_one<A: Game>(player: &mut Player<A>, random: &mut Random, name: &'static str) -> Status {
    let plays = A::plays();
    let (_, play) = plays.iter().find(|(known, _)| *known == name).expect(name);
    let call = A::CALLS.iter().find(|call| call.name == name).expect(name);
    let (before, phase) = (player.seen(), player.phase);
    let no_instance = random.below(RARELY) == 0;
    player.c = if no_instance { null_mut() } else { player.slave.c };
    (player.unsound, player.ended, player.looked) = (false, false, false);
    let mut allowed = call.allowed_in(phase) && !no_instance;
    allowed &= call.interface.is_none_or(|only| only == player.interface);
    if name == "fmi2EnterInitializationMode" {
        allowed &= player.has_experiment;
    }
    player.slave.log();
    let status = play(player, random);
    let log = player.slave.log();
    let legal = allowed && !player.unsound;
    let scene = || format!("{name} in {phase:?}: {status:?} {log:?}");
    assert!([Status::Ok, Status::Discard, Status::Error].contains(&status), "{}", scene());
    assert!(legal || status != Status::Ok, "{}", scene());
    assert!(allowed || status == Status::Error, "{}", scene());
    // What is not done is said once, with its reason.
    let complaints: Vec<_> = log.iter().filter(|record| record.status != Status::Ok).collect();
    let ends = (name.ends_with("CompletedIntegratorStep") || player.ended) && status == Status::Ok;
    assert!(
        complaints.len() == usize::from(status != Status::Ok && !no_instance || player.ended)
            || ends && complaints.len() == 1,
        "{}",
        scene()
    );
    for record in complaints {
        let reason = record.message.split_once(": ").map_or("", |(_, reason)| reason);
        let expected = if ends { Status::Discard } else { status };
        assert!(reason.len() > 10 && record.status == expected, "{}", scene());
    }
    if !no_instance {
        player.advance(name, status, allowed);
    }
    let after = player.seen();
    let mute =
        A::STANDARD == Standard::Fmi3 && status == Status::Discard || status == Status::Error;
    let fails = name.ends_with("ExitInitializationMode") && allowed || player.looked;
    if only_looks(name, phase) || mute && !fails {
        assert!(before.same(&after), "{} changed something", scene());
    }
    if let Seen::Saved(number, _) = after {
        assert_eq!(number, player.phase as u8, "{}", scene());
    }
    status
}

fn play_sequence<A: Game>(api: &A, seed: u64, tally: &mut Tally) {
    let mut random = Random(seed);
    let exchange = <A::Model as Model>::Simulation::EXCHANGE.is_some() && seed % 2 == 1;
    let interface = if exchange { Interface::ModelExchange } else { Interface::CoSimulation };
    let mut player = Player::new(A::instance(api, interface, seed), interface);
    for _ in 0..CALLS_PER_SEQUENCE {
        let name = match random.below(A::ONWARD) {
            0 => A::onward(&player),
            _ => random.pick(&A::plays()).0,
        };
        match play_one(&mut player, &mut random, name) {
            Status::Ok => tally.done += 1,
            Status::Discard => tally.discarded += 1,
            _ => tally.refused += 1,
        }
        tally.phases.insert(player.phase as u8);
        tally.looked += u64::from(player.looked);
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

pub fn assert_every_function_is_played<A: Game>() {
    let played: BTreeSet<_> = A::plays().iter().map(|(name, _)| *name).collect();
    let known: BTreeSet<_> = A::CALLS.iter().map(|call| call.name).collect();
    assert_eq!(played, known);
}

/// Plays. A good number of sequences gets to so many states of the standard's table.
pub fn play<A: Game>(states: usize) {
    let api = A::load();
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
    let looked = sum(|t| t.looked);
    println!(
        "{sequences} sequences: {done} calls done, {discarded} discarded, {refused} refused; \
         looked into {looked} steps"
    );
    assert_eq!(done + discarded + refused, sequences * CALLS_PER_SEQUENCE);
    let phases: BTreeSet<u8> = tallies.into_iter().flat_map(|tally| tally.phases).collect();
    let enough = sequences >= 1000;
    assert!(phases.len() == states || !enough, "all states that can be reached were: {phases:?}");
}
