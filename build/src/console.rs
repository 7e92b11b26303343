//! Standard output and standard error. A failed write is an error with its cause, never a panic.

use anyhow::{Error, Result};
use std::fmt::{self, Arguments, Display};
use std::io::{self, ErrorKind, Write};
use std::process::ExitCode;

/// Writes a line to standard output.
#[macro_export]
macro_rules! outln {
    ($($part:tt)*) => { $crate::console::write_out(format_args!("{}\n", format_args!($($part)*))) };
}

/// Writes text to standard output.
#[macro_export]
macro_rules! out {
    ($($part:tt)*) => { $crate::console::write_out(format_args!($($part)*)) };
}

/// Writes a line to standard error; failures are ignored.
#[macro_export]
macro_rules! errln {
    ($($part:tt)*) => { $crate::console::write_err(format_args!($($part)*)) };
}

/// The reader closed standard output, as in `cargo ahv poles | head`. This is not a failure.
#[derive(Debug)]
pub struct ClosedPipe;

impl Display for ClosedPipe {
    fn fmt(&self, text: &mut fmt::Formatter) -> fmt::Result {
        text.write_str("standard output is closed")
    }
}

impl std::error::Error for ClosedPipe {}

pub fn write_out(text: Arguments) -> Result<()> {
    io::stdout().write_fmt(text).map_err(output_error)
}

/// Flushes standard output, so that write errors are reported before the command ends.
pub fn flush() -> Result<()> {
    io::stdout().flush().map_err(output_error)
}

pub fn write_err(text: Arguments) {
    // There is nowhere else to report this.
    let _ = writeln!(io::stderr(), "{text}");
}

pub fn output_error(error: io::Error) -> Error {
    match error.kind() {
        ErrorKind::BrokenPipe => ClosedPipe.into(),
        _ => Error::new(error).context("cannot write to standard output"),
    }
}

/// The error and its causes on one line, without causes that an outer message already contains.
pub fn error_chain(error: &Error) -> String {
    let mut message = String::new();
    for cause in error.chain().map(ToString::to_string) {
        if message.is_empty() {
            message = cause;
        } else if !message.contains(&cause) {
            message = format!("{message}: {cause}");
        }
    }
    message
}

/// Exit code of a command; prints its error. Help is one of clap's errors.
pub fn exit_code(done: Result<Result<ExitCode>, clap::Error>) -> ExitCode {
    let code = |number| u8::try_from(number).map_or(ExitCode::FAILURE, ExitCode::from);
    let done = done
        .unwrap_or_else(|told| told.print().map_err(output_error).map(|()| code(told.exit_code())));
    match done.and_then(|code| flush().map(|()| code)) {
        Ok(code) => code,
        Err(error) if error.is::<ClosedPipe>() => ExitCode::SUCCESS,
        Err(error) => {
            errln!("error: {}", error_chain(&error));
            ExitCode::FAILURE
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use anyhow::anyhow;

    #[test]
    fn a_cause_is_printed_once() {
        let error =
            anyhow!("no such file").context("cannot read a.csv: no such file").context("fly");
        assert_eq!(error_chain(&error), "fly: cannot read a.csv: no such file");
    }

    #[test]
    fn a_closed_pipe_is_recognised_under_its_context() {
        let closed = output_error(ErrorKind::BrokenPipe.into()).context("table 1");
        assert!(closed.is::<ClosedPipe>());
        let full = output_error(ErrorKind::StorageFull.into());
        assert!(!full.is::<ClosedPipe>());
        assert!(error_chain(&full).starts_with("cannot write to standard output: "));
    }
}
