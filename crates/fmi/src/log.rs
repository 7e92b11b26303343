//! Log categories, and messages that wait for the master's logger.

use crate::failure::Failure;
use crate::standard::Standard;
use crate::status::Status;
use core::ffi::CStr;
use std::ffi::CString;

/// A log category, with its name in the standard (section 2.2.4).
///
/// There is none for warnings and pending steps, as neither is ever returned. FMI 3.0 has the same names.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub enum Category {
    /// `logEvents`.
    Events = 0,
    /// `logStatusDiscard`.
    StatusDiscard = 1,
    /// `logStatusError`.
    StatusError = 2,
    /// `logStatusFatal`.
    StatusFatal = 3,
}

/// All categories: what the model description has to list.
pub const CATEGORIES: [Category; 4] =
    [Category::Events, Category::StatusDiscard, Category::StatusError, Category::StatusFatal];

impl Category {
    /// Name.
    pub const fn name(self) -> &'static CStr {
        match self {
            Self::Events => c"logEvents",
            Self::StatusDiscard => c"logStatusDiscard",
            Self::StatusError => c"logStatusError",
            Self::StatusFatal => c"logStatusFatal",
        }
    }

    /// Description for users; `events`: what the model reports.
    pub const fn description(self, events: &'static str) -> &'static str {
        match self {
            Self::Events => events,
            Self::StatusDiscard => "What was discarded or ended early, and why; always logged",
            Self::StatusError => "Refused calls, and why; always logged",
            Self::StatusFatal => "Internal errors; always logged",
        }
    }

    /// The category in which a failed call is reported.
    pub const fn of(status: Status) -> Self {
        match status {
            Status::Ok | Status::Warning => Self::Events,
            Status::Discard => Self::StatusDiscard,
            Status::Error => Self::StatusError,
            Status::Fatal => Self::StatusFatal,
        }
    }

    const fn bit(self) -> u8 {
        1 << self as u8
    }

    /// What is logged whether or not its category is enabled: `loggingOn` is about debugging, and
    /// neither a refused call nor a simulation that ends early may be mute.
    const ALWAYS: u8 =
        Self::StatusDiscard.bit() | Self::StatusError.bit() | Self::StatusFatal.bit();
}

/// A message for the master.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Message {
    /// Status that the call returns.
    pub status: Status,
    /// Category.
    pub category: Category,
    /// Finished text.
    pub text: String,
}

impl Message {
    /// A message in the category of its status.
    pub fn new(status: Status, text: String) -> Self {
        Self { status, category: Category::of(status), text }
    }

    /// The text as a standard's logger takes it: both read `#r1#` as a variable, so `#` is doubled; FMI 2.0
    /// hands it to `printf` as the format, so `%` is doubled there.
    pub fn escaped(&self, standard: Standard) -> CString {
        let mut escaped = Vec::with_capacity(self.text.len() + 8);
        for byte in self.text.bytes().filter(|&byte| byte != 0) {
            escaped.push(byte);
            if byte == b'#' || byte == b'%' && standard == Standard::Fmi2 {
                escaped.push(byte);
            }
        }
        CString::new(escaped).unwrap_or_default()
    }
}

/// Enabled categories and waiting messages.
#[derive(Debug, Clone)]
pub struct Log {
    /// Name of the call that is being made: messages begin with it.
    call: &'static str,
    enabled: u8,
    waiting: Vec<Message>,
}

impl Log {
    /// A log with all categories on or off.
    pub fn new(on: bool) -> Self {
        Self { call: "", enabled: if on { u8::MAX } else { 0 }, waiting: Vec::new() }
    }

    /// Switches the named categories, or all if none is named.
    ///
    /// # Errors
    /// [`Failure::UnknownCategory`]; nothing is switched then.
    pub fn switch(&mut self, on: bool, categories: &[String]) -> Result<(), Failure> {
        let mut mask = if categories.is_empty() { u8::MAX } else { 0 };
        for name in categories {
            let known = |category: &&Category| category.name().to_bytes() == name.as_bytes();
            match CATEGORIES.iter().find(known) {
                Some(category) => mask |= category.bit(),
                None => {
                    let known: Vec<_> = CATEGORIES
                        .iter()
                        .map(|category| category.name().to_string_lossy())
                        .collect();
                    let (category, known) = (name.clone(), known.join(", "));
                    return Err(Failure::UnknownCategory { category, known });
                }
            }
        }
        self.enabled = if on { self.enabled | mask } else { self.enabled & !mask };
        Ok(())
    }

    /// Whether messages of this status are wanted.
    pub fn wants(&self, status: Status) -> bool {
        (self.enabled | Category::ALWAYS) & Category::of(status).bit() != 0
    }

    /// Queues a message if its category is wanted; the text is not even made if not.
    pub fn push(&mut self, status: Status, text: impl FnOnce() -> String) {
        if self.wants(status) {
            let message = Message::new(status, format!("{}: {}", self.call, text()));
            self.waiting.push(message);
        }
    }

    /// Says which call the messages that follow are about.
    pub fn begin(&mut self, call: &'static str) {
        self.call = call;
    }

    /// Hands over what is waiting.
    pub fn take(&mut self) -> Vec<Message> {
        core::mem::take(&mut self.waiting)
    }
}
