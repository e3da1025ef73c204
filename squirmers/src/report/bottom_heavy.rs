//! The section on bottom-heavy squirmers: the panels of Fig. 8(a-f), and the shares of orbits (Fig. 8g).

use crate::error::CommandError;
use crate::page::{Figure, Section, Table};
use crate::{figures, pictures};
use compare::output::{OutputFolder, csv_text};
use compare::study::maps::{Grid, Maps, Pair};
use compare::study::panels::{PanelRun, Panels};
use compare::sweep::SweepOptions;
use compare::{Defaults, Model};

use super::{findings, words, written};

/// Points a side of the maps for the shares. A share of 20 % then has a standard error of 3 %.
const GRID: usize = 14;

/// Tolerance of the integrator in the maps, as in the command `fates`.
const TOLERANCE: f64 = 1e-7;

/// Squirmer parameters of the shares: strong pushers, as in the paper, and strong pullers.
const BETA: [f64; 2] = [-5.0, 5.0];

/// Bottom-heavinesses of the shares.
const GRAVITY: [f64; 5] = [0.0, 1.0, 2.0, 2.5, 3.0];

/// The maps from which the shares of orbits follow.
pub(super) fn orbit_maps<'a>(
    models: &[&'a Model],
    sweep: &SweepOptions,
    out: &'a OutputFolder,
) -> Result<Maps<'a>, CommandError> {
    let mut options = *sweep;
    options.run.tolerance = TOLERANCE;
    Ok(Maps {
        name: "gravity-fates",
        models: models.to_vec(),
        exact: None,
        pairs: (BETA.iter())
            .flat_map(|&beta| GRAVITY.map(|g| Pair { beta, g, dz: 0.0 }))
            .collect(),
        grid: Grid::new(GRID)?,
        options,
        out,
    })
}

/// The section, and a message about each run without a result.
pub(super) fn section(
    models: &[&Model],
    sweep: &SweepOptions,
    out: &OutputFolder,
) -> Result<(Section, Vec<String>), CommandError> {
    let panels = Defaults::paper()?.bottom_heavy;
    let Panels { runs, csv } = Panels::run("bottom-heavy", models, &panels, sweep, out)?;
    let summary: Vec<_> = runs.iter().map(PanelRun::summary).collect();
    let picture = pictures::of_bottom_heavy(&runs)?;

    let orbits = orbit_maps(models, sweep, out)?.fates()?;
    let mut shown = written(picture.into_iter().collect(), out)?;
    let mut tables = vec![Table {
        csv,
        file_name: "bottom-heavy.csv".to_owned(),
        ..Table::from_rows(
            "Outcome of each panel's pair at t = 200, and its depth divided by the depth of two lone squirmers. The \
             linked file has the trajectories.",
            "bottom-heavy.csv",
            &summary,
        )?
    }];
    // These are left out if the time limit was reached.
    if let Some(orbits) = &orbits {
        let csv = csv_text(orbits)?;
        out.write("gravity-fates.csv", &csv)?;
        let svg = figures::fates(orbits)?;
        out.write("gravity-fates.svg", &svg)?;
        shown.push(Figure {
            svg,
            caption: words::caption("gravity-fates").to_owned(),
        });
        tables.push(Table::from_csv(
            "Share of each outcome under gravity, over all incoming angles.",
            "gravity-fates.csv",
            &csv,
        )?);
    }
    let section = Section {
        id: "bottom-heavy".to_owned(),
        title: "Bottom-heavy squirmers (Fig. 8)".to_owned(),
        finding: findings::of_gravity(&summary, orbits.as_deref().unwrap_or_default()),
        prose: vec![words::BOTTOM_HEAVY.to_owned(), findings::panels(&summary)],
        figures: shown,
        tables,
    };
    let failures = runs.iter().filter_map(PanelRun::failure);
    Ok((section, failures.collect()))
}
