//! Which parameters an expression may read: those above it in the file.

use super::mistakes::unknown;

/// The names that an expression may read.
#[derive(Debug, Default)]
pub(super) struct Scope {
    /// All parameters, in the order of the file, and whether anything has read them.
    pub names: Vec<(String, bool)>,
    /// How many of them stand above what is being read.
    pub above: usize,
}

impl Scope {
    /// The scope of an expression that may read all these parameters.
    #[cfg(test)]
    pub(super) fn of(names: &[&str]) -> Self {
        Self {
            names: names
                .iter()
                .map(|name| ((*name).to_owned(), false))
                .collect(),
            above: names.len(),
        }
    }

    /// The place of the parameter `name` in the list.
    ///
    /// # Errors
    /// What is allowed instead.
    pub(super) fn find(&mut self, name: &str) -> Result<usize, String> {
        match self.names.iter().position(|(known, _)| known == name) {
            Some(place) if place < self.above => {
                self.names[place].1 = true;
                Ok(place)
            }
            Some(place) if place == self.above => {
                Err("a parameter cannot be read in its own value".to_owned())
            }
            Some(_) => Err("it stands below: a parameter can read those above it only".to_owned()),
            None if self.names.is_empty() => Err(
                "no such parameter: give a number, or name it in a table [parameters]".to_owned(),
            ),
            None => {
                let above = self.names[..self.above]
                    .iter()
                    .map(|(name, _)| name.as_str());
                let known: Vec<_> = above.chain(["pi"]).collect();
                Err(unknown("parameter", name, &known))
            }
        }
    }
}
