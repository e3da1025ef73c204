//! Runs cases by several methods, in parallel. The results have a fixed order.

use std::time::Instant;

use nalgebra::Vector3;
use rayon::prelude::*;
use scene::RunOptions;

use super::SweepOptions;
use crate::watch::{Pieces, Progress};
use crate::{Case, Encounter, Model, NoRun, OffsetRow};

/// Runs every case by every method. Methods are the outer loop.
#[must_use]
pub fn encounters(models: &[Model], cases: &[Case], options: &SweepOptions) -> Vec<Encounter> {
    let started = Instant::now();
    let progress = Progress::begin("encounters", models.len() * cases.len(), Pieces::Alike);
    let pairs: Vec<_> = (models.iter())
        .flat_map(|model| cases.iter().map(move |case| (model, case)))
        .collect();
    pairs
        .into_par_iter()
        .map(|(model, case)| {
            let late = (options.time_limit).is_some_and(|limit| started.elapsed() >= limit);
            let encounter = if late {
                skipped(model, case)
            } else {
                encounter(model, case, &options.run)
            };
            progress.advance();
            encounter
        })
        .collect()
}

pub(crate) fn skipped(model: &Model, case: &Case) -> Encounter {
    Encounter {
        case: *case,
        method: model.method(),
        run: Err(NoRun::Skipped),
        seconds: 0.0,
    }
}

pub(crate) fn encounter(model: &Model, case: &Case, options: &RunOptions) -> Encounter {
    let started = Instant::now();
    let run = model.attempt(case.scene(), options);
    Encounter {
        case: *case,
        method: model.method(),
        run,
        seconds: started.elapsed().as_secs_f64(),
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

pub(crate) fn offset_row(reference: &Encounter, offset: &Encounter) -> OffsetRow {
    let change = |k: usize| match (&reference.run, &offset.run) {
        (Ok(a), Ok(b)) if a.has_outgoing_angles() && b.has_outgoing_angles() => {
            let [a, b] = [a, b].map(|run| run.outgoing.orientations[k]);
            angle_between(a, b).to_degrees()
        }
        _ => f64::NAN,
    };
    OffsetRow {
        case: offset.case.approach.to_string(),
        method: offset.method.name(),
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
