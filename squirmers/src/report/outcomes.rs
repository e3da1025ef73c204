//! The section on outcomes: trajectories of Figs 1(c) and 2(c).

use serde::Serialize;

use super::written;
use crate::error::CommandError;
use crate::page::{Section, Table};
use crate::pictures;
use compare::output::OutputFolder;
use compare::study::panels::{PanelRun, Panels};
use compare::sweep::SweepOptions;
use compare::{Defaults, Method, Model};

pub(super) fn section(
    models: &[&Model],
    sweep: &SweepOptions,
    out: &OutputFolder,
) -> Result<Section, CommandError> {
    let defaults = Defaults::paper()?;
    let (mut figures, mut tables) = (Vec::new(), Vec::new());
    for (name, title, panels) in [
        ("outcomes", "What can become of a pair", defaults.outcome),
        ("examples", "Neutral squirmers meet", defaults.example),
    ] {
        let Panels { runs, csv } = Panels::run(name, models, &panels, sweep, out)?;
        let drawn = pictures::of_panels(&format!("{name}.svg"), title, &runs)?;
        figures.extend(written(drawn.into_iter().collect(), out)?);
        let summary: Vec<_> = runs.iter().map(ExampleRow::of).collect();
        let caption = "Outcome of each pair. The linked file has the trajectories.";
        let table = Table::from_rows(caption, &format!("{name}.csv"), &summary)?;
        tables.push(Table { csv, ..table });
    }
    Ok(Section {
            id: "outcomes".to_owned(),
            title: "Outcomes (Figs 1c and 2c)".to_owned(),
            prose: vec![
                "The first picture shows one start for each outcome of lubrication theory. The second shows neutral \
                 squirmers that slide along each other (i), turn together (ii, iii) or brush past each other (iv). The lower \
                 rows show the same starts by exact hydrodynamics. Arrows are orientations."
                    .to_owned(),
            ],
            figures,
            tables,
            ..Section::default()
        })
}

/// The result of one start by one method.
#[derive(Serialize)]
struct ExampleRow {
    panel: String,
    method: Method,
    beta: f64,
    delta: f64,
    sigma: f64,
    outcome: String,
    deflection1_deg: f64,
    deflection2_deg: f64,
    min_gap: f64,
    tau: f64,
}

impl ExampleRow {
    fn of(example: &PanelRun) -> Self {
        let run = example.run.as_ref().ok();
        let deflection = |k: usize| run.map_or(f64::NAN, |r| r.deflections_rad()[k].to_degrees());
        Self {
            panel: example.case.panel.clone(),
            method: example.method,
            beta: example.case.beta,
            delta: example.case.delta,
            sigma: example.case.sigma,
            outcome: run.map_or("failed".to_owned(), |run| run.outcome.to_string()),
            deflection1_deg: deflection(0),
            deflection2_deg: deflection(1),
            min_gap: run.map_or(f64::NAN, |run| run.min_gap),
            tau: run.map_or(f64::NAN, |run| run.contact_time),
        }
    }
}
