//! `squirmers sensitivity`: derivatives of collisions, and how far a squirmer can be offset out of the plane.

use std::path::Path;
use std::time::Duration;

use clap::Args;
use compare::Method;
use compare::numbers::{Numbers, parse_number, rounded, written};
use compare::study::sensitivity::{self, Part, SensitivityCase, SensitivityStudy};
use compare::sweep::{Points, RunChoices, checked_time_limit, checked_tolerance};

use super::many::{keep_first, print_rest};
use super::shared::{model_options, set_up};
use super::sweep::{family, parse_vary};
use crate::arguments::{GeneralArguments, ModelArguments};
use crate::error::CommandError;
use crate::pictures;
use crate::terminal::print_rows;

#[derive(Debug, Args)]
pub(crate) struct SensitivityArguments {
    /// Scene file with parameters (docs/SCENES.md), or opposed, right-angles or incoming-angles [default: the paper's encounters]
    #[arg(value_name = "FAMILY")]
    family: Option<String>,
    /// A parameter and its values. Repeat the option for more parameters; the last one varies fastest
    #[arg(long, value_name = "NAME=LIST", value_parser = parse_vary, allow_hyphen_values = true, requires = "family")]
    vary: Vec<(String, Numbers)>,
    /// Tolerance of the integrator [default: 1e-10, or the family's if it is tighter]
    #[arg(long, value_name = "TOL", value_parser = parse_number, allow_hyphen_values = true)]
    tol: Option<f64>,
    #[command(flatten)]
    models: ModelArguments,
    /// Begin no further case after this time
    #[arg(long, value_name = "SECONDS", value_parser = parse_number, allow_hyphen_values = true)]
    time_limit: Option<f64>,
}

pub(super) fn run(
    arguments: &SensitivityArguments,
    general: &GeneralArguments,
) -> Result<(), CommandError> {
    let (methods, options) = model_options(&arguments.models, &Method::DEFAULT, general)?;
    let time_limit: Option<Duration> = checked_time_limit(arguments.time_limit)?;
    let choices = RunChoices {
        tolerance: arguments.tol.map(checked_tolerance).transpose()?,
        angles_at: f64::INFINITY,
    };
    let parts = match &arguments.family {
        Some(named) => vec![Part {
            case: Path::new(named)
                .file_stem()
                .map_or(named.clone(), |stem| stem.to_string_lossy().into_owned()),
            points: Points::new(family(named)?, &arguments.vary, choices)?,
        }],
        None => Part::paper(choices)?,
    };
    let options = options.for_reads(sensitivity::reads(&parts)?);
    let out = general.output()?;
    let models = set_up(&methods, &options)?;
    let study = SensitivityStudy {
        parts: &parts,
        models: &models,
        time_limit,
        out: &out,
    };
    let mut first = Vec::new();
    let done = study.run(&mut |case| keep_first(&mut first, case))?;
    if done.is_complete()
        && let Some(picture) = pictures::of_sensitivity(&first)?
    {
        out.write(&picture.file_name, &picture.svg)?;
    }
    let axes = parts.first().map_or(&[][..], |part| part.points.axes());
    let varied = axes.iter().map(|axis| axis.name.as_str());
    let header: Vec<&str> = (["case"].into_iter().chain(varied))
        .chain([
            "method",
            "tilt [deg/a]",
            "6 deg at [a]",
            "linear [a]",
            "condition",
            "outcome",
        ])
        .collect();
    print_rows(&header, first.iter().map(printed));
    print_rest(done.rows, "sensitivity");
    Ok(out.account().verdict()?)
}

fn printed(of: &SensitivityCase) -> Vec<String> {
    let SensitivityCase { case, values, row } = of;
    let tilt = row.tilt1_per_a.abs().max(row.tilt2_per_a.abs());
    (std::iter::once(case.clone()).chain(values.iter().map(|value| written(*value))))
        .chain([
            row.method.to_string(),
            rounded(tilt, 2),
            rounded(row.offset_6deg, 4),
            rounded(row.linear_6deg, 4),
            rounded(row.condition, 2),
            row.outcome.clone(),
        ])
        .collect()
}
