//! What several commands check before they run.

use std::time::Duration;

use ::scene::{MAX_MODES, RunOptions, Squirmer};
use compare::numbers::{Numbers, written};
use compare::scene_file::SAMPLE_INTERVAL;
use compare::sweep::SweepOptions;
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

/// The tolerance, if it is allowed.
pub(super) fn checked_tolerance(tolerance: f64) -> Result<f64, CommandError> {
    if !(1e-14..=1e-2).contains(&tolerance) {
        let allowed = "give a number from 1e-14 to 1e-2";
        let value = format!("{tolerance:?}");
        return Err(CommandError::input("--tol", value, allowed));
    }
    Ok(tolerance)
}

/// The distance at which angles are read, and the time limit, if they are allowed. All methods must have loads there.
pub(super) fn checked_limits(
    limits: &LimitArguments,
    methods: &[Method],
) -> Result<(f64, Option<Duration>), CommandError> {
    let angles_at = limits.departure;
    for method in methods {
        let farthest = 2.0 + method.largest_gap();
        if angles_at > farthest {
            let allowed = format!(
                "{method} has no loads at larger gaps: give a distance of the centres up to {}",
                written(farthest)
            );
            return Err(CommandError::input("--departure", angles_at, allowed));
        }
    }
    if angles_at.is_nan() || angles_at <= 2.0 {
        let allowed = "give a distance of the centres greater than 2 (radii), or inf";
        let value = format!("{angles_at:?}");
        return Err(CommandError::input("--departure", value, allowed));
    }
    Ok((angles_at, checked_time_limit(limits.time_limit)?))
}

/// The time limit, if it is allowed.
pub(super) fn checked_time_limit(seconds: Option<f64>) -> Result<Option<Duration>, CommandError> {
    let limit = seconds.map(|seconds| {
        let allowed = "give a number of seconds, 0 or more";
        Duration::try_from_secs_f64(seconds)
            .map_err(|_| CommandError::input("--time-limit", seconds, allowed))
    });
    limit.transpose()
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
