//! What several commands check before they run.

use std::time::Duration;

use ::scene::{MAX_MODES, RunOptions, Squirmer};
use compare::numbers::Numbers;
use compare::scene_file::SAMPLE_INTERVAL;
use compare::sweep::{SweepOptions, checked_angles_at, checked_time_limit, checked_tolerance};
use compare::{Method, Model, ModelOptions};

use crate::arguments::{GeneralArguments, LimitArguments, ModelArguments, RunArguments};
use crate::error::CommandError;

/// The checked methods, or `default` if the user names none, and their options.
pub(super) fn model_options(
    arguments: &ModelArguments,
    default: &[Method],
    general: &GeneralArguments,
) -> Result<(Vec<Method>, ModelOptions), CommandError> {
    let methods = (arguments.method.as_ref()).map_or(default.to_vec(), |m| m.0.clone());
    let mut options = ModelOptions {
        direct: arguments.direct,
        ..general.model_options()
    };
    if let Some(mesh) = arguments.mesh {
        if !methods.contains(&Method::Bem) {
            let allowed = "no method uses boundary elements: leave this option out, or name bem with --method";
            return Err(CommandError::input("--mesh", mesh, allowed));
        }
        options.mesh = mesh;
    }
    Ok((methods, options))
}

pub(super) fn set_up(
    methods: &[Method],
    options: &ModelOptions,
) -> Result<Vec<Model>, CommandError> {
    (methods.iter())
        .map(|&method| Ok(Model::set_up(method, options)?))
        .collect()
}

/// The numbers of an option, or `default` if the user gives none.
pub(super) fn list(given: &Option<Numbers>, default: &[f64]) -> Vec<f64> {
    (given.as_ref()).map_or(default.to_vec(), |list| list.0.clone())
}

/// Ratios of radii, if they are allowed.
pub(super) fn checked_ratios(ratios: Vec<f64>) -> Result<Vec<f64>, CommandError> {
    for ratio in &ratios {
        // The radius of the second sphere, that of the first being 1.
        let sphere = Squirmer::new(&[]).and_then(|sphere| sphere.with_radius(*ratio));
        sphere.map_err(|error| {
            CommandError::input("--ratio", format!("{ratio:?}"), error.to_string())
        })?;
    }
    Ok(ratios)
}

/// The distance at which angles are read, and the time limit, if they are allowed. All methods must have loads there.
pub(super) fn checked_limits(
    limits: &LimitArguments,
    methods: &[Method],
) -> Result<(f64, Option<Duration>), CommandError> {
    let angles_at = checked_angles_at(limits.departure, methods)?;
    Ok((angles_at, checked_time_limit(limits.time_limit)?))
}

pub(super) fn sweep_options(
    runs: &RunArguments,
    methods: &[Method],
) -> Result<SweepOptions, CommandError> {
    let tolerance = checked_tolerance(runs.tol)?;
    let (angles_at, time_limit) = checked_limits(&runs.limits, methods)?;
    Ok(SweepOptions {
        run: RunOptions {
            tolerance,
            angles_at,
            sample_interval: Some(SAMPLE_INTERVAL),
            ..RunOptions::default()
        },
        time_limit,
    })
}

/// The highest slip mode, if it is allowed.
pub(super) fn highest(what: &'static str, modes: usize) -> Result<usize, CommandError> {
    if modes > MAX_MODES {
        let allowed = format!("modes go from 0 (none) to {MAX_MODES}");
        return Err(CommandError::input(what, modes, allowed));
    }
    Ok(modes)
}
