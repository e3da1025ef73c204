//! Standard output and standard error. If a stream is full or closed, the program does not panic.

use std::fmt::Arguments;
use std::io::{Error, ErrorKind, Write};
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};

use compare::CompareError;

use crate::error::CommandError;

/// The first error of standard output.
static REFUSED: Mutex<Option<Error>> = Mutex::new(None);

/// Writes to standard output. [`refused`] reports the first error, at the end. A closed pipe is not an error: its
/// reader needs no more lines.
pub(crate) fn write_out(text: Arguments<'_>) {
    let mut out = std::io::stdout().lock();
    if let Err(error) = out.write_fmt(text).and_then(|()| out.flush())
        && error.kind() != ErrorKind::BrokenPipe
    {
        let mut refused = REFUSED.lock().unwrap_or_else(PoisonError::into_inner);
        refused.get_or_insert(error);
    }
}

/// Writes to standard error. Ignores errors, because no other place could show them.
pub(crate) fn write_error(text: Arguments<'_>) {
    let _ = std::io::stderr().lock().write_fmt(text);
}

/// Reports the first error of standard output.
///
/// # Errors
/// [`CompareError::Write`] if there was one.
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

/// Prints a line on standard output.
macro_rules! print_line {
    ($($text:tt)+) => {
        $crate::streams::write_out(format_args!("{}\n", format_args!($($text)+)))
    };
}

/// Prints a line on standard error.
macro_rules! print_error {
    ($($text:tt)+) => {
        $crate::streams::write_error(format_args!("{}\n", format_args!($($text)+)))
    };
}

pub(crate) use {print_error, print_line};
