//! Instructions of one right-hand side, counted by valgrind's callgrind: what each effect costs, and that
//! an absent one costs nothing.
//!
//! `cargo bench -p squirmers-compare --bench instructions` prints a table as CSV and fails if a right-hand side takes
//! more than 1 % more instructions than the same arithmetic written without the absent effects. It needs
//! `valgrind`; counts do not depend on what else the machine does, but on the compiler.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the bench")]

use std::f64::consts::PI;
use std::hint::black_box;
use std::process::{Command, ExitCode};

use compare::effects::{EFFECT_CASES, EffectCase};
use compare::{Method, Model, ModelOptions};
use lt::{Form, Lubrication};
use scene::balance::Transverse;
use scene::{
    Gap, Hydrodynamics, LoadSet, PairLoads, Plan, Repulsion, SceneError, Squirmer, State, legendre,
};

/// Right-hand sides in the shorter and the longer of two runs, whose difference is free of set-up.
const TIMES: [usize; 2] = [1_000, 3_000];

/// Most that an absent effect may cost, relative to the arithmetic without it.
const ALLOWED: f64 = 0.01;

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

/// The equations of `scene::balance` and of the planar and the spatial coordinates, written once more
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
        gap: Gap,
        loads: &PairLoads,
        squirmers: &[Squirmer; 2],
        repulsion: Option<f64>,
        cosines: [f64; 2],
        transverse: [T; 2],
    ) -> Velocity<T> {
        let (mut sum, mut difference) = (0.0, 0.0);
        let (mut one, mut two) = ([0.0; 4], [0.0; 4]);
        let orders = legendre(cosines[0]).zip(legendre(cosines[1]));
        for (n, (p1, p2)) in (0..loads.set().modes).zip(orders) {
            let mode = loads.mode(n);
            let [b1, b2] = [squirmers[0].mode(n), squirmers[1].mode(n)];
            let (q1, q2) = (b1 * p1.p, b2 * p2.p);
            sum += (q1 - q2) * mode.xf.sum;
            difference += (q1 + q2) * mode.xf.difference;
            for (of, strength) in [(&mut one, b1 * p1.w), (&mut two, b2 * p2.w)] {
                of[0] += strength * mode.yf.sum;
                of[1] += strength * mode.yf.difference;
                of[2] += strength * mode.yt.sum;
                of[3] += strength * mode.yt.difference;
            }
        }
        if let Some(repulsion) = repulsion {
            difference -= 2.0 * repulsion;
        }
        let [v1, v2] = transverse;
        let solve = |a: f64, b: f64, c: f64, force: T, torque: T| {
            let inverse = 1.0 / (48.0 * a * c - 16.0 * b * b);
            (
                (force * (8.0 * c) + torque * (4.0 * b)) * inverse,
                (force * (4.0 * b) + torque * (6.0 * a)) * inverse,
            )
        };
        let (total, spin_difference) = solve(
            loads.ya.sum,
            loads.yb.sum,
            loads.yc.difference,
            v1 * one[0] + v2 * two[0],
            v1 * one[3] + v2 * two[3],
        );
        let (apart, spin_sum) = solve(
            loads.ya.difference,
            loads.yb.difference,
            loads.yc.sum,
            v1 * one[1] - v2 * two[1],
            v1 * one[2] - v2 * two[2],
        );
        Velocity {
            opening: difference * (-1.0 / (6.0 * (loads.xa.difference * gap.eps()))),
            axial: sum / (12.0 * loads.xa.sum),
            across: total * 0.5,
            turning: apart * (-1.0 / gap.distance()),
            spin: [
                (spin_sum + spin_difference) * 0.5,
                (spin_sum - spin_difference) * 0.5,
            ],
        }
    }

    /// As the stepper calls them: functions of their own, to which two modes are known.
    macro_rules! with_two_modes_known {
        ($name:ident, $of:ident, $n:literal) => {
            #[inline(never)]
            pub fn $name<const REPULSION: bool>(y: &[f64; $n], given: &mut Given) -> [f64; $n] {
                let set = given.set;
                match set.modes {
                    2 => $of::<REPULSION>(y, given, LoadSet { modes: 2, ..set }),
                    _ => $of::<REPULSION>(y, given, set),
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
    fn planar_of<const REPULSION: bool>(y: &[f64; 6], given: &mut Given, set: LoadSet) -> [f64; 6] {
        let [(s1, c1), (s2, c2)] = [y[4].sin_cos(), y[5].sin_cos()];
        let gap = Gap::from_ln(y[3]);
        given.loads += 1;
        let repulsion = REPULSION.then(|| given.repulsion.force(gap));
        let loads = given.model.interacting_loads(gap, set);
        let loads = match loads {
            Ok(loads) => loads,
            Err(error) => return refused(error, &mut given.failure),
        };
        let v = velocity(
            gap,
            &loads,
            &given.squirmers,
            repulsion,
            [c1, c2],
            [s1, -s2],
        );
        let (sin, cos) = y[2].sin_cos();
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
    fn spatial_of<const REPULSION: bool>(
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
        let loads = given.model.interacting_loads(gap, set);
        let loads = match loads {
            Ok(loads) => loads,
            Err(error) => return refused(error, &mut given.failure),
        };
        let v = velocity(
            gap,
            &loads,
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
