//! Bottom-heavy pairs that swing for ever: how steady their period is up to t = 10,000.
//!
//! Near a limit cycle, errors across the cycle decay, and errors along it add up as shifts of time. A passage is the
//! moment at which a phase, such as `ln eps`, rises through the middle of its range. One step may change the variables
//! `y_i` by `e_i`, with `Σ (e_i/(1 + |y_i|))² <= N tolerance²`. That shifts the times of all later passages by at most
//! `sqrt(N) tolerance A`, with `A² = Σ ((1 + |y_i|) dt/dy_i)²`. `A` is measured by displacing states of the cycle.
//!
//! Steps that the motion itself limits have errors far below the tolerance, so that this sum of the worst is far too large. But whatever
//! limits them, the errors of steps that are chosen by the tolerance go as the tolerance: what coarser runs are off by says more.

use std::f64::consts::{PI, TAU};

use nalgebra::Vector3;
use rayon::prelude::*;
use scene::{
    Configuration, Gravity, Orientation, Plan, Pose, Repulsion, Run, RunOptions, Scene, Squirmer,
};

use super::long_runs::{TIME, TOLERANCE, UNIT_DRIFT, unit_drift};
use super::rows::larger;
use super::{Bench, Rows, until};
use crate::study::maps::Pair;
use crate::{CompareError, Method, Model};

/// Time after which a pair is on its limit cycle, and for how long the cycle is then recorded.
const SETTLED: f64 = 2_000.0;
const WATCHED: f64 = 500.0;

/// The tolerance of the run that the other one is compared with.
const TIGHT: f64 = 1e-12;

/// Tolerances of the runs that say how errors go with the tolerance.
const COARSE: [f64; 3] = [1e-6, 1e-7, 1e-8];

/// A coarser run may be right by chance, hardly all three.
const CHANCE: f64 = 3.0;

/// Time between samples. A cubic through four of them gives the time of a passage with an error of about the fourth
/// power of it.
const INTERVAL: f64 = 0.02;
const READING: f64 = INTERVAL * INTERVAL * INTERVAL * INTERVAL;

/// How many states of the cycle are displaced, by how much, and how long the shift of the passages is then followed: for
/// so many periods, and for at least so long a time. (If a shift grew further after that, the bounds would only be
/// tighter than they need to be.)
const STATES: usize = 8;
const DISPLACED: f64 = 1e-5;
const PERIODS: f64 = 4.0;
const FOLLOWED: f64 = 200.0;

/// Fewer passages do not give a period.
const LEAST_PASSAGES: usize = 10;

/// Variables of motion in a plane.
const VARIABLES: f64 = 6.0;

/// A pair that swings.
struct Swing {
    what: &'static str,
    methods: &'static [Method],
    pair: Pair,
    start: (f64, f64),
    /// The phase: it rises through the middle of its range once a period.
    phase: fn(&Configuration) -> f64,
    /// Whether the two are mirror images.
    mirrored: bool,
}

const SWINGS: [Swing; 3] = [
    Swing {
        what: "mirror images that part and meet (beta -1, G 3)",
        methods: &[Method::Exact, Method::Bem],
        pair: bottom_heavy(-1.0, 3.0),
        start: (0.5, 1.0),
        phase: |c| c.gap.ln(),
        mirrored: true,
    },
    Swing {
        what: "a pair that swings to and fro (beta 5, G 3)",
        methods: &[Method::Exact],
        pair: bottom_heavy(5.0, 3.0),
        start: (0.5, 0.5),
        phase: |c| c.line_angle_rad,
        mirrored: false,
    },
    Swing {
        what: "an orbit whose gap swings (beta -5, G 1)",
        methods: &[Method::Lt, Method::LtCorrected],
        pair: bottom_heavy(-5.0, 1.0),
        start: (1.2, 1.3),
        phase: |c| c.line_angle_rad.sin(),
        mirrored: false,
    },
];

const fn bottom_heavy(beta: f64, g: f64) -> Pair {
    Pair { beta, g, dz: 0.0 }
}

pub(super) fn cases(bench: &Bench, rows: &mut Rows) {
    for swing in &SWINGS {
        for model in bench.only(swing.methods) {
            rows.attempt(model.method().name(), swing.what, |rows| {
                swing.rows(model, rows)
            });
        }
    }
}

/// Times at which the phase rises through the middle of its range, and the run itself.
struct Passages {
    times: Vec<f64>,
    /// Largest deviation from mirror symmetry.
    crooked: f64,
    run: Run,
}

/// A limit cycle: the middle of the phase's range, the period, and the states of one period, beginning at a passage.
struct Cycle {
    level: f64,
    period: f64,
    states: Vec<Configuration>,
}

impl Swing {
    fn rows(&self, model: &Model, rows: &mut Rows) -> Result<(), CompareError> {
        let name = model.method().name();
        let Some(cycle) = self.cycle(model)? else {
            let why = (0.0, "it swings for ever");
            rows.add(name, format!("{}: periods", self.what), why, f64::NAN);
            return Ok(());
        };
        let scene = self.scene(&cycle.states[0], [0.0; 4])?;
        let found = self.passages(model, &scene, &cycle, TIME, TOLERANCE)?;
        let truth = self.passages(model, &scene, &cycle, TIME, TIGHT)?;
        let coarse = COARSE.map(|tolerance| self.passages(model, &scene, &cycle, TIME, tolerance));
        let [first, second, third] = coarse;
        let coarse = [first?, second?, third?];
        let runs = [&found, &truth].into_iter().chain(&coarse);
        let count = runs.map(|of| of.times.len()).min().unwrap_or(0);
        if count < LEAST_PASSAGES {
            return Err(CompareError::input(
                "passages",
                count,
                "too few to give a period",
            ));
        }
        let answer = self.answer(model, &cycle, found.run.end.line_angle_rad)?;
        let period = (truth.times[count - 1] - truth.times[0]) / (count - 1) as f64;
        let of = |what: &str| format!("{}, period {period:.4}: {what}", self.what);
        let last = |of: &Passages| of.times[count - 1];
        let per_tolerance = (coarse.iter().zip(COARSE))
            .map(|(of, tolerance)| (last(of) - last(&truth)).abs() / tolerance)
            .fold(0.0, larger);
        // Where pieces of a table fit together less well than the finest of these tolerances, finer runs see what these do not.
        let smooth = model
            .table()
            .is_none_or(|of| of.interpolation_error <= COARSE[2]);
        // Roundings are as likely up as down.
        let rounding = |run: &Run| (run.counters.steps as f64).sqrt() * f64::EPSILON * answer;
        let shift = |run: &Run, tolerance: f64| {
            let steps = (run.counters.steps + 1) as f64;
            let worst = steps * VARIABLES.sqrt() * tolerance * answer;
            let proportional = CHANCE * per_tolerance * tolerance + rounding(run);
            if smooth {
                worst.min(proportional)
            } else {
                worst
            }
        };
        let of_both = shift(&found.run, TOLERANCE) + shift(&truth.run, TIGHT);
        let why = if smooth {
            "3 x the largest shift at tolerances of 1e-6, 1e-7 and 1e-8, in proportion to the tolerance, and rounding in each step"
        } else {
            "sqrt(6) tolerance in each step of both runs, times the largest shift per displacement: pieces of the table fit together less well than 1e-8, which coarser runs do not see"
        };
        rows.add(
            name,
            of(&format!(
                "time of passage {count}, before t = 10,000: tolerance 1e-10 compared with 1e-12"
            )),
            (of_both, why),
            (last(&found) - last(&truth)).abs(),
        );
        let half = (count - 1) / 2;
        let mean = |from: usize| (found.times[from + half] - found.times[from]) / half as f64;
        let why = "shifts of three passages by as much as the last one, and the fourth power of the time between samples for the reading of each, divided by the periods of a half";
        rows.add(
            name,
            of("difference of the mean periods of the first and the second half of t = 10,000"),
            (
                3.0 * (shift(&found.run, TOLERANCE) + READING) / half as f64,
                why,
            ),
            (mean(half) - mean(0)).abs(),
        );
        let spatial = self.in_space(model, &scene)?;
        rows.add(
            name,
            of("largest ||p| - 1| in three dimensions"),
            (unit_drift(&spatial), UNIT_DRIFT),
            spatial.unit_drift,
        );
        if self.mirrored {
            let why = (0.0, "the force balance uses sums and differences only");
            rows.add(
                name,
                of("deviation from mirror symmetry up to t = 10,000"),
                (4.0 * f64::EPSILON, "rounding of pi"),
                found.crooked,
            );
            let [p, q] = spatial.end.orientations;
            let off = (p.x + q.x).abs() + (p.y - q.y).abs() + p.z.abs() + q.z.abs();
            rows.add(
                name,
                of("deviation from mirror symmetry at t = 10,000 in three dimensions"),
                why,
                off + spatial.end.midpoint.x.abs() + spatial.end.line.y.abs(),
            );
        }
        Ok(())
    }

    /// The limit cycle that the pair has reached; none if there is none.
    fn cycle(&self, model: &Model) -> Result<Option<Cycle>, CompareError> {
        let scene = self.pair.scene(self.start.0, self.start.1)?;
        let options = RunOptions {
            sample_interval: Some(INTERVAL),
            ..until(SETTLED + WATCHED, TIGHT)
        };
        let mut seen = Vec::new();
        let plan = Plan::new(&scene)?.without_symmetry();
        model.run_observed(&plan, &options, &mut |sample| {
            if sample.t >= SETTLED {
                seen.push(sample.configuration);
            }
        })?;
        let phases = seen.iter().map(|c| (self.phase)(c));
        let least = phases.clone().fold(f64::INFINITY, f64::min);
        let level = f64::midpoint(least, phases.fold(f64::NEG_INFINITY, f64::max));
        let rises = |pair: &[Configuration]| {
            (self.phase)(&pair[0]) < level && (self.phase)(&pair[1]) >= level
        };
        let passed: Vec<_> = (seen.windows(2).enumerate())
            .filter(|(_, pair)| rises(pair))
            .map(|(k, _)| k)
            .collect();
        let [.., from, to] = passed[..] else {
            return Ok(None);
        };
        Ok(Some(Cycle {
            level,
            period: (to - from) as f64 * INTERVAL,
            states: seen[from..to].to_vec(),
        }))
    }

    /// The scene that starts at a configuration, displaced in four variables: `ln eps`, the angle of the line of centres,
    /// and the angles of both squirmers to that line.
    fn scene(
        &self,
        c: &Configuration,
        [ln_gap, line, one, two]: [f64; 4],
    ) -> Result<Scene, CompareError> {
        let half = 1.0 + 0.5 * (c.gap.ln() + ln_gap).exp();
        let at = c.line.y.atan2(c.line.x) + line;
        let relative = |angle: f64| {
            let off = angle - c.line_angle_rad;
            off - TAU * (off / TAU).round()
        };
        let second = at + PI + relative(c.angles_rad[1] - PI) + two;
        let first = if self.mirrored {
            // The image of the second, to the last bit.
            -(second - PI)
        } else {
            at + relative(c.angles_rad[0]) + one
        };
        let along = Vector3::new(at.cos(), at.sin(), 0.0) * half;
        let pose = |position: Vector3<f64>, angle: f64| Pose {
            position,
            orientation: Orientation::Radians(angle),
        };
        let squirmer = Squirmer::with_beta(1.0, self.pair.beta)?.bottom_heavy(self.pair.g)?;
        Ok(Scene::new(
            [squirmer; 2],
            [pose(-along, first), pose(along, second)],
            Some(Repulsion::PAPER),
            Some(Gravity::DOWN),
        )?)
    }

    fn passages(
        &self,
        model: &Model,
        scene: &Scene,
        cycle: &Cycle,
        time: f64,
        tolerance: f64,
    ) -> Result<Passages, CompareError> {
        let plan = Plan::new(scene)?.without_symmetry();
        let options = RunOptions {
            sample_interval: Some(INTERVAL),
            ..until(time, tolerance)
        };
        let (mut times, mut crooked) = (Vec::new(), 0.0_f64);
        let mut last = [(0.0, f64::NAN); 4];
        let run = model.run_observed(&plan, &options, &mut |sample| {
            let c = &sample.configuration;
            last.rotate_left(1);
            last[3] = (sample.t, (self.phase)(c) - cycle.level);
            if last[1].1 < 0.0 && last[2].1 >= 0.0 && last[0].1.is_finite() {
                times.push(last[1].0 + INTERVAL * zero(last.map(|(_, value)| value)));
            }
            let line = c.line_angle_rad.abs() + c.midpoint.x.abs();
            crooked = larger(
                crooked,
                (c.angles_rad[0] + c.angles_rad[1] - PI).abs() + line,
            );
        })?;
        Ok(Passages {
            times,
            crooked,
            run,
        })
    }

    /// `A`: the largest shift of the passages, divided by the displacement of the state that causes it. The displacement
    /// is measured as the tolerance measures it. The largest value of all states of the cycle.
    fn answer(
        &self,
        model: &Model,
        cycle: &Cycle,
        line_angle_rad: f64,
    ) -> Result<f64, CompareError> {
        let time = (PERIODS * cycle.period).max(FOLLOWED);
        // The line between mirror images does not turn, and a displacement of the second one displaces the first too.
        let variables: &[usize] = if self.mirrored {
            &[0, 3]
        } else {
            &[0, 1, 2, 3]
        };
        let of = |k: usize| -> Result<f64, CompareError> {
            let at = &cycle.states[(2 * k + 1) * cycle.states.len() / (2 * STATES)];
            let passages = |moved: [f64; 4]| -> Result<Vec<f64>, CompareError> {
                let scene = self.scene(at, moved)?;
                Ok(self.passages(model, &scene, cycle, time, TIGHT)?.times)
            };
            let truth = passages([0.0; 4])?;
            let mut sum = 0.0;
            for &variable in variables {
                let mut moved = [0.0; 4];
                moved[variable] = DISPLACED;
                let shift = (passages(moved)?.iter().zip(&truth))
                    .map(|(a, b)| (a - b).abs() / DISPLACED)
                    .fold(0.0, larger);
                let size = [at.gap.ln(), line_angle_rad, PI, PI][variable];
                sum += ((1.0 + size.abs()) * shift).powi(2);
            }
            Ok(sum.sqrt())
        };
        let all = (0..STATES).into_par_iter().map(of);
        all.try_reduce(|| 0.0, |a, b| Ok(larger(a, b)))
    }

    /// The run to the end in three dimensions. If the squirmers are mirror images, so are the vectors at the start, to the
    /// last bit.
    fn in_space(&self, model: &Model, scene: &Scene) -> Result<Run, CompareError> {
        let mut start = scene.start;
        let [one, two] = [0, 1].map(|k| start[k].orientation.vector());
        let two = two?;
        let one = if self.mirrored {
            Vector3::new(-two.x, two.y, two.z)
        } else {
            one?
        };
        for (pose, p) in start.iter_mut().zip([one, two]) {
            pose.orientation = Orientation::Vector(p);
        }
        let scene = Scene::new(scene.squirmers, start, scene.repulsion, scene.gravity)?;
        let plan = Plan::new(&scene)?.in_three_dimensions();
        Ok(model.run_observed(&plan, &until(TIME, TOLERANCE), &mut |_| {})?)
    }
}

/// The zero in (0, 1) of the cubic with these values at -1, 0, 1 and 2. The second value is negative, the third is not.
fn zero([a, b, c, d]: [f64; 4]) -> f64 {
    let value = |s: f64| {
        let (l, m, r) = (s + 1.0, s - 1.0, s - 2.0);
        -a * s * m * r / 6.0 + b * l * m * r / 2.0 - c * l * s * r / 2.0 + d * l * s * m / 6.0
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = f64::midpoint(low, high);
        if value(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    f64::midpoint(low, high)
}
