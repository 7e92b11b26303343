//! Takes as many samples as it is told: what `cargo ahv bench --only instructions` counts.

use ahv_autopilot::Autopilot;
use fmi_model::failure::Failure;
use fmi_model::instance::{Instance, Interface};

const PERIOD_S: f64 = 0.01;
/// Value references of V, gamma, q; delta_e, phi.
const MEASURED: [u32; 3] = [0, 1, 2];
const COMMANDS: [u32; 2] = [6, 7];

fn main() -> Result<(), Failure> {
    let count: u32 = std::env::args().nth(1).and_then(|text| text.parse().ok()).unwrap_or(1);
    let mut pilot = Instance::<Autopilot>::new(Interface::CoSimulation, false)?;
    pilot.setup_experiment(None, 0.0, None)?;
    pilot.enter_initialization_mode()?;
    pilot.exit_initialization_mode()?;
    for step in 0..count {
        pilot.set_real(&MEASURED, &[2391.0, 1e-3, 1e-3])?;
        pilot.do_step(f64::from(step) * PERIOD_S, PERIOD_S)?;
        pilot.get_real(&COMMANDS, |_, command| {
            std::hint::black_box(command);
        })?;
    }
    Ok(())
}
