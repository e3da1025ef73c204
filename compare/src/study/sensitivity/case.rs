//! One case under one model: its run, its derivatives and its offsets.

use scene::{RunOptions, Scene, SceneError};

use super::derivatives::{self, Derivative, Directions};
use super::offsets::{TURNS_DEG, offset_to, raised, turn_rad};
use super::{Part, SensitivityRow, TOLERANCE};
use crate::no_run::RunNumbers;
use crate::numbers::written;
use crate::output::csv_lines;
use crate::{CompareError, Family, Method, Model, NoRun};

/// What is known of one case.
pub(super) struct Measured {
    pub row: SensitivityRow,
    pub derivatives: Vec<Derivative>,
}

/// A point of a part under a model.
pub(super) struct Unit<'a> {
    pub model: &'a Model,
    pub part: &'a Part,
    pub values: Vec<(&'a str, f64)>,
}

impl Unit<'_> {
    /// A message about a case without a result.
    pub fn says(&self, reason: &NoRun) -> String {
        let at = self
            .values
            .iter()
            .map(|(name, value)| format!("{name} {}", written(*value)));
        let at: Vec<String> = at.collect();
        let (case, method) = (&self.part.case, self.model.method());
        format!("{case}, {method}, {}: {reason}", at.join(", "))
    }

    fn numbers(&self) -> Vec<f64> {
        self.values.iter().map(|(_, value)| *value).collect()
    }

    /// The line of `sensitivity.csv`.
    pub fn lines(&self, measured: &Result<Measured, NoRun>) -> Result<String, CompareError> {
        let row = match measured {
            Ok(measured) => measured.row.clone(),
            Err(reason) => without_result(self.model.method(), reason),
        };
        csv_lines(&[(&self.part.case, self.numbers(), row)])
    }

    /// The lines of [`DERIVATIVES`].
    pub fn derivative_lines(
        &self,
        measured: &Result<Measured, NoRun>,
    ) -> Result<String, CompareError> {
        let derivatives = measured.as_ref().map_or(&[][..], |of| &of.derivatives);
        let rows: Vec<_> = (derivatives.iter())
            .map(|derivative| {
                let row = derivative.row(self.model.method());
                (&self.part.case, self.numbers(), row)
            })
            .collect();
        csv_lines(&rows)
    }

    pub fn measured(&self) -> Result<Measured, NoRun> {
        let family = self
            .part
            .points
            .family()
            .clone()
            .under(self.model.as_in_files());
        let point = (family.scene(&self.values)).map_err(CompareError::FamilyPoint);
        let measured = point.and_then(|point| {
            let options = RunOptions {
                tolerance: self.tolerance(point.run.tolerance),
                ..self.part.points.options(point.run)
            };
            self.measured_at(&family, &point.scene, &options)
        });
        measured.map_err(|error| NoRun::Failed(error.in_one_line()))
    }

    /// The tolerance that was asked for, or else the file's if that is tighter than a study's.
    fn tolerance(&self, of_file: f64) -> f64 {
        let asked = self.part.points.choices().tolerance;
        asked.unwrap_or_else(|| of_file.min(TOLERANCE))
    }

    fn measured_at(
        &self,
        family: &Family,
        scene: &Scene,
        options: &RunOptions,
    ) -> Result<Measured, CompareError> {
        let directions = Directions::of(scene, family, &self.values)?;
        let tangents = directions.tangents(self.model, scene, options)?;
        let numbers = RunNumbers::of(&Ok(tangents.run.clone()));
        let by_dz = tangents.outgoing[directions.offset()];
        let steepest = by_dz[0].norm().max(by_dz[1].norm());
        let [tilt1, tilt2] = directions.tilts(&tangents, directions.offset());
        let [turn1, turn2] = self.second_order(scene, options, steepest)?;
        let in_plane = tangents.run.outgoing.orientations;
        let has_headings = tangents.run.has_outgoing_angles();
        let turn = |dz: f64| -> Option<f64> {
            let run = self.model.run(&raised(scene, dz).ok()?, options).ok()?;
            (has_headings && run.has_outgoing_angles())
                .then(|| turn_rad(&in_plane, &run.outgoing.orientations))
        };
        let [one, six, fifteen] = TURNS_DEG.map(|degrees| {
            let target = f64::to_radians(degrees);
            let linear = target / steepest;
            [linear, offset_to(target, linear, turn)]
        });
        let row = SensitivityRow {
            method: self.model.method(),
            min_gap: numbers.min_gap,
            tau: numbers.tau,
            outcome: numbers.outcome,
            condition: directions.condition(&tangents),
            tilt1_per_a: tilt1,
            tilt2_per_a: tilt2,
            turn1_per_a2: turn1,
            turn2_per_a2: turn2,
            linear_1deg: one[0],
            offset_1deg: one[1],
            linear_6deg: six[0],
            offset_6deg: six[1],
            linear_15deg: fifteen[0],
            offset_15deg: fifteen[1],
            truncation: tangents.truncation,
        };
        Ok(Measured {
            row,
            derivatives: directions.derivatives(&tangents),
        })
    }

    /// Turn of both outgoing headings in the x-y plane over the square of the offset, in degrees, as the offset goes to zero: half the slope of the derivative
    /// by the offset, from those at `+-h` and `+-h/2` by Richardson's extrapolation, where 2 `h` turns the headings by about 0.1 degrees.
    fn second_order(
        &self,
        scene: &Scene,
        options: &RunOptions,
        steepest: f64,
    ) -> Result<[f64; 2], SceneError> {
        let h = (1e-3 / steepest).min(0.05);
        if h.is_nan() || h <= 0.0 {
            return Ok([f64::NAN; 2]);
        }
        let slope = |h: f64| {
            let at =
                |dz: f64| derivatives::turns_by_offset(self.model, &raised(scene, dz)?, options);
            let (above, below) = (at(h)?, at(-h)?);
            Ok::<_, SceneError>([0, 1].map(|k| (above[k] - below[k]) / (4.0 * h)))
        };
        let (coarse, fine) = (slope(h)?, slope(0.5 * h)?);
        Ok([0, 1].map(|k| (4.0 * fine[k] - coarse[k]) / 3.0))
    }
}

/// The row of a case without a result.
fn without_result(method: Method, reason: &NoRun) -> SensitivityRow {
    let nan = f64::NAN;
    SensitivityRow {
        method,
        min_gap: nan,
        tau: nan,
        outcome: reason.outcome().to_owned(),
        condition: nan,
        tilt1_per_a: nan,
        tilt2_per_a: nan,
        turn1_per_a2: nan,
        turn2_per_a2: nan,
        linear_1deg: nan,
        offset_1deg: nan,
        linear_6deg: nan,
        offset_6deg: nan,
        linear_15deg: nan,
        offset_15deg: nan,
        truncation: nan,
    }
}
