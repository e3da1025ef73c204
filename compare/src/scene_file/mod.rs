//! Scene files: two squirmers, the effects that act on them, and how to run them, as TOML.
//!
//! `docs/SCENES.md` lists every key. Files are read here and not in `scene` because they name the
//! hydrodynamic models, which `scene` does not know.

mod effects;
mod mistakes;
mod squirmers;
mod table;

use scene::{Plan, Repulsion, RunOptions, Scene};
use toml::de::DeTable;

pub use mistakes::{Mistake, Mistakes};

use self::mistakes::Notes;
use self::table::Table;
use crate::{Method, ModelOptions};

/// Time between samples unless the file says otherwise, in `a/V_s`.
pub const SAMPLE_INTERVAL: f64 = 0.05;

/// Longest run, in `a/V_s`.
const LONGEST: f64 = 1e6;

/// Most samples and most steps of a run.
const MOST_SAMPLES: f64 = 1e6;
const MOST_STEPS: usize = 100_000_000;

/// Force of repulsion, per `pi mu a`, that free flight beyond the cut of lubrication theory may leave out.
const NEGLIGIBLE_FORCE: f64 = 1e-12;

/// What a scene file says.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneFile {
    /// Squirmers, start, repulsion and gravity.
    pub scene: Scene,
    /// The hydrodynamic method.
    pub method: Method,
    /// Refinement level of boundary elements, if they run.
    pub mesh: usize,
    /// Whether every load is solved for, instead of read from a table.
    pub direct: bool,
    /// End, stop rules, tolerance and samples.
    pub run: RunOptions,
}

impl SceneFile {
    /// Reads the text of a scene file.
    ///
    /// # Errors
    /// Every mistake in it.
    ///
    /// ```
    /// let mistakes = compare::SceneFile::parse("hydrodinamics = 1").unwrap_err();
    /// let told: Vec<String> = mistakes.0.iter().map(ToString::to_string).collect();
    /// let of_key = told.iter().find(|line| line.starts_with("1:1: hydrodinamics:")).unwrap();
    /// assert!(of_key.ends_with("did you mean 'hydrodynamics'?"));
    /// // What is missing is told too.
    /// assert!(told.len() > 1);
    /// ```
    pub fn parse(text: &str) -> Result<Self, Mistakes> {
        let mut notes = Notes::new(text);
        let (table, errors) = DeTable::parse_recoverable(text);
        for error in &errors {
            let span = error.span().unwrap_or(0..0);
            let found = notes.quote_on(span.clone());
            let reason = error.message().replace('\n', "; ");
            if !notes.note_decimal_comma(span.clone()) {
                notes.note(span, "", found, format!("not TOML: {reason}"));
            }
        }
        let mut file = Table::new("", 0..0, table.get_ref());
        let squirmers = squirmers::read(&mut file, &mut notes);
        let hydrodynamics = effects::hydrodynamics(&mut file, &mut notes);
        let repulsion = effects::repulsion(&mut file, &mut notes);
        let gravity = effects::gravity(&mut file, &mut notes);
        let run = run_options(&mut file, &mut notes);
        let (Some(squirmers), Some(hydrodynamics), Some(repulsion), Some(gravity), Some(run)) =
            (squirmers, hydrodynamics, repulsion, gravity, run)
        else {
            file.finish(&mut notes);
            return Err(notes.into_mistakes());
        };
        file.finish(&mut notes);
        if let Some((repulsion, span)) = &repulsion {
            check_reach(*repulsion, hydrodynamics.method, span.clone(), &mut notes);
        }
        let repulsion = repulsion.map(|(repulsion, _)| repulsion);
        let bodies = squirmers.bodies;
        let scene = Scene::new(bodies, squirmers.start, repulsion, gravity)
            .map_err(|error| error.to_string())
            .and_then(|scene| check_start(&scene, hydrodynamics).map(|()| scene));
        match scene {
            Ok(scene) if notes.is_empty() => Ok(Self {
                scene,
                method: hydrodynamics.method,
                mesh: hydrodynamics.mesh,
                direct: hydrodynamics.direct,
                run,
            }),
            Ok(_) => Err(notes.into_mistakes()),
            Err(reason) => {
                // What is left to be wrong are the positions: the spheres overlap, or are too near for the model or
                // too far apart.
                notes.wrong(squirmers.second, "squirmer[1].position", reason);
                Err(notes.into_mistakes())
            }
        }
    }

    /// How to set up its model for `plan`, with a table of the loads that it reads, kept as in `options`.
    #[must_use]
    pub fn model_options(&self, plan: &Plan, options: ModelOptions) -> ModelOptions {
        ModelOptions {
            mesh: self.mesh,
            direct: self.direct,
            tabulated: plan.load_set(),
            ..options
        }
    }
}

/// Refuses a start at which the model of the scene has no answer.
fn check_start(scene: &Scene, hydrodynamics: effects::Hydrodynamics) -> Result<(), String> {
    let plan = Plan::new(scene).map_err(|error| error.to_string())?;
    (hydrodynamics.method)
        .check_gap(hydrodynamics.mesh, plan.start().gap)
        .map_err(|error| format!("the start is too near: {error}"))
}

/// Lubrication theory flies freely beyond its cut: repulsion must have died out there.
fn check_reach(
    repulsion: Repulsion,
    method: Method,
    span: std::ops::Range<usize>,
    notes: &mut Notes<'_>,
) {
    let cut = scene::Gap::from_ln(lt::CUTOFF.ln());
    let lubrication = matches!(method, Method::Lt | Method::LtCorrected);
    if lubrication && repulsion.force(cut) > NEGLIGIBLE_FORCE {
        let allowed = format!(
            "lubrication theory ends at a gap of {}: choose kappa2 so large that the repulsion has died out there, \
             or other hydrodynamics",
            lt::CUTOFF
        );
        notes.wrong(span, "repulsion", allowed);
    }
}

/// `[run]` and `[output]`.
fn run_options(file: &mut Table<'_, '_>, notes: &mut Notes<'_>) -> Option<RunOptions> {
    let mut options = RunOptions {
        sample_interval: Some(SAMPLE_INTERVAL),
        ..RunOptions::default()
    };
    let before = notes.count();
    if let Some(mut run) = effects::table(file, "run", notes) {
        let end_time = format!("a time greater than 0, at most {LONGEST}");
        let set = |slot: &mut f64, value: Option<f64>| *slot = value.unwrap_or(*slot);
        set(
            &mut options.end_time,
            run.number("end_time", notes, &end_time, |t| t > 0.0 && t <= LONGEST),
        );
        let distance = "a distance of the centres greater than 2";
        set(
            &mut options.departure_distance,
            run.number("departure_distance", notes, distance, |r| r > 2.0),
        );
        set(
            &mut options.tolerance,
            run.number("tolerance", notes, "a number from 1e-14 to 1e-2", |tol| {
                (1e-14..=1e-2).contains(&tol)
            }),
        );
        if let Some(steps) = run.whole("max_steps", notes, 1..=MOST_STEPS) {
            options.max_steps = steps;
        }
        run.finish(notes);
    }
    let least = options.end_time / MOST_SAMPLES;
    options.sample_interval = Some(SAMPLE_INTERVAL.max(least));
    if let Some(mut output) = effects::table(file, "output", notes) {
        let allowed = format!("a time of at least {least}, a millionth of the end time");
        let interval = output.number("sample_interval", notes, &allowed, |t| {
            t > 0.0 && t >= least
        });
        options.sample_interval = interval.or(options.sample_interval);
        output.finish(notes);
    }
    (notes.count() == before).then_some(options)
}

#[cfg(test)]
mod tests;
