//! How much an offset out of the plane changes the outgoing orientations (the paper's Fig. 5b).

use nalgebra::Vector3;
use scene::RunOptions;
use serde::{Deserialize, Serialize};

use super::encounters::{Encounter, EncounterSweep, encounter, encounters, skipped};
use crate::columns::columns;
use crate::output::csv_lines;
use crate::sweep::{Computed, Row, SweepOptions};
use crate::{Case, CompareError, Method, Model};

columns! {
    /// A row for each encounter, method and offset out of the plane: how much the offset changes the outgoing orientations.
    /// Outgoing orientations are those at infinite distance if the pair parts, and those at the end of the run if it stays
    /// bound.
    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    pub struct OffsetRow {
        /// Name of the approach: `head-on` or `orthogonal`.
        #[unit = "-"]
        pub case: String,
        /// Name of the method.
        #[unit = "-"]
        pub method: Method,
        /// Squirming parameter B2/B1 of both squirmers; positive for pullers, negative for pushers.
        #[unit = "-"]
        pub beta: f64,
        /// Offset of the two paths in the plane; for opposed paths the distance between them.
        #[unit = "a"]
        pub dx: f64,
        /// Offset out of the plane: squirmer 1 starts at `z = dz/2`, squirmer 2 at `z = -dz/2`.
        #[unit = "a"]
        pub dz: f64,
        /// Angle between the outgoing orientations of squirmer 1 with and without the offset, from 0 to 180. NaN if one
        /// of the two runs has no outgoing orientation.
        #[unit = "deg"]
        pub change1_deg: f64,
        /// Angle between the outgoing orientations of squirmer 2 with and without the offset, from 0 to 180. NaN if one
        /// of the two runs has no outgoing orientation.
        #[unit = "deg"]
        pub change2_deg: f64,
        /// Smallest gap during the run with the offset.
        #[unit = "a"]
        pub min_gap: f64,
        /// Outcome of the run with the offset.
        #[unit = "-"]
        pub outcome: String,
        /// Outcome of the run without the offset.
        #[unit = "-"]
        pub outcome_in_plane: String,
    }
}

impl Row for OffsetRow {
    fn outcomes(&self) -> impl Iterator<Item = &str> {
        std::iter::once(self.outcome.as_str())
    }
}

impl EncounterSweep<'_> {
    /// Checks that [`Self::offsets`] would not delete rows of another sweep.
    ///
    /// # Errors
    /// As [`Self::check_encounters`].
    pub fn check_offsets(&self, dz: &[f64]) -> Result<(), CompareError> {
        let cases = self.cases.len() / (1 + dz.len());
        self.sweep(self.models.len() * cases).check()
    }

    /// Computes how much each offset `dz` changes the outgoing orientations of each case. Returns whether all are done.
    ///
    /// # Errors
    /// As [`Self::encounters`].
    pub fn offsets(
        &self,
        dz: &[f64],
        each: &mut dyn FnMut(OffsetRow),
    ) -> Result<bool, CompareError> {
        let options = RunOptions {
            sample_interval: None,
            ..self.options.run
        };
        // All offsets of a case are compared with its planar run.
        let group = 1 + dz.len();
        let cases = self.cases.len() / group;
        let of = |number: usize| {
            let (model, case) = (number / cases, number % cases);
            let cases = &self.cases[case * group..(case + 1) * group];
            (&self.models[model], cases)
        };
        let skipped = |number: usize| -> Vec<Encounter> {
            let (model, cases) = of(number);
            (cases.iter()).map(|case| skipped(model, case)).collect()
        };
        let rows = |encounters: &[Encounter]| -> Vec<OffsetRow> {
            (encounters[1..].iter())
                .map(|offset| offset_row(&encounters[0], offset))
                .collect()
        };
        let computed = |encounters: &[Encounter]| -> Result<Computed, CompareError> {
            Ok(Computed {
                lines: csv_lines(&rows(encounters))?,
                failure: encounters.iter().find_map(Encounter::failure),
            })
        };
        let done = self.write(
            self.models.len() * cases,
            |number| {
                let (model, cases) = of(number);
                let encounters: Vec<_> = (cases.iter())
                    .map(|case| encounter(model, case, &options))
                    .collect();
                computed(&encounters)
            },
            &|number| computed(&skipped(number)),
            each,
        )?;
        Ok(done.is_complete())
    }
}

/// Computes how much each offset out of the plane changes the outgoing orientations of each of `cases`.
///
/// Returns one row for each method, case and offset, and the encounters from which the rows follow.
#[must_use]
pub fn offsets(
    models: &[Model],
    cases: &[Case],
    dz: &[f64],
    options: &SweepOptions,
) -> (Vec<OffsetRow>, Vec<Encounter>) {
    // All offsets of a case are compared with its planar run.
    let encounters = encounters(models, &with_offsets(cases, dz), options);
    let rows = (encounters.chunks(1 + dz.len()))
        .flat_map(|group| {
            let reference = &group[0];
            group[1..].iter().map(move |e| offset_row(reference, e))
        })
        .collect();
    (rows, encounters)
}

/// Each of `cases` without an offset out of the plane, then with each offset.
#[must_use]
pub fn with_offsets(cases: &[Case], dz: &[f64]) -> Vec<Case> {
    let offsets = || std::iter::once(0.0).chain(dz.iter().copied());
    (cases.iter())
        .flat_map(|case| offsets().map(move |dz| Case { dz, ..*case }))
        .collect()
}

fn offset_row(reference: &Encounter, offset: &Encounter) -> OffsetRow {
    let change = |k: usize| match (&reference.run, &offset.run) {
        (Ok(a), Ok(b)) if a.has_outgoing_angles() && b.has_outgoing_angles() => {
            let [a, b] = [a, b].map(|run| run.outgoing.orientations[k]);
            angle_between(a, b).to_degrees()
        }
        _ => f64::NAN,
    };
    OffsetRow {
        case: offset.case.approach.to_string(),
        method: offset.method,
        beta: offset.case.beta,
        dx: offset.case.dx,
        dz: offset.case.dz,
        change1_deg: change(0),
        change2_deg: change(1),
        min_gap: (offset.run.as_ref()).map_or(f64::NAN, |run| run.min_gap),
        outcome: offset.outcome(),
        outcome_in_plane: reference.outcome(),
    }
}

/// Angle between two vectors in radians; precise at small angles.
fn angle_between(a: Vector3<f64>, b: Vector3<f64>) -> f64 {
    a.cross(&b).norm().atan2(a.dot(&b))
}

#[cfg(test)]
mod tests;
