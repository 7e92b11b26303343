//! Prints the autopilot's description, for `cargo ahv describe`.

fn main() -> std::process::ExitCode {
    fmi_model::describe::main::<ahv_autopilot::Autopilot>()
}
