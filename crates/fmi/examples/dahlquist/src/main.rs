//! Writes the FMU.

fn main() -> std::process::ExitCode {
    fmi_model::package::main::<dahlquist::Dahlquist>()
}
