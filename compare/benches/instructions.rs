//! Instructions of one right-hand side, counted by valgrind's callgrind: what each effect costs, and that
//! an absent one costs nothing.
//!
//! `cargo bench -p squirmers-compare --bench instructions` prints a table as CSV and fails if a right-hand side takes
//! more than 2 % more instructions than the same arithmetic written without the absent effects. It needs
//! `valgrind`; counts do not depend on what else the machine does, but on the compiler.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the bench")]

use std::f64::consts::PI;
use std::hint::black_box;
use std::process::{Command, ExitCode};

use compare::effects::{EFFECT_CASES, EffectCase};
use compare::{Method, Model, ModelOptions};
use lt::{Form, Lubrication};
use scene::elementary::{sin_cos, sines_cosines};
use scene::mobility::{MobilitySet, ModeMobility, PairMobility, Transverse};
use scene::{Gap, Hydrodynamics, LoadSet, Plan, Repulsion, SceneError, Squirmer, State, legendre};

/// Right-hand sides in the shorter and the longer of two runs, whose difference is free of set-up.
const TIMES: [usize; 2] = [1_000, 3_000];

/// Most that an absent effect may cost, relative to the arithmetic without it.
const ALLOWED: f64 = 0.02;

/// Evaluates the right-hand side as the plan has it.
fn planned(case: &EffectCase, times: usize) {
    let plan = Plan::new(&case.scene().unwrap()).unwrap();
    let model = Model::set_up(case.method, &ModelOptions::default()).unwrap();
    black_box(model.rates(&plan, plan.start(), times).unwrap());
}

/// Evaluates the same arithmetic, written without the absent effects; lubrication theory in the plane
/// and in three dimensions.
fn by_hand(case: &EffectCase, times: usize) {
    let plan = Plan::new(&case.scene().unwrap()).unwrap();
    // Known when it runs only, as to the plan.
    let mut given = black_box(arithmetic::Given {
        model: Lubrication::new(Form::Published),
        squirmers: plan.scene().squirmers,
        set: plan.load_set(),
        repulsion: Repulsion::PAPER,
        loads: 0,
        failure: None,
    });
    let start = plan.start();
    let [d1, d2] = [
        start.angles_rad[0] - start.line_angle_rad,
        start.angles_rad[1] - start.line_angle_rad - PI,
    ];
    let planar = [0.0, 0.0, start.line_angle_rad, start.gap.ln(), d1, d2];
    let mut spatial = [0.0; 13];
    for (at, v) in [
        (3, start.line),
        (7, start.orientations[0]),
        (10, start.orientations[1]),
    ] {
        spatial[at..at + 3].copy_from_slice(v.as_slice());
    }
    spatial[6] = start.gap.ln();
    match (case.state, case.repulsion) {
        (State::Planar, false) => repeat(times, &planar, |y| {
            arithmetic::planar::<false>(y, &mut given)
        }),
        (State::Planar, true) => repeat(times, &planar, |y| {
            arithmetic::planar::<true>(y, &mut given)
        }),
        (_, false) => repeat(times, &spatial, |y| {
            arithmetic::spatial::<false>(y, &mut given)
        }),
        (_, true) => repeat(times, &spatial, |y| {
            arithmetic::spatial::<true>(y, &mut given)
        }),
    }
}

/// Whether [`by_hand`] knows it.
fn has_yardstick(case: &EffectCase) -> bool {
    matches!(case.state, State::Planar | State::Spatial)
        && !case.gravity
        && !case.swirl
        && case.modes == 2
        && case.method == Method::Lt
}

/// The loop of [`scene::rates`].
fn repeat<const N: usize>(times: usize, y: &[f64; N], mut rhs: impl FnMut(&[f64; N]) -> [f64; N]) {
    let mut dy = rhs(y);
    for _ in 1..times {
        dy = black_box(rhs(black_box(y)));
    }
    black_box(dy);
}

/// The equations of `scene::mobility` and of the planar and the spatial coordinates, written once more
/// without gravity and swirl, and without repulsion where there is none.
mod arithmetic {
    use super::*;
    use nalgebra::Vector3;

    /// What a scene gives, and what every run keeps: how many loads were asked for, and what the model refused.
    pub struct Given {
        pub model: Lubrication,
        pub squirmers: [Squirmer; 2],
        pub set: LoadSet,
        pub repulsion: Repulsion,
        pub loads: u64,
        pub failure: Option<SceneError>,
    }

    struct Velocity<T> {
        opening: f64,
        axial: f64,
        across: T,
        turning: T,
        spin: [T; 2],
    }

    #[inline(always)]
    fn velocity<T: Transverse>(
        (pair, modes): (&PairMobility, &[ModeMobility]),
        squirmers: &[Squirmer; 2],
        repulsion: Option<f64>,
        cosines: [f64; 2],
        transverse: [T; 2],
    ) -> Velocity<T> {
        let mut opening = repulsion.map_or(0.0, |force| force * pair.repulsion);
        let mut axial = 0.0;
        let mut sums: Option<[T; 4]> = None;
        let [v1, v2] = transverse;
        let orders = legendre(cosines[0]).zip(legendre(cosines[1]));
        for ((n, mode), (p1, p2)) in modes.iter().enumerate().zip(orders) {
            let [b1, b2] = [squirmers[0].mode(n), squirmers[1].mode(n)];
            let (q1, q2) = (b1 * p1.p, b2 * p2.p);
            opening += (q1 + q2) * mode.opening;
            axial += (q1 - q2) * mode.mean_axial;
            let (s1, s2) = (v1 * (b1 * p1.w), v2 * (b2 * p2.w));
            let (sum, difference) = (s1 + s2, s1 - s2);
            let more = [
                sum * mode.across.mean_transverse,
                sum * mode.across.counter_spin,
                difference * mode.across.turning,
                difference * mode.across.mean_spin,
            ];
            sums = Some(match sums {
                None => more,
                Some(sums) => [0, 1, 2, 3].map(|k| sums[k] + more[k]),
            });
        }
        let [across, counter, turning, mean] = sums.unwrap_or([v1 * 0.0; 4]);
        Velocity {
            opening,
            axial,
            across,
            turning,
            spin: [mean + counter, mean - counter],
        }
    }

    /// As the stepper calls them: functions of their own, to which two modes are known.
    macro_rules! with_two_modes_known {
        ($name:ident, $of:ident, $n:literal) => {
            #[inline(never)]
            pub fn $name<const REPULSION: bool>(y: &[f64; $n], given: &mut Given) -> [f64; $n] {
                let set = LoadSet::planar(given.set.modes);
                match set.modes {
                    2 => $of::<REPULSION, 2>(y, given, LoadSet { modes: 2, ..set }),
                    _ => $of::<REPULSION, 8>(y, given, set),
                }
            }
        };
    }
    with_two_modes_known!(planar, planar_of, 6);
    with_two_modes_known!(spatial, spatial_of, 13);

    #[cold]
    #[inline(never)]
    fn refused<const N: usize>(error: SceneError, failure: &mut Option<SceneError>) -> [f64; N] {
        *failure = Some(error);
        [f64::NAN; N]
    }

    #[inline(always)]
    fn planar_of<const REPULSION: bool, const M: usize>(
        y: &[f64; 6],
        given: &mut Given,
        set: LoadSet,
    ) -> [f64; 6] {
        let [(s1, c1), (s2, c2)] = sines_cosines([y[4], y[5]]);
        let gap = Gap::from_ln(y[3]);
        given.loads += 1;
        let repulsion = REPULSION.then(|| given.repulsion.force(gap));
        let (mut pair, mut modes) = (PairMobility::default(), [ModeMobility::default(); M]);
        let read = MobilitySet {
            loads: set,
            torque: false,
        };
        if let Err(error) = given
            .model
            .interacting_mobility(gap, read, (&mut pair, &mut modes))
        {
            return refused(error, &mut given.failure);
        }
        let v = velocity(
            (&pair, &modes[..set.modes.min(M)]),
            &given.squirmers,
            repulsion,
            [c1, c2],
            [s1, -s2],
        );
        let (sin, cos) = sin_cos(y[2]);
        [
            v.axial * cos - v.across * sin,
            v.axial * sin + v.across * cos,
            v.turning,
            v.opening,
            v.spin[0] - v.turning,
            v.spin[1] - v.turning,
        ]
    }

    #[inline(always)]
    fn spatial_of<const REPULSION: bool, const M: usize>(
        y: &[f64; 13],
        given: &mut Given,
        set: LoadSet,
    ) -> [f64; 13] {
        let vector = |at: usize| Vector3::new(y[at], y[at + 1], y[at + 2]);
        let line = vector(3);
        let length = line.norm();
        let d = line / length;
        let [(c1, v1), (c2, v2)] = [7, 10].map(|at| {
            let p = vector(at).normalize();
            let along = p.dot(&d);
            (along, p - d * along)
        });
        let gap = Gap::from_ln(y[6]);
        given.loads += 1;
        let repulsion = REPULSION.then(|| given.repulsion.force(gap));
        let (mut pair, mut modes) = (PairMobility::default(), [ModeMobility::default(); M]);
        let read = MobilitySet {
            loads: set,
            torque: false,
        };
        if let Err(error) = given
            .model
            .interacting_mobility(gap, read, (&mut pair, &mut modes))
        {
            return refused(error, &mut given.failure);
        }
        let v = velocity(
            (&pair, &modes[..set.modes.min(M)]),
            &given.squirmers,
            repulsion,
            [c1, -c2],
            [v1, v2],
        );
        let mut dy = [0.0; 13];
        let mut store = |at: usize, w: Vector3<f64>| dy[at..at + 3].copy_from_slice(w.as_slice());
        store(0, d * v.axial + v.across);
        store(3, v.turning * length);
        store(7, d.cross(&v.spin[0]).cross(&vector(7)));
        store(10, d.cross(&v.spin[1]).cross(&vector(10)));
        dy[6] = v.opening;
        dy
    }
}

/// Instructions of a right-hand side, counted in processes of their own.
fn counted(index: usize, by_hand: bool) -> f64 {
    let of = |times: usize| {
        let output = Command::new("valgrind")
            .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
            .arg(std::env::current_exe().unwrap())
            .args([index.to_string(), by_hand.to_string(), times.to_string()])
            .output()
            .expect("valgrind is needed to count instructions");
        assert!(output.status.success(), "case {index} failed");
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        let collected = told.lines().find_map(|line| line.split_once("Collected :"));
        let (_, count) = collected.unwrap_or_else(|| panic!("valgrind did not count: {told}"));
        count.trim().parse::<f64>().unwrap()
    };
    (of(TIMES[1]) - of(TIMES[0])) / (TIMES[1] - TIMES[0]) as f64
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let [index, yardstick, times] = &arguments[..] {
        let case = &EFFECT_CASES[index.parse::<usize>().unwrap()];
        let times = times.parse().unwrap();
        if yardstick == "true" {
            by_hand(case, times);
        } else {
            planned(case, times);
        }
        return ExitCode::SUCCESS;
    }
    println!(
        "state,model,squirming_modes,repulsion,gravity,swirl,instructions,without_absent_effects"
    );
    let mut holds = true;
    for (index, case) in EFFECT_CASES.iter().enumerate() {
        if index == 0 {
            // Tables are built once, not under valgrind.
            Model::set_up(Method::Exact, &ModelOptions::default()).unwrap();
        }
        let instructions = counted(index, false);
        let yardstick = match has_yardstick(case) {
            true => counted(index, true),
            false => f64::NAN,
        };
        holds &= yardstick.is_nan() || instructions <= (1.0 + ALLOWED) * yardstick;
        println!(
            "{},{},{},{},{},{},{instructions:.1},{yardstick:.1}",
            case.state, case.method, case.modes, case.repulsion, case.gravity, case.swirl
        );
    }
    if holds {
        ExitCode::SUCCESS
    } else {
        eprintln!("an absent effect costs more than {} %", 100.0 * ALLOWED);
        ExitCode::FAILURE
    }
}
