//! What suspensions feel: diffusivities by collisions of each model, on few points. A part of a section of the page.

use serde::Serialize;

use super::findings::number;
use super::written;
use crate::error::CommandError;
use crate::page::{Figure, Table};
use crate::pictures;
use compare::numbers::rounded;
use compare::output::{OutputFolder, csv_text};
use compare::study::kinetics::{
    CONTACT, KineticsRatioRow, KineticsRow, KineticsSweep, Sampling, ratios,
};
use compare::sweep::SweepOptions;
use compare::{Method, Model, ModelOptions};

/// Squirmer parameters, encounters of a replication, replications: a few seconds.
const BETA: [f64; 3] = [-5.0, 0.0, 5.0];
const ENCOUNTERS: usize = 256;
const REPLICATIONS: usize = 8;

/// Tolerance of the integrator: far below sampling errors.
const TOLERANCE: f64 = 1e-6;

/// Collision integrals for the page.
#[derive(Debug, Default)]
pub(super) struct Kinetics {
    /// The finding in a sentence or two; empty if exact hydrodynamics was not asked for.
    pub(super) finding: String,
    /// Paragraphs.
    pub(super) prose: Vec<String>,
    /// The picture.
    pub(super) figures: Vec<Figure>,
    /// The coefficients, and what each method makes of the exact ones.
    pub(super) tables: Vec<Table>,
}

/// The columns that the page has room for.
#[derive(Serialize)]
struct Shown {
    method: Method,
    beta: f64,
    bound: f64,
    tau: f64,
    rotation: f64,
    rotation_error: f64,
    displacement: f64,
    displacement_error: f64,
    growth: f64,
    growth_error: f64,
}

impl Shown {
    fn of(row: &KineticsRow) -> Self {
        Self {
            method: row.method,
            beta: row.beta,
            bound: row.bound,
            tau: row.tau,
            rotation: row.rotation,
            rotation_error: row.rotation_error,
            displacement: row.displacement,
            displacement_error: row.displacement_error,
            growth: row.growth,
            growth_error: row.growth_error,
        }
    }
}

/// Collision integrals by `methods`, and their files. Boundary elements are left out: they agree with exact hydrodynamics, and their tables are
/// dear. Nothing if the time limit was reached.
pub(super) fn kinetics(
    methods: &[Method],
    options: &ModelOptions,
    sweep: &SweepOptions,
    out: &OutputFolder,
) -> Result<Kinetics, CommandError> {
    let cheap = methods.iter().filter(|method| **method != Method::Bem);
    let models =
        (cheap.map(|&method| Model::set_up(method, options))).collect::<Result<Vec<_>, _>>()?;
    let sampling = Sampling::new(&[CONTACT], ENCOUNTERS, REPLICATIONS)?;
    let mut runs = *sweep;
    runs.run.tolerance = TOLERANCE;
    let integrals = KineticsSweep {
        models: &models,
        betas: &BETA,
        sampling: &sampling,
        options: runs,
        out,
    };
    let Some(estimates) = integrals.run()? else {
        return Ok(Kinetics::default());
    };
    let rows: Vec<KineticsRow> = estimates.iter().map(|of| of.row()).collect();
    let against = ratios(&estimates);
    let (csv, ratios_csv) = (csv_text(&rows)?, csv_text(&against)?);
    out.write("kinetics.csv", &csv)?;
    out.write("kinetics-ratios.csv", &ratios_csv)?;
    let picture = pictures::of_kinetics(&rows)?;
    Ok(Kinetics {
        finding: finding(&against),
        prose: vec![
            "In a dilute suspension each squirmer meets others at random. Averages over such encounters, all incoming directions in space \
             alike, give what the suspension feels: diffusivities per density, and the growth rate of polar order. Pairs that do not \
             part add nothing. docs/KINETICS.md has the definitions."
                .to_owned(),
        ],
        figures: written(picture.into_iter().collect(), out)?,
        tables: vec![
            Table::from_rows(
                "Collision integrals over density n, with their sampling errors. An encounter has an impact parameter up to 3 a. The file has all columns.",
                "kinetics.csv",
                &rows.iter().map(Shown::of).collect::<Vec<_>>(),
            )?,
            Table::from_csv(
                "Each coefficient by each method against exact hydrodynamics.",
                "kinetics-ratios.csv",
                &ratios_csv,
            )?,
        ],
    })
}

/// What lubrication theory makes of the rotational diffusivity.
fn finding(rows: &[KineticsRatioRow]) -> String {
    let of = |row: &&KineticsRatioRow| {
        row.method == Method::Lt && row.quantity == "rotation" && row.ratio.is_finite()
    };
    let told: Vec<String> = (rows.iter().filter(of))
        .map(|row| {
            let (ratio, error) = (rounded(row.ratio, 2), rounded(2.0 * row.ratio_error, 2));
            format!("{ratio} ± {error} at β = {}", number(row.beta))
        })
        .collect();
    if told.is_empty() {
        return String::new();
    }
    format!(
        "The rotational diffusivity of a dilute suspension by lubrication theory over that by exact hydrodynamics is {} (with two standard errors of the sampling).",
        super::findings::listed(&told)
    )
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

    use super::*;

    #[test]
    fn the_part_of_the_page_has_a_picture_two_tables_and_a_finding() {
        let folder = tempfile::tempdir().unwrap();
        let out = OutputFolder::open(folder.path()).unwrap();
        let sweep = SweepOptions {
            run: scene::RunOptions::default(),
            time_limit: None,
        };
        let options = ModelOptions::default();
        let methods = [Method::Lt, Method::Exact, Method::Bem];
        let part = kinetics(&methods, &options, &sweep, &out).unwrap();
        assert_eq!((part.figures.len(), part.tables.len()), (1, 2));
        assert!(part.finding.contains("β = 5"), "{}", part.finding);
        assert!(part.figures[0].svg.contains("Rotational diffusivity"));
        assert!(!part.figures[0].svg.contains("NaN"));
        assert!(out.holds("kinetics.svg"));
        assert!(!part.prose.is_empty());
    }
}
