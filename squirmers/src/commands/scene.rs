//! `squirmers run` and `squirmers explain`: one scene from a file.

use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use scene::{Outcome, Plan, Run};

use crate::arguments::GeneralArguments;
use crate::error::CommandError;
use crate::streams::{print_error, print_line};
use crate::terminal::{print_rows, words};
use compare::numbers::{rounded, size, written};
use compare::scene_run::{self, SampleRow, Summary};
use compare::{CompareError, Model, SceneFile};

/// Largest size of a scene file, in bytes.
const LONGEST_FILE: u64 = 1 << 20;

#[derive(Debug, Args)]
pub(crate) struct RunArguments {
    /// Scene file (docs/SCENES.md lists its keys)
    #[arg(value_name = "SCENE.toml")]
    file: PathBuf,
    /// Print only the summary, as one JSON object, on standard output
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct ExplainArguments {
    /// Scene file (docs/SCENES.md lists its keys)
    #[arg(value_name = "SCENE.toml")]
    file: PathBuf,
}

/// Reads the text of a scene file.
pub(super) fn text(path: &Path) -> Result<String, CommandError> {
    let failed = |source| CompareError::Read {
        path: path.to_owned(),
        source,
    };
    let file = File::open(path).map_err(failed)?;
    let mut text = String::new();
    // Files such as /dev/zero never end.
    let read = file.take(LONGEST_FILE + 1).read_to_string(&mut text);
    if text.len() as u64 > LONGEST_FILE {
        let reason = format!("it is longer than {LONGEST_FILE} bytes, the limit for scene files");
        return Err(failed(std::io::Error::new(ErrorKind::FileTooLarge, reason)).into());
    }
    read.map_err(failed)?;
    Ok(text)
}

pub(super) fn read(path: &Path) -> Result<SceneFile, CommandError> {
    let parsed = SceneFile::parse(&text(path)?).map_err(|mistakes| CompareError::SceneFile {
        path: path.to_owned(),
        mistakes,
    });
    Ok(parsed?)
}

fn set_up(
    file: &SceneFile,
    plan: &Plan,
    general: &GeneralArguments,
) -> Result<Model, CommandError> {
    let options = file.model_options(plan, general.model_options());
    Ok(Model::set_up(file.method, &options)?)
}

pub(super) fn run(
    arguments: &RunArguments,
    general: &GeneralArguments,
) -> Result<(), CommandError> {
    let file = read(&arguments.file)?;
    let plan = Plan::new(&file.scene)?;
    let out = general.output()?;
    let model = set_up(&file, &plan, general)?;
    let started = Instant::now();
    let streamed = scene_run::stream(&model, &plan, &file.run, &out);
    if streamed.is_err() {
        let earlier = scene_run::earlier(&out);
        if !earlier.is_empty() {
            print_error!("files of an earlier run were kept: {}", earlier.join(", "));
        }
    }
    let (run, rows) = streamed?;
    let seconds = started.elapsed().as_secs_f64();
    let svg = crate::figures::scene_run(&file.scene, &rows, !plan.is_level())?;
    out.write("run.svg", &svg)?;
    let summary = Summary::new(&run, &plan, file.method, seconds);
    let json = summary.json()?;
    out.write("run.json", &json)?;
    scene_run::forget_earlier(&out)?;
    if arguments.json {
        print_line!("{json}");
    } else {
        print_summary(&summary, &run, &rows);
    }
    Ok(())
}

fn print_summary(summary: &Summary, run: &Run, rows: &[SampleRow]) {
    let [one, two] = run.start.radii;
    let mut lines = vec![
        ["outcome".to_owned(), summary.outcome.clone()],
        ["end time [a/V_s]".to_owned(), rounded(summary.end_time, 6)],
        ["smallest gap [a]".to_owned(), rounded(summary.min_gap, 6)],
        [
            format!("time at gaps up to {}", written(one.min(two))),
            rounded(summary.contact_time, 6),
        ],
        [
            "deflection 1 [deg]".to_owned(),
            rounded(summary.deflection1_deg, 6),
        ],
        [
            "deflection 2 [deg]".to_owned(),
            rounded(summary.deflection2_deg, 6),
        ],
        ["method".to_owned(), summary.method.to_owned()],
        [
            "state".to_owned(),
            format!("{}, {} numbers", summary.state, summary.numbers),
        ],
        [
            "steps".to_owned(),
            format!("{} ({} rejected)", summary.steps, summary.rejected),
        ],
        ["loads".to_owned(), format!("{}", summary.loads)],
        ["free flights".to_owned(), format!("{}", summary.flights)],
        ["samples".to_owned(), format!("{}", rows.len())],
    ];
    if run.outcome == Outcome::Unresolved {
        lines.push([
            "ended at gap [a]".to_owned(),
            format!(
                "{}, the smallest that the model resolves",
                rounded(run.end.gap.eps(), 6)
            ),
        ]);
    }
    if let Some(settled) = run.settled {
        lines.push(["steady from t =".to_owned(), rounded(settled, 4)]);
    }
    print_rows(&["", ""], lines.into_iter().map(Vec::from));
}

pub(super) fn explain(
    arguments: &ExplainArguments,
    general: &GeneralArguments,
) -> Result<(), CommandError> {
    let file = read(&arguments.file)?;
    let plan = Plan::new(&file.scene)?;
    let model = set_up(&file, &plan, general)?;
    let needed = plan.needed_loads();
    let classes: Vec<_> = (needed.symmetry_classes().iter())
        .map(ToString::to_string)
        .collect();
    let state = plan.state();
    let lines = [
        ("hydrodynamics", file.method.title().to_owned()),
        (
            "state",
            format!(
                "{state}: {} numbers ({})",
                state.numbers(),
                state.variables()
            ),
        ),
        ("loads", needed.names().join("; ")),
        (
            "symmetry classes",
            format!("of boundary elements: {}", classes.join(", ")),
        ),
    ];
    let line = |(name, text): (&str, String)| vec![name.to_owned(), text];
    print_line!("{}\n", words(lines.into_iter().map(line)));
    let header = ["effect", "runs", "why"].map(str::to_owned).to_vec();
    let rows = model.explain(&plan).into_iter().map(|row| {
        let runs = if row.runs { "yes" } else { "no" };
        vec![row.effect.to_owned(), runs.to_owned(), row.reason]
    });
    print_line!("{}\n", words([header].into_iter().chain(rows)));
    let cost = [vec![cost_in_words(&model, &plan)]];
    print_line!("{}", words(cost.into_iter()));
    Ok(())
}

/// The cost of the run as counts, which are equal on every machine.
fn cost_in_words(model: &Model, plan: &Plan) -> String {
    let stages = "An accepted step takes 12 right-hand sides";
    match model.table() {
        Some(table) => format!(
            "{stages}, which read {} mobilities from a table. Building the table took {} solves, each of a part of the \
             balance; its interpolation error is {}. It is kept for other scenes.",
            plan.mobility_count(),
            table.evaluations,
            size(table.interpolation_error)
        ),
        None if model.is_direct() => format!("{stages}, each of which solves the model once."),
        None => format!("{stages}, each of which evaluates a closed form."),
    }
}
