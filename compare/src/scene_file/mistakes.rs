//! Mistakes in a scene file: where each is, what was found and what is allowed.

use std::fmt;
use std::ops::Range;

/// Longest piece of the file that a mistake quotes, in characters.
const QUOTED: usize = 40;

/// Edits up to which a key counts as misspelt.
const MISSPELT: usize = 3;

/// One mistake.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mistake {
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// The key with its tables, `squirmer[1].beta`; empty where the file is not TOML.
    pub key: String,
    /// What was found.
    pub found: String,
    /// What is allowed.
    pub allowed: String,
}

impl fmt::Display for Mistake {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: ", self.line, self.column)?;
        if !self.key.is_empty() {
            write!(f, "{}: ", self.key)?;
        }
        write!(f, "found {}; {}", self.found, self.allowed)
    }
}

/// All mistakes in a file, in the order of their places.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub struct Mistakes(pub Vec<Mistake>);

impl fmt::Display for Mistakes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (number, mistake) in self.0.iter().enumerate() {
            if number > 0 {
                writeln!(f)?;
            }
            write!(f, "{mistake}")?;
        }
        Ok(())
    }
}

/// Takes mistakes down as a file is read.
pub(super) struct Notes<'t> {
    text: &'t str,
    mistakes: Vec<Mistake>,
}

impl<'t> Notes<'t> {
    pub(super) fn new(text: &'t str) -> Self {
        Self {
            text,
            mistakes: Vec::new(),
        }
    }

    /// A mistake about what stands at `span`.
    pub(super) fn wrong(&mut self, span: Range<usize>, key: &str, allowed: impl Into<String>) {
        let found = self.quote(span.clone());
        self.note(span, key, found, allowed.into());
    }

    /// A mistake about what is not there, in the table at `span`.
    pub(super) fn missing(&mut self, span: Range<usize>, key: &str, allowed: &str) {
        self.note(span, key, "nothing".to_owned(), allowed.to_owned());
    }

    /// A mistake in words of its own.
    pub(super) fn note(&mut self, span: Range<usize>, key: &str, found: String, allowed: String) {
        let (line, column) = self.place(span.start);
        self.mistakes.push(Mistake {
            line,
            column,
            key: key.to_owned(),
            found,
            allowed,
        });
    }

    /// A key that nobody asked for.
    pub(super) fn unknown(&mut self, span: Range<usize>, key: &str, known: &[&str]) {
        let name = key.rsplit('.').next().unwrap_or(key);
        let nearest = (known.iter())
            .map(|known| (strsim::osa_distance(known, name), known))
            .min_by_key(|(distance, _)| *distance)
            .filter(|(distance, known)| *distance <= MISSPELT && 2 * distance <= known.len());
        let allowed = match nearest {
            Some((_, nearest)) => format!("no such key: did you mean '{nearest}'?"),
            None => format!("no such key: allowed are {}", known.join(", ")),
        };
        self.wrong(span, key, allowed);
    }

    /// How many mistakes there are so far.
    pub(super) fn count(&self) -> usize {
        self.mistakes.len()
    }

    /// Whether nothing is wrong so far.
    pub(super) fn is_empty(&self) -> bool {
        self.mistakes.is_empty()
    }

    /// The mistakes, without those on a line that is not TOML, which would only follow from that.
    pub(super) fn into_mistakes(self) -> Mistakes {
        let mut mistakes = self.mistakes;
        let broken: Vec<_> = (mistakes.iter())
            .filter(|mistake| mistake.key.is_empty())
            .map(|mistake| mistake.line)
            .collect();
        mistakes.retain(|m| m.key.is_empty() || !broken.contains(&m.line));
        mistakes.sort_by_key(|mistake| (mistake.line, mistake.column));
        mistakes.dedup();
        Mistakes(mistakes)
    }

    /// The piece of the file at `span`, on one line.
    pub(super) fn quote(&self, span: Range<usize>) -> String {
        let piece = self.text.get(span).unwrap_or_default();
        let line: Vec<_> = piece.split_whitespace().collect();
        let line = line.join(" ");
        if line.is_empty() {
            return "nothing".to_owned();
        }
        if line.chars().count() > QUOTED {
            let short: String = line.chars().take(QUOTED).collect();
            return format!("{short}…");
        }
        line
    }

    fn place(&self, at: usize) -> (usize, usize) {
        let before = self.text.get(..at).unwrap_or(self.text);
        let line = before.matches('\n').count() + 1;
        let start = before.rfind('\n').map_or(0, |newline| newline + 1);
        (line, before[start..].chars().count() + 1)
    }
}
