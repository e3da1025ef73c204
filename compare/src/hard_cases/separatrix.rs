//! Collisions next to a line where the outcome changes, and how deflections converge away from such lines.

use scene::{Outcome, Run};

use super::rows::larger;
use super::standoff::slope;
use super::{Bench, Rows, SIZE, until};
use crate::study::maps::Pair;
use crate::{Approach, Case, CompareError, Method, Model};

/// The tolerance of the runs that the others are compared with.
const TIGHT: f64 = 1e-12;

/// Time at which runs end: by then the outcomes differ.
const TIME: f64 = 200.0;

/// Where `Delta` is varied until the outcome changes: method, squirmer parameter and `Sigma`.
const CROSSED: [(Method, f64, f64); 4] = [
    (Method::Lt, 5.0, 0.7),
    (Method::Lt, -5.0, 0.7),
    (Method::Exact, 5.0, 0.7),
    (Method::Exact, 1.0, 0.8),
];

pub(super) fn cases(bench: &Bench, rows: &mut Rows) {
    for (method, beta, sigma) in CROSSED {
        for model in bench.only(&[method]) {
            let what = format!("beta {beta}, Sigma {sigma}");
            rows.attempt(method.name(), &what, |rows| {
                crossed(model, beta, sigma, &what, rows)
            });
        }
    }
    for model in bench.only(&[Method::Lt, Method::LtCorrected, Method::Exact]) {
        rows.attempt(model.method().name(), "order", |rows| order(model, rows));
    }
}

fn collide(
    model: &Model,
    beta: f64,
    (delta, sigma): (f64, f64),
    tolerance: f64,
) -> Result<Run, CompareError> {
    let scene = Pair {
        beta,
        g: 0.0,
        dz: 0.0,
    }
    .scene(delta, sigma)?;
    Ok(model.run(&scene, &until(TIME, tolerance))?)
}

fn scatters(
    model: &Model,
    beta: f64,
    at: (f64, f64),
    tolerance: f64,
) -> Result<bool, CompareError> {
    Ok(collide(model, beta, at, tolerance)?.outcome == Outcome::Scattered)
}

fn crossed(
    model: &Model,
    beta: f64,
    sigma: f64,
    what: &str,
    rows: &mut Rows,
) -> Result<(), CompareError> {
    let name = model.method().name();
    let deltas: Vec<_> = (0..40).map(|i| 0.02 + 0.05 * f64::from(i)).collect();
    let outcomes = (deltas.iter())
        .map(|&delta| scatters(model, beta, (delta, sigma), TIGHT))
        .collect::<Result<Vec<_>, _>>()?;
    let Some(at) = outcomes.windows(2).position(|pair| pair[0] != pair[1]) else {
        let why = (0.0, "there is at least one");
        rows.add(
            name,
            format!("{what}: lines between outcomes found"),
            why,
            f64::NAN,
        );
        return Ok(());
    };
    // Where the outcome changes, at a tolerance.
    let line = |tolerance: f64| -> Result<f64, CompareError> {
        let (mut low, mut high) = (deltas[at], deltas[at + 1]);
        while high - low > 1e-13 {
            let middle = 0.5 * (low + high);
            if scatters(model, beta, (middle, sigma), tolerance)? == outcomes[at] {
                low = middle;
            } else {
                high = middle;
            }
        }
        Ok(0.5 * (low + high))
    };
    let truth = line(TIGHT)?;
    for tolerance in [1e-6, 1e-8, 1e-10] {
        let beside = collide(model, beta, (truth - 1e-9, sigma), tolerance)?;
        let steps = (beside.counters.steps + 1) as f64;
        let why = "steps x tolerance x (1 + |y|): deviations from the line shrink backwards in time, so that Delta shifts by no more";
        let bound = steps * tolerance * SIZE + 1e-11;
        rows.add(name, format!("{what}: shift in Delta of the line between scattered and bound, tolerance {tolerance:e}"), (bound, why), (line(tolerance)? - truth).abs());
    }
    Ok(())
}

/// Away from such lines the error of the deflection falls with the number of steps as their order says: 8 for the
/// steps, 7 for the dense output in which the departure is located.
fn order(model: &Model, rows: &mut Rows) -> Result<(), CompareError> {
    let name = model.method().name();
    for (approach, beta, dx) in [
        (Approach::HeadOn, 5.0, 1.0),
        (Approach::Orthogonal, 1.0, 2.0),
        (Approach::Orthogonal, -1.0, 1.0),
    ] {
        let scene = Case {
            approach,
            beta,
            dx,
            dz: 0.0,
        }
        .scene()?;
        let truth = model.run(&scene, &until(TIME, 1e-14))?.deflections_rad()[0];
        let mut points = Vec::new();
        for half_decade in 8..=20 {
            let run = model.run(
                &scene,
                &until(TIME, 10f64.powf(-0.5 * f64::from(half_decade))),
            )?;
            let error = (run.deflections_rad()[0] - truth).abs();
            points.push(((run.counters.steps as f64).ln(), larger(error, 1e-15).ln()));
        }
        let why = "steps are of order 8; the dense output, which locates events, is of order 7";
        rows.add(name, format!("{approach}, beta {beta}, dx {dx}: slope of the deflection's error against the number of steps"), (-7.0, why), slope(&points));
    }
    Ok(())
}
