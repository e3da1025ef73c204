//! The header of a submission: whose numbers they are, and how they are to be read.

use scene::MAX_MODES;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::error::{SubmissionError, shown};

/// Longest text in a header, in bytes.
const LONGEST_TEXT: usize = 500;

/// What a submission says of itself: lines that begin with `#!`, in TOML once these two signs are taken off.
/// Everything may be left out, but for `matrix` in a file of matrices and `range` of a process.
///
/// ```
/// let header = compare::submission::Header::parse("model = \"mine\"\ninterpolation = \"linear\"")?;
/// assert_eq!(header.model.as_deref(), Some("mine"));
/// assert!(compare::submission::Header::parse("modle = \"mine\"").is_err());
/// # Ok::<(), compare::submission::SubmissionError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Header {
    /// Name of the model or the code.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(length(max = 500))]
    pub model: Option<String>,
    /// Version of the code.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(length(max = 500))]
    pub version: Option<String>,
    /// Where it is published.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(length(max = 500))]
    pub citation: Option<String>,
    /// How the numbers were made: function, settings, command.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(length(max = 500))]
    pub call: Option<String>,
    /// The machine that `seconds_per_gap` was measured on.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(length(max = 500))]
    pub machine: Option<String>,
    /// Radius of the spheres. Gaps and matrices are in the units of radius and viscosity; named values are pure numbers.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub radius: f64,
    /// Viscosity of the fluid.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub viscosity: f64,
    /// For each slip mode, how many `B_n` a unit of it is. 1 if left out.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(length(max = 8))]
    pub mode_units: Vec<f64>,
    /// For each slip mode, the factor by which what it causes is to be multiplied. The model is scored without and with it, and moves with it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(length(max = 8))]
    pub slip_calibration: Vec<f64>,
    /// How the authors' code reads values between the gaps of the file. If left out, nothing is scored between them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub interpolation: Option<Interpolation>,
    /// Wall-clock time of one gap, in seconds.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub seconds_per_gap: Option<f64>,
    /// What matrices are. Needed in a file of matrices, and of a process that answers with matrices.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub matrix: Option<MatrixKind>,
    /// Of a process: the smallest and the largest gap that it answers for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub range: Option<[f64; 2]>,
    /// Of a process: size of its noise, relative to the larger of a value and 1. Its table is built to this.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub noise: Option<f64>,
}

impl Default for Header {
    fn default() -> Self {
        Self {
            model: None,
            version: None,
            citation: None,
            call: None,
            machine: None,
            radius: 1.0,
            viscosity: 1.0,
            mode_units: Vec::new(),
            slip_calibration: Vec::new(),
            interpolation: None,
            seconds_per_gap: None,
            matrix: None,
            range: None,
            noise: None,
        }
    }
}

/// How values between gaps follow from those at them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Interpolation {
    /// Straight lines in the gap.
    Linear,
    /// Straight lines in the logarithm of the gap.
    LogLinear,
    /// Cubics in the logarithm of the gap.
    LogCubic,
    /// None: the code answers at the gaps of the file alone.
    None,
}

impl Interpolation {
    /// In words.
    #[must_use]
    pub fn in_words(self) -> &'static str {
        match self {
            Self::Linear => "linear in the gap",
            Self::LogLinear => "linear in the logarithm of the gap",
            Self::LogCubic => "cubic in the logarithm of the gap",
            Self::None => "none",
        }
    }
}

/// What a 12 x 12 matrix is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum MatrixKind {
    /// Velocities by forces.
    Mobility,
    /// Forces that cause velocities.
    Resistance,
}

impl Header {
    /// From TOML.
    ///
    /// # Errors
    /// [`SubmissionError::Header`] with the first mistake.
    pub fn parse(text: &str) -> Result<Self, SubmissionError> {
        let header: Self = toml::from_str(text).map_err(|error| {
            let message = shown(&error.message().replace('\n', " "), 200);
            // The line that it is about.
            let line = error.span().map(|span| {
                let begins = text.get(..span.start).and_then(|before| before.rfind('\n'));
                let line = text
                    .get(begins.map_or(0, |at| at + 1)..)
                    .unwrap_or_default();
                shown(line.lines().next().unwrap_or_default().trim(), 60)
            });
            SubmissionError::Header {
                what: match line {
                    Some(line) => format!("{message} in '{line}'"),
                    None => message,
                },
            }
        })?;
        header.check()
    }

    /// The header, if its values are allowed.
    ///
    /// # Errors
    /// [`SubmissionError::Header`] with the first that is not.
    pub fn check(self) -> Result<Self, SubmissionError> {
        let refuse = |what: String| Err(SubmissionError::Header { what });
        for (key, text) in self.texts() {
            if text.len() > LONGEST_TEXT || text.chars().any(char::is_control) {
                let allowed = format!("one line of at most {LONGEST_TEXT} bytes");
                return refuse(format!(
                    "{key} '{}' is not allowed: give {allowed}",
                    shown(text, 40)
                ));
            }
        }
        let positive = [
            ("radius", Some(self.radius)),
            ("viscosity", Some(self.viscosity)),
            ("seconds_per_gap", self.seconds_per_gap),
            ("noise", self.noise),
        ];
        for (key, value) in positive {
            if let Some(value) = value
                && !(value > 0.0 && value.is_finite())
            {
                return refuse(format!(
                    "{key} {value:?} is not allowed: give a finite number greater than 0"
                ));
            }
        }
        for (key, factors) in [
            ("mode_units", &self.mode_units),
            ("slip_calibration", &self.slip_calibration),
        ] {
            let allowed = |factor: &f64| factor.is_finite() && factor.abs() > 0.0;
            if factors.len() > MAX_MODES || !factors.iter().all(allowed) {
                let first = &factors[..factors.len().min(MAX_MODES)];
                return refuse(format!(
                    "{key} {} is not allowed: give at most {MAX_MODES} finite numbers other than 0",
                    shown(&format!("{first:?}"), 60)
                ));
            }
        }
        if let Some([smallest, largest]) = self.range
            && !(smallest > 0.0 && largest > smallest && largest.is_finite())
        {
            return refuse(format!(
                "range [{smallest:?}, {largest:?}] is not allowed: give two finite gaps greater than 0, the smaller one first"
            ));
        }
        Ok(self)
    }

    fn texts(&self) -> impl Iterator<Item = (&'static str, &str)> {
        let all = [
            ("model", &self.model),
            ("version", &self.version),
            ("citation", &self.citation),
            ("call", &self.call),
            ("machine", &self.machine),
        ];
        all.into_iter()
            .filter_map(|(key, text)| Some((key, text.as_deref()?)))
    }

    /// How many `B_n` a unit of the slip mode is.
    #[must_use]
    pub fn mode_unit(&self, mode: usize) -> f64 {
        of_mode(&self.mode_units, mode)
    }

    /// The calibration of a slip mode, 1 if none is declared.
    #[must_use]
    pub fn calibration(&self, mode: usize) -> f64 {
        of_mode(&self.slip_calibration, mode)
    }

    /// Model and version, as far as they are stated.
    #[must_use]
    pub fn title(&self) -> Option<String> {
        let parts = [&self.model, &self.version].into_iter().flatten();
        let title = parts.cloned().collect::<Vec<_>>().join(" ");
        (!title.is_empty()).then_some(title)
    }

    /// What is not stated and should be.
    #[must_use]
    pub fn unstated(&self) -> Vec<&'static str> {
        let of = [
            ("model", self.model.is_none()),
            ("version", self.version.is_none()),
            ("citation", self.citation.is_none()),
        ];
        of.into_iter()
            .filter(|(_, unstated)| *unstated)
            .map(|(key, _)| key)
            .collect()
    }
}

fn of_mode(factors: &[f64], mode: usize) -> f64 {
    let factor = mode.checked_sub(1).and_then(|place| factors.get(place));
    factor.copied().unwrap_or(1.0)
}
