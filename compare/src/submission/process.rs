//! A model that is a process: a question a line on its standard input, an answer a line on its standard output, both in JSON.
//!
//! Nothing but the command that the user names is run, without a shell. Whatever the process does, an answer or one clear error comes
//! back in bounded time and memory: lines have a longest length, answers a time limit, and output that nobody asked for waits in the pipe.
//! The process has a group of its own (on Unix): an interrupt from the keyboard does not end it before the work that needs it, and whatever it
//! has started ends with it.

mod talk;

use std::sync::{Arc, Mutex};
use std::time::Duration;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::asked::{Asked, Heard, PairAnswer, Silence, Source, locked, range_of};
use super::error::{SubmissionError, shown};
use super::header::Header;
use talk::Talk;

pub use talk::end_processes;

/// A question, one line of JSON.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "ask", rename_all = "kebab-case")]
pub enum Question {
    /// Comes first, once.
    Header,
    /// What is the pair like at this gap, in the unit of the header's radius?
    Pair {
        /// The gap.
        gap: f64,
    },
}

/// The answer to the question for the header.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HeaderAnswer {
    /// The header, with `range`.
    pub header: Header,
}

/// A process that answers. It ends when this is dropped, or with [`end_processes`].
pub struct Process {
    command: String,
    limit: Duration,
    talk: Mutex<Talk>,
}

impl Process {
    /// Starts `command`, a program and its arguments as a shell would split them, and asks for its header. Each answer may take as long as
    /// `limit`.
    ///
    /// # Errors
    /// [`SubmissionError::Asked`] if it cannot be started or does not answer as it should.
    pub fn start(command: &str, limit: Duration) -> Result<Asked, SubmissionError> {
        let (process, header) = Self::begin(command, limit)?;
        Asked::new(Arc::new(process), header)
    }

    /// The process and its header.
    fn begin(command: &str, limit: Duration) -> Result<(Self, Header), SubmissionError> {
        let failed = |what: String| SubmissionError::Asked {
            who: format!("process '{}'", shown(command, 60)),
            what,
        };
        let words = shlex::split(command).filter(|words| !words.is_empty());
        let words = words.ok_or_else(|| {
            failed("give a program and its arguments, with closed quotes".to_owned())
        })?;
        let mut talk = Talk::begin(&words)
            .map_err(|error| failed(format!("it cannot be started: {error}")))?;
        let understood = |HeaderAnswer { header }| {
            let header = header.check().map_err(|error| error.to_string())?;
            range_of(&header)?;
            Ok(header)
        };
        let header = talk
            .ask(Question::Header, limit, understood)
            .map_err(failed)?;
        let process = Self {
            command: command.to_owned(),
            limit,
            talk: Mutex::new(talk),
        };
        Ok((process, header))
    }
}

impl Source for Process {
    fn kind(&self) -> &'static str {
        "process"
    }

    fn name(&self) -> &str {
        &self.command
    }

    fn takes_turns(&self) -> bool {
        true
    }

    fn ask(&self, gaps: &[f64], heard: &mut Heard<'_>) -> Result<(), Silence> {
        let mut talk = locked(&self.talk);
        for (place, &gap) in gaps.iter().enumerate() {
            talk.ask(Question::Pair { gap }, self.limit, |said: PairAnswer| {
                heard(place, said)
            })
            .map_err(Silence::Said)?;
        }
        Ok(())
    }
}

#[cfg(unix)]
#[cfg(test)]
mod tests;
