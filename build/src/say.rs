//! Standard output and error. What cannot be written is an error with its cause, never a panic.

use anyhow::{Error, Result};
use std::fmt::{self, Arguments, Display};
use std::io::{self, ErrorKind, Write};
use std::process::ExitCode;

/// A line to standard output.
#[macro_export]
macro_rules! say {
    ($($part:tt)*) => { $crate::say::put(format_args!("{}\n", format_args!($($part)*))) };
}

/// Text to standard output.
#[macro_export]
macro_rules! put {
    ($($part:tt)*) => { $crate::say::put(format_args!($($part)*)) };
}

/// A line to standard error, for people; where nobody can read it, it is not missed.
#[macro_export]
macro_rules! note {
    ($($part:tt)*) => { $crate::say::note(format_args!($($part)*)) };
}

/// The reader of standard output has seen enough, as in `cargo ahv poles | head`: no failure.
#[derive(Debug)]
pub struct Closed;

impl Display for Closed {
    fn fmt(&self, text: &mut fmt::Formatter) -> fmt::Result {
        text.write_str("standard output is closed")
    }
}

impl std::error::Error for Closed {}

pub fn put(text: Arguments) -> Result<()> {
    io::stdout().write_fmt(text).map_err(refused)
}

/// Everything has to arrive before the command ends.
pub fn flush() -> Result<()> {
    io::stdout().flush().map_err(refused)
}

pub fn note(text: Arguments) {
    // There is no other place to complain.
    let _ = writeln!(io::stderr(), "{text}");
}

pub fn refused(error: io::Error) -> Error {
    match error.kind() {
        ErrorKind::BrokenPipe => Closed.into(),
        _ => Error::new(error).context("cannot write to standard output"),
    }
}

/// What failed, then why, on one line. A cause that only repeats what is already said is left out.
pub fn causes(error: &Error) -> String {
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
pub fn finish(done: Result<Result<ExitCode>, clap::Error>) -> ExitCode {
    let code = |number| u8::try_from(number).map_or(ExitCode::FAILURE, ExitCode::from);
    let done =
        done.unwrap_or_else(|told| told.print().map_err(refused).map(|()| code(told.exit_code())));
    match done.and_then(|code| flush().map(|()| code)) {
        Ok(code) => code,
        Err(error) if error.is::<Closed>() => ExitCode::SUCCESS,
        Err(error) => {
            note!("error: {}", causes(&error));
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
        assert_eq!(causes(&error), "fly: cannot read a.csv: no such file");
    }

    #[test]
    fn a_closed_pipe_is_known_under_its_context() {
        let closed = refused(ErrorKind::BrokenPipe.into()).context("table 1");
        assert!(closed.is::<Closed>());
        let full = refused(ErrorKind::StorageFull.into());
        assert!(!full.is::<Closed>());
        assert!(causes(&full).starts_with("cannot write to standard output: "));
    }
}
