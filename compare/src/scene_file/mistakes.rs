//! Mistakes in a scene file: where each is, what was found and what is allowed.

use std::collections::HashSet;
use std::fmt;
use std::ops::Range;

use crate::numbers::{decimal_comma, point_hint};

/// Longest piece of the file that a mistake quotes, in characters.
const QUOTED: usize = 40;

/// Longest piece of a line that is looked at where the file is not TOML, in bytes or characters.
const SEARCHED: usize = 1000;

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

/// What a piece of the file that is wrong may mean as a number: what is in a string, and a list with commas of both
/// kinds, as in `[0,5, 1,5]`.
fn in_doubt(found: &str) -> &str {
    let list = (found.strip_prefix('[')).filter(|list| list.contains(", "));
    list.or(found.strip_prefix('"')).unwrap_or_default()
}

/// Mistakes that are listed; of more, the number is told.
const LISTED: usize = 20;

/// All mistakes in a file, in the order of their places.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub struct Mistakes(pub Vec<Mistake>);

impl fmt::Display for Mistakes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (number, mistake) in self.0.iter().take(LISTED).enumerate() {
            if number > 0 {
                writeln!(f)?;
            }
            write!(f, "{mistake}")?;
        }
        match self.0.len().saturating_sub(LISTED) {
            0 => Ok(()),
            more => write!(f, "\nand {more} more"),
        }
    }
}

/// A text with its control characters written out: a terminal would obey some of them, and a line would end at others.
fn printable(text: &str) -> String {
    let mut shown = String::with_capacity(text.len());
    for letter in text.chars() {
        if letter.is_control() {
            shown.extend(letter.escape_default());
        } else {
            shown.push(letter);
        }
    }
    shown
}

/// What to say of a name that is not among those that are known.
pub(super) fn unknown(what: &str, name: &str, known: &[&str]) -> String {
    let nearest = (known.iter())
        .map(|known| (strsim::osa_distance(known, name), known))
        .min_by_key(|(distance, _)| *distance)
        .filter(|(distance, known)| *distance <= MISSPELT && 2 * distance <= known.len());
    match nearest {
        Some((_, nearest)) => format!("no such {what}: did you mean '{nearest}'?"),
        None => format!("no such {what}: allowed are {}", known.join(", ")),
    }
}

/// Takes mistakes down as a file is read.
pub(super) struct Notes<'t> {
    text: &'t str,
    /// Mistakes whose lines and columns are yet to be found, with where they are in bytes.
    mistakes: Vec<(usize, Mistake)>,
}

impl<'t> Notes<'t> {
    pub(super) fn new(text: &'t str) -> Self {
        Self {
            text,
            mistakes: Vec::new(),
        }
    }

    /// A place at which the text is not TOML, for a reason.
    pub(super) fn not_toml(&mut self, span: Option<Range<usize>>, reason: &str) {
        let span = span.unwrap_or(0..0);
        let found = self.quote_on(span.clone());
        let reason = reason.replace('\n', "; ");
        if !self.note_decimal_comma(span.clone()) {
            self.note(span, "", found, format!("not TOML: {reason}"));
        }
    }

    /// A mistake about what stands at `span`.
    pub(super) fn wrong(&mut self, span: Range<usize>, key: &str, allowed: impl Into<String>) {
        let found = self.quote(span.clone());
        let hint = point_hint(in_doubt(&found));
        self.note(span, key, found, format!("{}{hint}", allowed.into()));
    }

    /// A mistake about a number with a decimal comma on the line of `span`, if there is one: whether there is.
    pub(super) fn note_decimal_comma(&mut self, span: Range<usize>) -> bool {
        // Of more mistakes nobody sees more than the number.
        if self.count() >= LISTED {
            return false;
        }
        let text = self.text;
        let (before, after) = (text.get(..span.start), text.get(span.start..));
        let (Some(before), Some(after)) = (before, after) else {
            return false;
        };
        let begin = before.rfind('\n').map_or(0, |at| at + 1);
        let end = after.find('\n').map_or(text.len(), |at| span.start + at);
        if end - begin > SEARCHED {
            return false;
        }
        let line = &text[begin..end];
        let code = line.split('#').next().unwrap_or(line);
        let Some(at) = decimal_comma(code) else {
            return false;
        };
        let hint = point_hint(&code[at.clone()]);
        let at = begin + at.start..begin + at.end;
        let found = self.quote(at.clone());
        self.note(at, "", found, format!("not TOML{hint}"));
        true
    }

    /// A mistake about what is not there, in the table at `span`.
    pub(super) fn missing(&mut self, span: Range<usize>, key: &str, allowed: &str) {
        self.note(span, key, "nothing".to_owned(), allowed.to_owned());
    }

    /// A mistake in words of its own.
    pub(super) fn note(&mut self, span: Range<usize>, key: &str, found: String, allowed: String) {
        let mistake = Mistake {
            line: 1,
            column: 1,
            key: printable(key),
            found: printable(&found),
            allowed: printable(&allowed),
        };
        self.mistakes.push((span.start, mistake));
    }

    /// A key that nobody asked for.
    pub(super) fn unknown(&mut self, span: Range<usize>, key: &str, known: &[&str]) {
        let name = key.rsplit('.').next().unwrap_or(key);
        self.wrong(span, key, unknown("key", name, known));
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
        let mut mistakes = self.placed();
        let broken: HashSet<_> = (mistakes.iter())
            .filter(|mistake| mistake.key.is_empty())
            .map(|mistake| mistake.line)
            .collect();
        mistakes.retain(|m| m.key.is_empty() || !broken.contains(&m.line));
        mistakes.sort_by_key(|mistake| (mistake.line, mistake.column));
        mistakes.dedup();
        Mistakes(mistakes)
    }

    /// The piece of the file at `span`, or what follows on its line if that is empty.
    pub(super) fn quote_on(&self, span: Range<usize>) -> String {
        if !span.is_empty() || self.count() >= LISTED {
            return self.quote(span);
        }
        let rest = self.text.get(span.start..).unwrap_or_default();
        let line = (rest.chars().take(SEARCHED)).take_while(|&c| c != '\n');
        self.quote(span.start..span.start + line.map(char::len_utf8).sum::<usize>())
    }

    /// The piece of the file at `span`.
    pub(super) fn piece(&self, span: &Range<usize>) -> Option<&'t str> {
        self.text.get(span.clone())
    }

    /// The piece of the file at `span`, on one line.
    pub(super) fn quote(&self, span: Range<usize>) -> String {
        let piece = self.piece(&span).unwrap_or_default();
        // No more words than can be quoted: a piece may be the whole file.
        let words: Vec<_> = piece.split_whitespace().take(QUOTED + 1).collect();
        let line = words.join(" ");
        if line.is_empty() {
            return "nothing".to_owned();
        }
        if line.chars().nth(QUOTED).is_some() {
            let short: String = line.chars().take(QUOTED).collect();
            return format!("{short}…");
        }
        line
    }

    /// The mistakes with their lines and columns, in one pass over the file however many there are.
    fn placed(self) -> Vec<Mistake> {
        let mut mistakes = self.mistakes;
        mistakes.sort_by_key(|(at, _)| *at);
        let (mut line, mut column) = (1, 1);
        let mut rest = self.text.char_indices().peekable();
        (mistakes.into_iter())
            .map(|(at, mistake)| {
                while let Some((_, passed)) = rest.next_if(|(index, _)| *index < at) {
                    if passed == '\n' {
                        (line, column) = (line + 1, 1);
                    } else {
                        column += 1;
                    }
                }
                Mistake {
                    line,
                    column,
                    ..mistake
                }
            })
            .collect()
    }
}
