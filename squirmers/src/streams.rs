//! Standard output and standard error, which may be full or closed: neither ends the program by a panic.

use std::fmt::Arguments;
use std::io::{Error, ErrorKind, Write};
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};

use compare::CompareError;

use crate::error::CommandError;

/// Why standard output took no more, the first time.
static REFUSED: Mutex<Option<Error>> = Mutex::new(None);

/// Writes to standard output; what goes wrong is told once, by [`refused`]. Who closes it has seen enough.
pub(crate) fn write_out(text: Arguments<'_>) {
    let mut out = std::io::stdout().lock();
    if let Err(error) = out.write_fmt(text).and_then(|()| out.flush())
        && error.kind() != ErrorKind::BrokenPipe
    {
        let mut refused = REFUSED.lock().unwrap_or_else(PoisonError::into_inner);
        refused.get_or_insert(error);
    }
}

/// Writes to standard error, if that is possible: there is nowhere else to tell.
pub(crate) fn write_error(text: Arguments<'_>) {
    let _ = std::io::stderr().lock().write_fmt(text);
}

/// What standard output refused to take.
///
/// # Errors
/// [`CommandError::Write`] if it did.
pub(crate) fn refused() -> Result<(), CommandError> {
    let refused = REFUSED
        .lock()
        .unwrap_or_else(PoisonError::into_inner)
        .take();
    refused.map_or(Ok(()), |source| {
        Err(CompareError::Write {
            path: PathBuf::from("standard output"),
            source,
        }
        .into())
    })
}

/// A line on standard output.
macro_rules! say {
    ($($text:tt)+) => {
        $crate::streams::write_out(format_args!("{}\n", format_args!($($text)+)))
    };
}

/// A line on standard error.
macro_rules! complain {
    ($($text:tt)+) => {
        $crate::streams::write_error(format_args!("{}\n", format_args!($($text)+)))
    };
}

pub(crate) use {complain, say};
