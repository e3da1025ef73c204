//! `squirmers bottom-heavy`: bottom-heavy squirmers under gravity.

use clap::Arg;

use super::maps::METHODS;
use super::shared::{model_options, set_up, sweep_options};
use crate::arguments::{GeneralArguments, ModelArguments, RunArguments};
use crate::error::CommandError;
use crate::pictures;
use crate::terminal::print_rows;
use compare::Defaults;
use compare::numbers::{rounded, written};
use compare::study::panels::{PanelCase, PanelRun, Panels};

/// The argument `--time-limit` of this command. The command keeps no finished runs, because its picture needs whole
/// runs.
pub(crate) fn time_limit(arg: Arg) -> Arg {
    arg.help(
        "Begin no further run after this time; runs that are left out are reported (exit status 75), and the same command \
         starts from the beginning",
    )
}

pub(super) fn run(
    models: &ModelArguments,
    runs: &RunArguments,
    general: &GeneralArguments,
) -> Result<(), CommandError> {
    let (methods, options) = model_options(models, &METHODS, general)?;
    let sweep = sweep_options(runs, &methods)?;
    let panels = Defaults::paper()?.bottom_heavy;
    let out = general.output()?;
    let options = options.for_scenes(panels.iter().map(PanelCase::scene))?;
    let models = set_up(&methods, &options)?;
    let models: Vec<_> = models.iter().collect();
    let Panels { runs, .. } = Panels::run("bottom-heavy", &models, &panels, &sweep, &out)?;
    if !out.account().stopped()
        && let Some(picture) = pictures::of_bottom_heavy(&runs)?
    {
        out.write(&picture.file_name, &picture.svg)?;
    }
    print(&runs);
    Ok(out.account().verdict()?)
}

fn print(runs: &[PanelRun]) {
    let header = [
        "panel",
        "method",
        "beta",
        "g",
        "delta",
        "sigma",
        "outcome",
        "min gap [a]",
        "depth over alone",
    ];
    print_rows(
        &header,
        runs.iter().map(|run| {
            let row = run.summary();
            vec![
                row.panel,
                row.method.to_string(),
                written(row.beta),
                written(row.g),
                written(row.delta),
                written(row.sigma),
                row.outcome,
                rounded(row.min_gap, 5),
                rounded(row.depth_ratio, 3),
            ]
        }),
    );
}
