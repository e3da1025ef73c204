//! The paper's cases, embedded in the program. Commands run them by default.

use serde::Deserialize;

use crate::study::panels::PanelCase;
use crate::{Approach, Case, CompareError};

/// The values that are combined for one approach.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EncounterDefaults {
    /// Squirmer parameters.
    pub beta: Vec<f64>,
    /// Offsets of the paths, in radii.
    pub dx: Vec<f64>,
    /// Offsets out of the plane, in radii.
    pub dz: Vec<f64>,
}

/// The cases with an offset out of the plane; pairs are `(beta, dx)`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OffsetDefaults {
    /// Offsets out of the plane, in radii.
    pub dz: Vec<f64>,
    head_on: Vec<(f64, f64)>,
    orthogonal: Vec<(f64, f64)>,
}

impl OffsetDefaults {
    /// The cases without an offset out of the plane.
    #[must_use]
    pub fn cases(&self) -> Vec<Case> {
        let of = |approach, pairs: &[(f64, f64)]| {
            (pairs.iter())
                .map(|&(beta, dx)| Case {
                    approach,
                    beta,
                    dx,
                    dz: 0.0,
                })
                .collect::<Vec<_>>()
        };
        let mut cases = of(Approach::HeadOn, &self.head_on);
        cases.extend(of(Approach::Orthogonal, &self.orthogonal));
        cases
    }
}

/// All embedded cases.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Defaults {
    /// Fig. 6.
    pub head_on: EncounterDefaults,
    /// Fig. 7.
    pub orthogonal: EncounterDefaults,
    /// Fig. 5(b).
    pub offset: OffsetDefaults,
    /// Fig. 8(a-f).
    pub bottom_heavy: Vec<PanelCase>,
    /// Fig. 2(c).
    pub example: Vec<PanelCase>,
    /// Fig. 1(c).
    pub outcome: Vec<PanelCase>,
}

impl Defaults {
    /// The paper's cases.
    ///
    /// # Errors
    /// [`CompareError::Cases`] if the embedded file does not parse.
    pub fn paper() -> Result<Self, CompareError> {
        Ok(toml::from_str(fixtures::CASES)?)
    }

    /// The encounters of Figs 6 and 7.
    ///
    /// # Errors
    /// As [`Self::paper`].
    pub fn paper_encounters() -> Result<Vec<Case>, CompareError> {
        let defaults = Self::paper()?;
        let mut cases = Vec::new();
        for approach in [Approach::HeadOn, Approach::Orthogonal] {
            let of = defaults.encounters(approach);
            for &beta in &of.beta {
                for &dx in &of.dx {
                    cases.extend(of.dz.iter().map(|&dz| Case {
                        approach,
                        beta,
                        dx,
                        dz,
                    }));
                }
            }
        }
        Ok(cases)
    }

    /// The values for `approach`.
    #[must_use]
    pub fn encounters(&self, approach: Approach) -> &EncounterDefaults {
        match approach {
            Approach::HeadOn => &self.head_on,
            Approach::Orthogonal => &self.orthogonal,
        }
    }
}
