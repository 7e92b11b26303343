//! Standard output and error. What cannot be written is an error with its cause, never a panic.

use anyhow::{Error, Result};
use std::fmt::{self, Arguments, Display};
use std::io::{self, ErrorKind, Write};
use std::process::ExitCode;

/// A line to standard output.
#[macro_export]
macro_rules! outln {
    ($($part:tt)*) => { $crate::console::write_out(format_args!("{}\n", format_args!($($part)*))) };
}

/// Text to standard output.
#[macro_export]
macro_rules! out {
    ($($part:tt)*) => { $crate::console::write_out(format_args!($($part)*)) };
}

/// A line to standard error, for people; where nobody can read it, it is not missed.
#[macro_export]
macro_rules! errln {
    ($($part:tt)*) => { $crate::console::write_err(format_args!($($part)*)) };
}

/// The reader of standard output has seen enough, as in `cargo ahv poles | head`: no failure.
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

/// Everything has to arrive before the command ends.
pub fn flush() -> Result<()> {
    io::stdout().flush().map_err(output_error)
}

pub fn write_err(text: Arguments) {
    // There is no other place to complain.
    let _ = writeln!(io::stderr(), "{text}");
}

pub fn output_error(error: io::Error) -> Error {
    match error.kind() {
        ErrorKind::BrokenPipe => ClosedPipe.into(),
        _ => Error::new(error).context("cannot write to standard output"),
    }
}

/// What failed, then why, on one line. A cause that only repeats what is already said is left out.
pub fn error_chain(error: &Error) -> String {
    let mut told = String::new();
    for cause in error.chain().map(ToString::to_string) {
        if told.is_empty() {
            told = cause;
        } else if !told.contains(&cause) {
            told = format!("{told}: {cause}");
        }
    }
    told
}

/// The end of a command; of clap's errors one is help.
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
    fn a_cause_is_told_once() {
        let error =
            anyhow!("no such file").context("cannot read a.csv: no such file").context("fly");
        assert_eq!(error_chain(&error), "fly: cannot read a.csv: no such file");
    }

    #[test]
    fn a_closed_pipe_is_known_under_its_context() {
        let closed = output_error(ErrorKind::BrokenPipe.into()).context("table 1");
        assert!(closed.is::<ClosedPipe>());
        let full = output_error(ErrorKind::StorageFull.into());
        assert!(!full.is::<ClosedPipe>());
        assert!(error_chain(&full).starts_with("cannot write to standard output: "));
    }
}
