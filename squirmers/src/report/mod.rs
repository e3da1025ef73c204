//! The command `report`: all comparisons for the paper's cases, as files and as one page.

mod bottom_heavy;
mod convergence;
mod cost;
mod effects;
mod errors;
mod findings;
mod flows;
mod fluid;
mod growth;
mod hard_cases;
mod kinetics;
mod maps;
mod off_plane;
mod outcomes;
mod peers;
mod unlike;
mod words;

use std::path::PathBuf;
use std::time::Instant;

use scene::{Gap, LoadSet, TableLimit};

use crate::commands::encounters::cases;
use crate::commands::maps::METHODS;
use crate::page::{Figure, MethodCost, Page, Section, Table, render};
use crate::pictures::{Picture, of_encounters, of_offsets};
use compare::output::{OutputFolder, csv_text};
use compare::study::encounters::{Drawn, EncounterSweep};
use compare::sweep::SweepOptions;
use maps::ReportMaps;
use unlike::UnlikeRadii;

use crate::error::CommandError;
use crate::provenance;
use compare::{Approach, Case, Defaults, Encounter, Method, Model, ModelOptions};

/// Gaps at which the page states each model's own error estimate. They are typical of collisions.
const STATED_GAPS: [f64; 3] = [0.1, 0.01, 0.005];

/// Loads that the paper's cases read.
const LOADS: LoadSet = LoadSet::all(2);

/// Runs everything, writes the files of each command into `out`, and writes the page that shows them. Returns the
/// path of the page. `typed` is the command line, for the footer.
pub(crate) fn write(
    methods: &[Method],
    options: &ModelOptions,
    sweep: &SweepOptions,
    out: &OutputFolder,
    typed: &[String],
) -> Result<PathBuf, CommandError> {
    let started = Instant::now();
    let models = (methods.iter())
        .map(|&method| Model::set_up(method, options))
        .collect::<Result<Vec<_>, _>>()?;
    check_kept(&models, sweep, out)?;
    let maps = ReportMaps::new(&models, sweep, out);
    if let Some(maps) = &maps {
        maps.check()?;
    }
    let unlike = UnlikeRadii::new(methods, options, sweep, out)?;
    if let Some(unlike) = &unlike {
        unlike.check()?;
    }
    off_plane::check(&models, sweep, out)?;
    let under_gravity: Vec<&Model> = (models.iter())
        .filter(|model| METHODS.contains(&model.method()))
        .collect();
    if !under_gravity.is_empty() {
        bottom_heavy::orbit_maps(&under_gravity, sweep, out)?.check()?;
    }
    let mut content = Content::default();
    for approach in [Approach::HeadOn, Approach::Orthogonal] {
        content.add_encounters(approach, &models, sweep, out)?;
    }
    let planar = content.encounters.clone();
    content.add_offsets(&models, sweep, out)?;
    content.add_bottom_heavy(&under_gravity, sweep, out)?;
    if let Some(exact) = models.iter().find(|m| m.method() == Method::Exact) {
        let section = errors::section(&models, exact, planar, sweep, out)?;
        content.sections.push(section);
    }
    if methods.contains(&Method::Bem) {
        content.sections.push(convergence::section(out)?);
    }
    if let Some(maps) = maps {
        content.sections.extend(maps.sections()?);
    }
    if let Some(unlike) = unlike {
        content.sections.extend(unlike.sections()?);
    }
    if let Some((section, failures)) = fluid::section(methods, options, out)? {
        content.sections.push(section);
        content.notes.extend(failures);
    }
    content
        .sections
        .push(off_plane::section((methods, &models), options, sweep, out)?);
    content.sections.push(effects::section(&models)?);
    content
        .sections
        .push(hard_cases::section(methods, options, out)?);
    if let Some(exact) = models.iter().find(|model| model.method() == Method::Exact) {
        content.sections.push(peers::section(exact, out)?);
        content.sections.push(cost::section(out)?);
    }
    let page = Page {
        title: "Two squirmers collide: lubrication theory against full hydrodynamics".to_owned(),
        lead: words::lead(),
        sections: content.sections,
        costs: (models.iter())
            .map(|model| method_cost(model, &content.encounters))
            .collect(),
        notes: content.notes,
        provenance: provenance::of(typed, started.elapsed().as_secs_f64()),
    };
    let page = render(&page);
    if out.account().stopped() {
        return Ok(out.write(UNFINISHED, &page)?);
    }
    if out.holds(UNFINISHED) {
        out.remove(UNFINISHED)?;
    }
    Ok(out.write("index.html", &page)?)
}

/// Name of a page that is incomplete because of the time limit. It never replaces a complete page.
const UNFINISHED: &str = "index.unfinished.html";

/// The paper's encounters of an approach.
fn paper_cases(approach: Approach) -> Result<Vec<Case>, CommandError> {
    let defaults = Defaults::paper()?;
    let lists = defaults.encounters(approach);
    cases(approach, &lists.beta, &lists.dx, &lists.dz)
}

/// The paper's offsets out of the plane, and its cases with and without each of them.
fn offset_cases() -> Result<(Vec<f64>, Vec<Case>), CommandError> {
    let defaults = Defaults::paper()?.offset;
    let cases = compare::with_offsets(&defaults.cases(), &defaults.dz);
    Ok((defaults.dz, cases))
}

fn encounter_sweep<'a>(
    name: &'a str,
    models: &'a [Model],
    cases: &'a [Case],
    options: &'a SweepOptions,
    out: &'a OutputFolder,
) -> EncounterSweep<'a> {
    EncounterSweep {
        name,
        models,
        cases,
        options,
        out,
    }
}

/// Checks, before anything is computed, that no finished rows of an earlier command would be deleted.
fn check_kept(
    models: &[Model],
    sweep: &SweepOptions,
    out: &OutputFolder,
) -> Result<(), CommandError> {
    for approach in [Approach::HeadOn, Approach::Orthogonal] {
        let (name, cases) = (approach.to_string(), paper_cases(approach)?);
        encounter_sweep(&name, models, &cases, sweep, out).check_encounters()?;
    }
    let (dz, cases) = offset_cases()?;
    Ok(encounter_sweep("offset", models, &cases, sweep, out).check_offsets(&dz)?)
}

/// The content of the page so far.
#[derive(Default)]
struct Content {
    sections: Vec<Section>,
    notes: Vec<String>,
    encounters: Vec<Encounter>,
}

impl Content {
    fn add_encounters(
        &mut self,
        approach: Approach,
        models: &[Model],
        sweep: &SweepOptions,
        out: &OutputFolder,
    ) -> Result<(), CommandError> {
        let (name, cases) = (approach.to_string(), paper_cases(approach)?);
        let kept = encounter_sweep(&name, models, &cases, sweep, out);
        let mut rows = Vec::new();
        let encounters = kept.encounters(Drawn::Paths, &mut |row| rows.push(row))?;
        let csv = csv_text(&rows)?;
        let file_name = format!("{name}.csv");
        let (title, prose) = words::encounters(approach);
        self.sections.push(Section {
            id: approach.to_string(),
            title: title.to_owned(),
            finding: findings::of_encounters(&encounters),
            prose: vec![prose],
            figures: written(of_encounters(approach, &encounters, Drawn::Paths)?, out)?,
            tables: vec![Table::from_csv(
                "Deflection is the outgoing minus the incoming angle; tau is the interaction time (at gaps up \
                 to 1); seconds are the wall-clock time of the run without the table's set-up.",
                &file_name,
                &csv,
            )?],
        });
        self.take(encounters);
        Ok(())
    }

    fn add_offsets(
        &mut self,
        models: &[Model],
        sweep: &SweepOptions,
        out: &OutputFolder,
    ) -> Result<(), CommandError> {
        let (dz, cases) = offset_cases()?;
        let kept = encounter_sweep("offset", models, &cases, sweep, out);
        let mut rows = Vec::new();
        kept.offsets(&dz, &mut |row| rows.push(row))?;
        let csv = csv_text(&rows)?;
        self.sections.push(Section {
            id: "offset".to_owned(),
            title: "Sensitivity to an offset out of the plane (Fig. 5b)".to_owned(),
            finding: findings::of_offsets(&rows),
            prose: vec![
                "Squirmer 1 starts at z = dz/2, squirmer 2 at z = -dz/2. The picture shows the angle \
                 between a squirmer's outgoing orientations with and without the offset."
                    .to_owned(),
                words::bound_in_plane(&rows),
            ],
            figures: written(of_offsets(&rows)?.into_iter().collect(), out)?,
            tables: vec![Table::from_csv(
                "Change of the outgoing orientations. For a pair that stays bound, orientations are those at the end of \
                 the run (t = 200).",
                "offset.csv",
                &csv,
            )?],
        });
        Ok(())
    }

    /// Adds bottom-heavy squirmers by lubrication theory as published and by exact hydrodynamics, if requested.
    fn add_bottom_heavy(
        &mut self,
        models: &[&Model],
        sweep: &SweepOptions,
        out: &OutputFolder,
    ) -> Result<(), CommandError> {
        if !models.is_empty() {
            let (section, failures) = bottom_heavy::section(models, sweep, out)?;
            self.sections.push(section);
            self.notes.extend(failures);
        }
        Ok(())
    }

    fn take(&mut self, encounters: Vec<Encounter>) {
        self.notes
            .extend(encounters.iter().filter_map(Encounter::failure));
        self.encounters.extend(encounters);
    }
}

/// A caption that begins with the title of its picture, which names the model and the parameters.
fn captioned(svg: &str, text: &str) -> String {
    let title = (svg.split_once("aria-label=\""))
        .and_then(|(_, rest)| rest.split_once('"'))
        .map_or("", |(title, _)| title);
    if title.is_empty() {
        text.to_owned()
    } else {
        format!("{title}. {text}")
    }
}

/// Writes pictures to their files and makes figures of them.
fn written(pictures: Vec<Picture>, out: &OutputFolder) -> Result<Vec<Figure>, CommandError> {
    (pictures.into_iter())
        .map(|Picture { file_name, svg }| {
            out.write_unless_less(&file_name, &svg)?;
            Ok(Figure {
                caption: captioned(&svg, words::caption(&file_name)),
                svg,
            })
        })
        .collect()
}

fn method_cost(model: &Model, encounters: &[Encounter]) -> MethodCost {
    let seconds: Vec<_> = (encounters.iter())
        .filter(|encounter| encounter.method == model.method() && encounter.run.is_ok())
        .map(|encounter| encounter.seconds)
        .collect();
    let (gaps_evaluated, interpolation_error, limit) = match model.table() {
        Some(table) => {
            let limit = match table.limit {
                TableLimit::Tolerance(_) => "tolerance",
                TableLimit::Noise(_) => "model noise",
                TableLimit::Missed(_) => "not reached",
            };
            (table.evaluations, table.interpolation_error, limit)
        }
        None if model.is_direct() => (0, f64::NAN, "solved directly"),
        None => (0, f64::NAN, "closed form"),
    };
    // A closed form has no error estimate of its own.
    let stated = |eps: f64| {
        let gap = Gap::new(eps).ok()?;
        let error = model.error_estimate(gap, LOADS).ok()??;
        Some((eps, error))
    };
    MethodCost {
        method: model.method().name().to_owned(),
        set_up_seconds: model.set_up_seconds(),
        gaps_evaluated,
        interpolation_error,
        limit: limit.to_owned(),
        error_at_contact: STATED_GAPS.into_iter().filter_map(stated).collect(),
        seconds_per_run: seconds.iter().sum::<f64>() / seconds.len() as f64,
    }
}
