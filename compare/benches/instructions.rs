//! Instructions of one right-hand side, counted by valgrind's callgrind: what each effect costs, and that
//! an absent one costs nothing.
//!
//! `cargo bench -p compare --bench instructions` prints a table as CSV and fails if a right-hand side takes
//! more than 1 % more instructions than the same arithmetic written without the absent effects. It needs
//! `valgrind`; counts do not depend on what else the machine does, but on the compiler.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the bench")]

use std::f64::consts::PI;
use std::hint::black_box;
use std::process::{Command, ExitCode};

use compare::{Method, Model, ModelOptions};
use lt::{Form, Lubrication};
use scene::balance::Transverse;
use scene::{
    Gap, Gravity, Hydrodynamics, LoadSet, Orientation, PairLoads, Plan, Pose, Repulsion, Scene,
    Squirmer, State, legendre,
};

/// Right-hand sides in the shorter and the longer of two runs, whose difference is free of set-up.
const TIMES: [usize; 2] = [1_000, 3_000];

/// Most that an absent effect may cost, relative to the arithmetic without it.
const ALLOWED: f64 = 0.01;

/// What is counted: the state, the effects, the highest squirming mode, the model.
#[derive(Clone, Copy)]
struct Case {
    state: State,
    repulsion: bool,
    gravity: bool,
    swirl: bool,
    modes: usize,
    method: Method,
}

const fn case(state: State, effects: (bool, bool, bool)) -> Case {
    let (repulsion, gravity, swirl) = effects;
    Case {
        state,
        repulsion,
        gravity,
        swirl,
        modes: 2,
        method: Method::Lt,
    }
}

/// Every subset of effects that a scene of the paper, or one with swirl, can call for.
const CASES: [Case; 22] = [
    case(State::Axisymmetric, (false, false, false)),
    case(State::Axisymmetric, (true, false, false)),
    case(State::PointSymmetric, (false, false, false)),
    case(State::PointSymmetric, (true, false, false)),
    case(State::MirrorSymmetric, (false, false, false)),
    case(State::MirrorSymmetric, (true, false, false)),
    case(State::MirrorSymmetric, (true, true, false)),
    case(State::Planar, (false, false, false)),
    case(State::Planar, (true, false, false)),
    case(State::Planar, (false, true, false)),
    case(State::Planar, (true, true, false)),
    case(State::Spatial, (false, false, false)),
    case(State::Spatial, (true, false, false)),
    case(State::Spatial, (false, true, false)),
    case(State::Spatial, (true, true, false)),
    case(State::Spatial, (true, false, true)),
    Case {
        modes: 1,
        ..case(State::Planar, (true, false, false))
    },
    Case {
        modes: 8,
        ..case(State::Planar, (true, false, false))
    },
    Case {
        method: Method::Exact,
        ..case(State::PointSymmetric, (true, false, false))
    },
    Case {
        method: Method::Exact,
        ..case(State::Planar, (true, false, false))
    },
    Case {
        method: Method::Exact,
        ..case(State::Planar, (true, true, false))
    },
    Case {
        method: Method::Exact,
        ..case(State::Spatial, (true, false, false))
    },
];

impl Case {
    /// The scene: first angles that the state calls for, close to contact.
    fn scene(&self) -> Scene {
        let angles = match self.state {
            State::Axisymmetric => [0.0, PI],
            State::PointSymmetric => [0.7, 0.7 + PI],
            State::MirrorSymmetric => [0.7, PI - 0.7],
            State::Planar | State::Spatial => [0.7, 1.9],
        };
        let modes: Vec<f64> = (0..self.modes).map(|n| 1.5 / (1.0 + n as f64)).collect();
        let mut squirmer = Squirmer::new(&modes).unwrap();
        if self.gravity {
            squirmer = squirmer.bottom_heavy(10.0).unwrap();
        }
        if self.swirl {
            squirmer = squirmer.with_swirl(&[0.3, 0.2]).unwrap();
        }
        let lift = if self.state == State::Spatial {
            0.1
        } else {
            0.0
        };
        let pose = |side: f64, angle: f64| Pose {
            position: [1.05 * side, 0.0, lift * side].into(),
            orientation: Orientation::Angle(angle),
        };
        let start = [pose(-1.0, angles[0]), pose(1.0, angles[1])];
        let repulsion = self.repulsion.then_some(Repulsion::PAPER);
        let gravity = self.gravity.then_some(Gravity::DOWN);
        Scene::new([squirmer; 2], start, repulsion, gravity).unwrap()
    }

    /// Evaluates the right-hand side as the plan has it.
    fn planned(&self, times: usize) {
        let plan = Plan::new(&self.scene()).unwrap();
        assert_eq!(plan.state(), self.state);
        let model = Model::set_up(self.method, &ModelOptions::default()).unwrap();
        black_box(model.rates(&plan, plan.start(), times).unwrap());
    }

    /// Evaluates the same arithmetic, written without the absent effects; lubrication theory in the plane
    /// and in three dimensions.
    fn by_hand(&self, times: usize) {
        let plan = Plan::new(&self.scene()).unwrap();
        let squirmers = plan.scene().squirmers;
        let start = plan.start();
        let [d1, d2] = [
            start.angles[0] - start.line_angle,
            start.angles[1] - start.line_angle - PI,
        ];
        let planar = [0.0, 0.0, start.line_angle, start.gap.ln(), d1, d2];
        let mut spatial = [0.0; 13];
        for (at, v) in [
            (3, start.line),
            (7, start.orientations[0]),
            (10, start.orientations[1]),
        ] {
            spatial[at..at + 3].copy_from_slice(v.as_slice());
        }
        spatial[6] = start.gap.ln();
        match (self.state, self.repulsion) {
            (State::Planar, false) => {
                repeat(times, &planar, |y| by_hand::planar::<false>(y, &squirmers))
            }
            (State::Planar, true) => {
                repeat(times, &planar, |y| by_hand::planar::<true>(y, &squirmers))
            }
            (_, false) => repeat(times, &spatial, |y| {
                by_hand::spatial::<false>(y, &squirmers)
            }),
            (_, true) => repeat(times, &spatial, |y| by_hand::spatial::<true>(y, &squirmers)),
        }
    }

    /// Whether [`Self::by_hand`] knows it.
    fn has_yardstick(&self) -> bool {
        matches!(self.state, State::Planar | State::Spatial)
            && !self.gravity
            && !self.swirl
            && self.modes == 2
            && self.method == Method::Lt
    }
}

fn repeat<const N: usize>(times: usize, y: &[f64; N], rhs: impl Fn(&[f64; N]) -> [f64; N]) {
    for _ in 0..times {
        black_box(rhs(black_box(y)));
    }
}

/// The equations of `scene::balance` and of the planar and the spatial coordinates, written once more
/// without gravity and swirl, and without repulsion where there is none.
mod by_hand {
    use super::*;
    use nalgebra::Vector3;

    struct Velocity<T> {
        opening: f64,
        axial: f64,
        across: T,
        turning: T,
        spin: [T; 2],
    }

    fn velocity<T: Transverse, const REPULSION: bool>(
        gap: Gap,
        loads: &PairLoads,
        squirmers: &[Squirmer; 2],
        cosines: [f64; 2],
        transverse: [T; 2],
    ) -> Velocity<T> {
        let (mut sum, mut difference) = (0.0, 0.0);
        let (mut one, mut two) = ([0.0; 4], [0.0; 4]);
        let [b1, b2] = [squirmers[0].modes(), squirmers[1].modes()];
        let orders = legendre(cosines[0]).zip(legendre(cosines[1]));
        for (n, (mode, (p1, p2))) in loads.modes().iter().zip(orders).enumerate() {
            let b1 = b1.get(n).copied().unwrap_or(0.0);
            let b2 = b2.get(n).copied().unwrap_or(0.0);
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
        if REPULSION {
            difference -= 2.0 * Repulsion::PAPER.force(gap);
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
            opening: -difference / (6.0 * (loads.xa.difference * gap.eps())),
            axial: sum / (12.0 * loads.xa.sum),
            across: total * 0.5,
            turning: apart * (-1.0 / gap.distance()),
            spin: [
                (spin_sum + spin_difference) * 0.5,
                (spin_sum - spin_difference) * 0.5,
            ],
        }
    }

    pub fn planar<const REPULSION: bool>(y: &[f64; 6], squirmers: &[Squirmer; 2]) -> [f64; 6] {
        let gap = Gap::from_ln(y[3]);
        let model = Lubrication::new(Form::Published);
        let loads = model.interacting_loads(gap, LoadSet::planar(2));
        let Ok(loads) = &loads else {
            return [f64::NAN; 6];
        };
        let [(s1, c1), (s2, c2)] = [y[4].sin_cos(), y[5].sin_cos()];
        let v = velocity::<f64, REPULSION>(gap, loads, squirmers, [c1, c2], [s1, -s2]);
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

    pub fn spatial<const REPULSION: bool>(y: &[f64; 13], squirmers: &[Squirmer; 2]) -> [f64; 13] {
        let vector = |at: usize| Vector3::new(y[at], y[at + 1], y[at + 2]);
        let gap = Gap::from_ln(y[6]);
        let model = Lubrication::new(Form::Published);
        let loads = model.interacting_loads(gap, LoadSet::planar(2));
        let Ok(loads) = &loads else {
            return [f64::NAN; 13];
        };
        let line = vector(3);
        let d = line.normalize();
        let [(c1, v1), (c2, v2)] = [7, 10].map(|at| {
            let p = vector(at).normalize();
            let along = p.dot(&d);
            (along, p - d * along)
        });
        let v = velocity::<Vector3<f64>, REPULSION>(gap, loads, squirmers, [c1, -c2], [v1, v2]);
        let length = line.norm();
        let d = line / length;
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
    if let [index, by_hand, times] = &arguments[..] {
        let case = &CASES[index.parse::<usize>().unwrap()];
        let times = times.parse().unwrap();
        if by_hand == "true" {
            case.by_hand(times);
        } else {
            case.planned(times);
        }
        return ExitCode::SUCCESS;
    }
    println!(
        "state,model,squirming_modes,repulsion,gravity,swirl,instructions,without_absent_effects"
    );
    let mut holds = true;
    for (index, case) in CASES.iter().enumerate() {
        if index == 0 {
            // Tables are built once, not under valgrind.
            Model::set_up(Method::Exact, &ModelOptions::default()).unwrap();
        }
        let instructions = counted(index, false);
        let yardstick = match case.has_yardstick() {
            true => counted(index, true),
            false => f64::NAN,
        };
        holds &= !(instructions > (1.0 + ALLOWED) * yardstick);
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
