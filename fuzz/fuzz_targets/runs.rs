//! Any scene under lubrication theory runs to an outcome with finite numbers in the steps that it was given, or is refused in one line.

#![no_main]

use arbitrary::Arbitrary;
use fuzz::{Number, finite, one_line};
use libfuzzer_sys::fuzz_target;
use lt::{Form, Lubrication, UnlikeLubrication};
use scene::nalgebra::Vector3;
use scene::{
    Gravity, Orientation, Plan, Pose, Repulsion, Run, RunOptions, Sample, Scene, SceneError,
    Squirmer, run_plan,
};

/// Steps of a run: each costs some microseconds.
const MOST_STEPS: usize = 2000;

#[derive(Arbitrary, Debug)]
struct Body {
    modes: Vec<Number>,
    swirl: Vec<Number>,
    radius: Option<Number>,
    heavy: Option<Number>,
    position: [Number; 3],
    planar: bool,
    orientation: [Number; 3],
}

#[derive(Arbitrary, Debug)]
struct Input {
    bodies: [Body; 2],
    /// Whether the second is the first one's image, turned by half a turn: the symmetric equations of motion.
    symmetric: bool,
    repulsion: Option<[Number; 2]>,
    gravity: Option<[Number; 3]>,
    tolerance: Option<Number>,
    end_time: Option<Number>,
    departure: Option<Number>,
    angles_at: Option<Number>,
    interval: Option<Number>,
    steps: u16,
}

impl Body {
    fn squirmer(&self) -> Result<Squirmer, SceneError> {
        let values = |numbers: &[Number]| -> Vec<f64> {
            numbers.iter().map(|number| number.value()).collect()
        };
        let mut squirmer = Squirmer::new(&values(&self.modes))?.with_swirl(&values(&self.swirl))?;
        if let Some(radius) = self.radius {
            squirmer = squirmer.with_radius(radius.value())?;
        }
        if let Some(heavy) = self.heavy {
            squirmer = squirmer.bottom_heavy(heavy.value())?;
        }
        Ok(squirmer)
    }

    fn pose(&self) -> Pose {
        let vector = |of: [Number; 3]| Vector3::from(of.map(Number::value));
        let [x, y, z] = self.position.map(Number::value);
        if self.planar {
            return Pose::planar(x, y, self.orientation[0].value());
        }
        Pose {
            position: Vector3::new(x, y, z),
            orientation: Orientation::Vector(vector(self.orientation)),
        }
    }
}

fn scene(input: &Input) -> Result<Scene, SceneError> {
    let [one, two] = &input.bodies;
    let first = (one.squirmer()?, one.pose());
    let second = if input.symmetric {
        let pose = Pose {
            position: -first.1.position,
            orientation: Orientation::Vector(-first.1.orientation.vector()?),
        };
        (first.0, pose)
    } else {
        (two.squirmer()?, two.pose())
    };
    let repulsion = input.repulsion.map(|of| of.map(Number::value));
    let repulsion = repulsion.map(|[kappa1, kappa2]| Repulsion::new(kappa1, kappa2));
    let gravity = (input.gravity).map(|of| Gravity::new(Vector3::from(of.map(Number::value))));
    let (squirmers, start) = ([first.0, second.0], [first.1, second.1]);
    Scene::new(
        squirmers,
        start,
        repulsion.transpose()?,
        gravity.transpose()?,
    )
}

fn options(input: &Input) -> RunOptions {
    let or = |number: Option<Number>, usual: f64| number.map_or(usual, Number::value);
    let end_time = or(input.end_time, 20.0);
    RunOptions {
        // Scene files and commands allow 1e-14 to 1e-2: with a looser one a run means nothing.
        tolerance: or(input.tolerance, 1e-4).min(1e-2),
        end_time,
        departure_distance: or(input.departure, 12.0),
        angles_at: or(input.angles_at, f64::INFINITY),
        // Up to 1e7 samples are allowed, which is documented: here no more than keep a case short.
        sample_interval: (input.interval.map(Number::value))
            .filter(|interval| end_time / interval < 1000.0),
        max_steps: usize::from(input.steps) % MOST_STEPS + 1,
    }
}

fn check(run: &Run, options: &RunOptions) {
    finite("end time", run.end_time);
    finite("contact time", run.contact_time);
    finite("unit drift", run.unit_drift);
    assert!(run.end_time <= options.end_time, "{}", run.end_time);
    assert!((0.0..=run.end_time).contains(&run.contact_time), "{run:?}");
    assert!(run.min_gap.is_finite() && run.min_gap >= 0.0, "{run:?}");
    assert!(!run.truncation_rad.is_nan());
    let steps = (run.counters.steps + run.counters.rejected) as usize;
    assert!(steps <= options.max_steps + 1, "{steps} steps");
    if run.has_outgoing_angles() {
        run.deflections_rad()
            .iter()
            .for_each(|angle| finite("deflection", *angle));
    }
    let mut before = f64::NEG_INFINITY;
    for Sample { t, configuration } in &run.samples {
        finite("time", *t);
        assert!(*t >= before, "{t} after {before}");
        before = *t;
        let numbers = format!("{configuration:?}");
        assert!(!numbers.contains("NaN"), "{numbers}");
    }
    let numbers = format!("{:?} {:?}", run.end, run.start);
    assert!(!numbers.contains("NaN"), "{numbers}");
}

fuzz_target!(|input: Input| {
    let scene = match scene(&input) {
        Ok(scene) => scene,
        Err(error) => return one_line(&error),
    };
    let plan = match Plan::new(&scene) {
        Ok(plan) => plan,
        Err(error) => return one_line(&error),
    };
    let options = options(&input);
    let run = if plan.has_unlike_radii() {
        UnlikeLubrication::new(Form::Corrected, scene.ratio())
            .and_then(|model| run_plan(&plan, &model, &options))
    } else {
        let (model, mut samples) = (Lubrication::new(Form::Published), Vec::new());
        let run = model.run(&plan, &options, &mut |sample| samples.push(*sample));
        run.map(|run| Run { samples, ..run })
    };
    match run {
        Ok(run) => check(&run, &options),
        Err(error) => one_line(&error),
    }
});
