//! FMU states of FMI 2.0: where the inputs went by their derivatives, and that the run has ended.

use crate::common::fmi2::{Api, Slave};
use crate::master::{Api as _, Random};
use fmi_model::status::Status;

/// Inputs that move at random, within what can be set, for one step.
fn steer(slave: &Slave, random: &mut Random) {
    for name in ["delta_e", "phi", "w_gust", "u_gust"] {
        let gust = name.ends_with("gust");
        let value =
            random.pick(&if gust { [0.0, -0.0, 199.9, -200.0] } else { [0.0, 0.02, -1e9, 1e300] });
        assert_eq!(slave.set(name, value), Status::Ok);
        for order in 0..random.below(4) as i32 {
            let rate = random.pick(&[0.0, 1e-3, -20.0, 20.0, 4e3, -1e12, 1e30]);
            assert_eq!(slave.set_input_derivative(name, order + 1, rate), Status::Ok);
        }
    }
}

#[test]
fn whatever_can_be_saved_can_be_restored_wherever_the_inputs_went() {
    let api = Api::load();
    let mut beyond = 0;
    for seed in 0..300 {
        let (slave, mut random) = (Slave::flying(&api), Random(seed));
        for _ in 0..4 {
            if seed == 0 {
                assert_eq!(slave.set("w_gust", 199.9), Status::Ok);
                assert_eq!(slave.set_input_derivative("w_gust", 1, 20.0), Status::Ok);
            } else {
                steer(&slave, &mut random);
            }
            let point = slave.time();
            let status = slave.step(point, random.pick(&[1e-3, 0.01, 0.05]));
            assert!([Status::Ok, Status::Discard].contains(&status), "{:?}", slave.log());
            beyond += u32::from(slave.get("w_gust").abs() > 200.0);
            let saved = slave.save();
            let bytes = slave.bytes(saved);
            slave.free(saved);
            let other = Slave::new(&api);
            let (read, state) = other.state_of(&bytes);
            assert_eq!(read, Status::Ok, "seed {seed}: {:?}", other.log());
            assert_eq!(other.bytes(state), bytes, "seed {seed}");
            assert_eq!(other.load(state), Status::Ok);
            other.free(state);
            assert_eq!(other.bits(), slave.bits(), "seed {seed}");
            if status == Status::Discard {
                break;
            }
        }
    }
    assert!(beyond > 50, "gusts that their derivatives led beyond their range: {beyond}");
}

#[test]
fn a_gust_beyond_its_range_acts_as_the_fastest() {
    let api = Api::load();
    let (led, set) = (Slave::flying(&api), Slave::flying(&api));
    assert_eq!(
        (led.set("u_gust", 199.0), led.set_input_derivative("u_gust", 1, 1e6)),
        (Status::Ok, Status::Ok)
    );
    assert_eq!(led.step(0.0, 0.01), Status::Ok, "{:?}", led.log());
    assert_eq!(led.get("u_gust"), 199.0 + 1e4);
    let mach = led.get("mach");
    assert_eq!((set.set("u_gust", 200.0), set.step(0.0, 0.01)), (Status::Ok, Status::Ok));
    assert!((mach - set.get("mach")).abs() < 1e-3, "{mach} {}", set.get("mach"));
}

#[test]
fn a_state_remembers_that_the_run_has_ended_and_whether_there_is_an_experiment() {
    let api = Api::load();
    let slave = Slave::new(&api);
    let new = slave.save();
    slave.start();
    let ready = slave.save();
    slave.leave_envelope();
    let (failed, time) = (slave.save(), slave.time());
    assert_eq!(slave.load(ready), Status::Ok);
    assert!(!slave.wants_to_end());
    assert_eq!(slave.load(failed), Status::Ok);
    assert!(slave.wants_to_end());
    assert_eq!(slave.time(), time);
    assert_eq!(slave.load(new), Status::Ok);
    assert_eq!(slave.enter(), Status::Error, "there is no experiment yet");
    for state in [new, ready, failed] {
        slave.free(state);
    }
}

#[test]
fn initialisation_needs_an_experiment() {
    let api = Api::load();
    let slave = Slave::new(&api);
    assert_eq!(slave.enter(), Status::Error);
    assert!(slave.message().message.contains("fmi2SetupExperiment"));
    assert_eq!(slave.begin(), Status::Ok);
}
