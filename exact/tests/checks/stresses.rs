//! Stresslets and power by series against integrals over the surfaces and over the fluid, and against the loads.

use std::f64::consts::{PI, TAU};

use crate::pair::{free, lone_flow, pair};
use exact::Exact;
use gauss_quad::legendre::GaussLegendre;
use scene::nalgebra::{Matrix3, Vector3};
use scene::stress::{Block, Cause, StressTable, Stresses, lone_power, lone_stresslet};
use scene::{Flow, Fluid, Gap, LoadSet, MovingPair, SelfOther};

fn model(ratio: f64) -> Exact {
    Exact::of_ratio(ratio).unwrap()
}

fn stresses(gap: f64, ratio: f64, modes: usize, swirl: usize) -> Stresses {
    let gap = Gap::new(gap).unwrap();
    model(ratio).stresses(gap, modes, swirl).unwrap()
}

fn rule(n: usize) -> GaussLegendre {
    GaussLegendre::new(n.try_into().unwrap())
}

/// `∫ f(normal) dS` over a unit sphere, with the pole along `axis`.
fn over_sphere<T>(axis: &Vector3<f64>, f: impl Fn(Vector3<f64>) -> T) -> T
where
    T: std::ops::Mul<f64, Output = T> + std::iter::Sum,
{
    let aside = axis.cross(&Vector3::ith(axis.iamin(), 1.0)).normalize();
    let third = axis.cross(&aside);
    let around = 24;
    let rule = rule(70);
    let points = rule.iter().flat_map(|(x, weight)| {
        let radius = (1.0 - x * x).sqrt();
        (0..around).map(move |k| {
            let (sin, cos) = (TAU * f64::from(k) / f64::from(around)).sin_cos();
            (
                (*x, radius * cos, radius * sin),
                weight * TAU / f64::from(around),
            )
        })
    });
    let value =
        |((x, y, z), weight): ((f64, f64, f64), f64)| f(axis * x + aside * y + third * z) * weight;
    points.map(value).sum()
}

#[test]
fn val_stresslets_and_power_are_integrals_of_the_traction() {
    for (gap, ratio) in [(1.0, 1.0), (0.3, 1.0), (0.6, 0.5), (2.0, 2.5)] {
        let pair = pair(gap, ratio);
        let flow = model(ratio).flow(&pair).unwrap();
        let found = stresses(gap, ratio, 4, 3).of(&pair);
        let mut dissipation = 0.0;
        for k in [0, 1] {
            let radius = pair.configuration.radii[k];
            let line = pair.configuration.line;
            let stresslet: Matrix3<f64> = over_sphere(&line, |n| {
                let (f, u) = (flow.traction(k, &n), pair.surface_velocity(k, &n));
                let both = |a: Vector3<f64>, b: Vector3<f64>| a * b.transpose() + b * a.transpose();
                both(f, n) * (0.5 * radius)
                    - Matrix3::identity() * (f.dot(&n) * radius / 3.0)
                    - both(u, n)
            }) * radius.powi(2);
            let error = (stresslet - found.stresslets[k]).amax() / stresslet.amax();
            assert!(
                error < 1e-9,
                "gap {gap}, ratio {ratio}, stresslet {k}: {error:e}"
            );
            assert!(found.stresslets[k].trace().abs() < 1e-10 * stresslet.amax());
            let power = |velocity: &dyn Fn(&Vector3<f64>) -> Vector3<f64>| {
                let density = |n| -velocity(&n).dot(&flow.traction(k, &n));
                over_sphere(&line, density) * radius.powi(2)
            };
            let by_slip = power(&|n| pair.slip(k, n));
            let error = (by_slip - found.slip_power[k]).abs() / by_slip.abs();
            assert!(
                error < 1e-9,
                "gap {gap}, ratio {ratio}, slip of {k}: {error:e}"
            );
            dissipation += by_slip + power(&|n| pair.rigid_velocity(k, n));
        }
        let error = (dissipation - found.dissipation).abs() / dissipation;
        assert!(error < 1e-9, "gap {gap}, ratio {ratio}: {error:e}");
    }
}

/// `∫ 2 e:e dV` over the fluid about two unit spheres, in bispherical coordinates `xi, eta`: infinity is the point (0, 0), where three
/// triangles meet that the rectangle is cut into.
fn dissipated(flow: &dyn Flow, pair: &MovingPair) -> f64 {
    let configuration = &pair.configuration;
    let alpha = (1.0 + 0.5 * configuration.gap.eps()).acosh();
    let c = alpha.sinh();
    let d = configuration.line;
    let aside = d.cross(&Vector3::ith(d.iamin(), 1.0)).normalize();
    let third = d.cross(&aside);
    let around = 14;
    let density = |xi: f64, eta: f64| {
        let s = xi.cosh() - eta.cos();
        let (z, rho) = (c * xi.sinh() / s, c * eta.sin() / s);
        let of = |k: i32| {
            let (sin, cos) = (TAU * f64::from(k) / f64::from(around)).sin_cos();
            let point = configuration.midpoint - d * z + (aside * cos + third * sin) * rho;
            let gradient = flow.gradient(&point);
            0.5 * (gradient + gradient.transpose()).norm_squared()
        };
        let mean = (0..around).map(of).sum::<f64>() / f64::from(around);
        mean * TAU * rho * (c / s).powi(2)
    };
    let corners = [(-alpha, 0.0), (-alpha, PI), (alpha, PI), (alpha, 0.0)];
    let rule = rule(40);
    let mut sum = 0.0;
    for ends in corners.windows(2) {
        let [(x1, y1), (x2, y2)] = [ends[0], ends[1]];
        let area = (x1 * y2 - x2 * y1).abs();
        for (u, wu) in rule.iter() {
            for (v, wv) in rule.iter() {
                let (u, v) = (0.5 * (1.0 + u), 0.5 * (1.0 + v));
                let (xi, eta) = (u * (x1 + v * (x2 - x1)), u * (y1 + v * (y2 - y1)));
                sum += 0.25 * wu * wv * area * u * density(xi, eta);
            }
        }
    }
    sum
}

#[test]
fn val_the_work_of_the_surfaces_is_dissipated_in_the_fluid() {
    let mut pair = pair(0.5, 1.0);
    // Without net force, so that the flow falls off as r^-2.
    let all = stresses(0.5, 1.0, 4, 3);
    pair.velocities = balanced(&all, &pair);
    let flow = model(1.0).flow(&pair).unwrap();
    let (work, heat) = (all.of(&pair).dissipation, dissipated(flow.as_ref(), &pair));
    let error = (work - heat).abs() / work;
    println!("work {work}, dissipated {heat}: {error:.1e}");
    assert!(error < 1e-8, "{error:e}");
}

/// Velocities with which the pair has no force at its spins, by the rows of rigid motion of the rates of work, axis by axis.
fn balanced(all: &Stresses, pair: &MovingPair) -> [Vector3<f64>; 2] {
    let mut velocities = [Vector3::zeros(); 2];
    let force = |velocities: [Vector3<f64>; 2]| {
        // The force along an axis is the work that a velocity along it does: P is quadratic, so by polarisation.
        let power = |extra: [Vector3<f64>; 2]| {
            let velocities = [velocities[0] + extra[0], velocities[1] + extra[1]];
            all.of(&MovingPair {
                velocities,
                ..*pair
            })
            .dissipation
        };
        let axes = (0..6).map(|k| {
            let mut extra = [Vector3::zeros(); 2];
            extra[k / 3] = Vector3::ith(k % 3, 1.0);
            0.25 * (power(extra) - power(extra.map(|v| -v)))
        });
        scene::nalgebra::SVector::<f64, 6>::from_iterator(axes)
    };
    let rest = force(velocities);
    let matrix =
        scene::nalgebra::SMatrix::<f64, 6, 6>::from_columns(&std::array::from_fn::<_, 6, _>(|k| {
            let mut unit = [Vector3::zeros(); 2];
            unit[k / 3] = Vector3::ith(k % 3, 1.0);
            force(unit) - rest
        }));
    let solved = matrix.lu().solve(&-rest).unwrap();
    for k in 0..6 {
        velocities[k / 3][k % 3] = solved[k];
    }
    velocities
}

#[test]
fn val_rates_of_work_are_symmetric_and_positive() {
    for (gap, ratio) in [
        (1e-3, 1.0),
        (0.01, 1.0),
        (0.3, 0.2),
        (0.05, 5.0),
        (3.0, 1.0),
    ] {
        for of in stresses(gap, ratio, 4, 3).blocks {
            let scale = of.work.amax();
            let asymmetry = (&of.work - of.work.transpose()).amax() / scale;
            assert!(
                asymmetry < 1e-10,
                "gap {gap}, ratio {ratio}, {:?}: {asymmetry:e}",
                of.block
            );
            // Swirl of the first mode is a spin, and adds nothing.
            let least = of.work.symmetric_eigenvalues().min();
            assert!(
                least > -1e-10 * scale,
                "gap {gap}, ratio {ratio}, {:?}: {least:e}",
                of.block
            );
        }
    }
}

#[test]
fn val_rigid_motion_works_against_the_loads_of_the_model() {
    let set = LoadSet::all(3).with_swirl(2);
    for (gap, ratio) in [(0.01, 1.0), (0.7, 1.0), (0.2, 0.3), (1.5, 4.0)] {
        let all = stresses(gap, ratio, 3, 2);
        let loads = model(ratio)
            .series_loads_of_each(Gap::new(gap).unwrap(), set)
            .unwrap();
        for (active, (loads, radius)) in loads.into_iter().zip([1.0, ratio]).enumerate() {
            let check = |block: Block, row: Cause, column: Cause, unit: f64, load: SelfOther| {
                let of = all.blocks.iter().find(|of| of.block == block).unwrap();
                let at = |cause: Cause| of.causes.iter().position(|c| *c == cause).unwrap();
                let n = of.causes.len();
                let work = |on: usize| of.work[(on * n + at(row), active * n + at(column))];
                for (found, expected) in
                    [(work(active), load.own()), (work(1 - active), load.other())]
                {
                    let error =
                        (found - unit * expected).abs() / (unit.abs() * expected.abs().max(1.0));
                    assert!(
                        error < 1e-9,
                        "{gap} {ratio} {block:?} {row:?} {column:?}: {error:e}"
                    );
                }
            };
            let (x, y, twist) = (Block::Order(0), Block::Order(1), Block::Twist);
            // Each sphere's motion is along its own `d`, and so are its loads: what is along `d` of the active one changes sign.
            let turned = |of: SelfOther| SelfOther::new(of.own(), -of.other());
            let (moves, turns) = (Cause::Translation, Cause::Rotation);
            let [a, a2, a3] = [1, 2, 3].map(|power| PI * f64::powi(radius, power));
            check(x, moves, moves, 6.0 * a, turned(loads.pair.xa));
            check(y, moves, moves, 6.0 * a, loads.pair.ya);
            check(y, moves, turns, -4.0 * a2, loads.pair.yb);
            check(y, turns, turns, 8.0 * a3, turned(loads.pair.yc));
            check(twist, turns, turns, 8.0 * a3, turned(loads.pair.xc));
            for (n, mode) in (1..).zip(loads.pair.modes()) {
                let slip = Cause::Squirming(n);
                check(x, moves, slip, -a, turned(mode.xf));
                check(y, moves, slip, -a, mode.yf);
                check(y, turns, slip, -a2, turned(mode.yt));
            }
            for (n, mode) in (1..).zip(loads.swirl.modes()) {
                let swirl = Cause::Swirl(n);
                check(twist, turns, swirl, -a2, turned(mode.xtc));
            }
        }
    }
}

#[test]
fn val_a_lone_squirmer_has_the_power_and_the_stresslet_of_blake() {
    // Two modes: P = (8/3) pi mu a (2 B_1^2 + B_2^2), S = 4 pi mu a^2 B_2 (p p - I/3).
    let modes = [1.5, -2.0, 0.7, 0.4];
    let two = scene::Squirmer::new(&modes[..2]).unwrap();
    let power = 8.0 / 3.0 * PI * (2.0 * modes[0] * modes[0] + modes[1] * modes[1]);
    assert!((lone_power(&two) / power - 1.0).abs() < 1e-14);
    let mut pair = pair(3000.0, 1.0);
    let swirl = [0.5, -0.8, 0.3];
    let squirmer = scene::Squirmer::new(&modes).unwrap();
    let squirmer = squirmer.with_swirl(&swirl).unwrap();
    pair.squirmers = [squirmer; 2];
    pair.velocities = pair
        .configuration
        .orientations
        .map(|p| p * (2.0 / 3.0 * modes[0]));
    pair.angular_velocities = pair.configuration.orientations.map(|p| p * -swirl[0]);
    let found = stresses(3000.0, 1.0, 4, 3).of(&pair);
    let power = lone_power(&squirmer);
    for k in [0, 1] {
        assert!(
            (found.slip_power[k] / power - 1.0).abs() < 1e-5,
            "{:?}",
            found.slip_power
        );
        let expected = lone_stresslet(&pair, k);
        assert!((found.stresslets[k] - expected).amax() < 1e-5 * expected.amax());
    }
    assert!((found.dissipation / (2.0 * power) - 1.0).abs() < 1e-5);
}

#[test]
fn val_a_table_of_stresses_is_the_direct_solve_at_any_gap() {
    for ratio in [1.0, 0.5] {
        let model = model(ratio);
        let ends = [0.004, 12.0].map(|gap| Gap::new(gap).unwrap());
        let table = StressTable::build(&model, ends, (2, 2), 1e-10).unwrap();
        for k in 0..30 {
            let gap = Gap::new(0.004 * 3000.0_f64.powf(f64::from(k) / 29.0)).unwrap();
            let (found, truth) = (table.at(gap).unwrap(), model.stresses(gap, 2, 2).unwrap());
            for (a, b) in found.columns().zip(truth.columns()) {
                assert!(
                    (a - b).abs() < 1e-9 * b.abs().max(1.0),
                    "{}: {a} {b}",
                    gap.eps()
                );
            }
        }
        println!(
            "{} gaps, {:.1e}",
            table.evaluations(),
            table.interpolation_error()
        );
        assert!(table.at(Gap::new(0.003).unwrap()).is_err());
        assert!(table.at(Gap::new(12.1).unwrap()).is_err());
    }
}

#[test]
fn val_named_numbers_of_lone_squirmers_are_those_of_the_documentation() {
    for (ratio, own, [same, across]) in [(1.0, "1", ["1", "2"]), (0.5, "22", ["22", "12"])] {
        let named = stresses(2000.0, ratio, 3, 2).named(ratio);
        let of = |name: &str| named.iter().find(|(n, _)| n == name).unwrap().1;
        for (kind, lone) in [("XS", 4.0), ("YS", 4.0), ("ZS", 4.0)] {
            let found = of(&format!("{kind}{own}_2"));
            assert!((found - lone).abs() < 1e-5, "{kind} {ratio}: {found}");
        }
        // Alone, modes of different number and swirl do no work on one another, and n = 1 moves the fluid as Blake has it.
        for (kind, lone) in [("XP", 8.0 / 3.0), ("YP", 8.0), ("ZP", 2.0)] {
            let found = of(&format!("{kind}{same}_2_2"));
            assert!((found - lone).abs() < 1e-4, "{kind} {ratio}: {found}");
            let found = of(&format!("{kind}{across}_2_2"));
            assert!(found.abs() < 1e-4, "{kind} {ratio}: {found}");
        }
        assert!(of(&format!("XP{same}_2_3")).abs() < 1e-4);
    }
}

#[test]
fn val_a_distant_squirmer_answers_the_strain_of_the_other_one() {
    // Faxén: (20/3) pi mu a^3 times the strain of the other's flow at its centre, and its Laplacian over 10, which is of the order r^-5.
    let mut before = f64::INFINITY;
    for gap in [10.0, 20.0, 40.0] {
        let pair = free(gap, 1.0);
        let found = stresses(gap, 1.0, 2, 0).of(&pair);
        let mut worst = 0.0_f64;
        for k in [0, 1] {
            let centre = pair.configuration.positions()[k];
            let flow = |step: Vector3<f64>| lone_flow(&pair, 1 - k, &(centre + step));
            let slope =
                |j: usize| (flow(Vector3::ith(j, 1e-3)) - flow(Vector3::ith(j, -1e-3))) / 2e-3;
            let gradient = Matrix3::from_columns(&[0, 1, 2].map(slope));
            let expected = (gradient + gradient.transpose()) * (0.5 * 20.0 / 3.0 * PI);
            let excess = found.stresslets[k] - lone_stresslet(&pair, k);
            assert!(expected.amax() > 1.0 / gap.powi(3));
            worst = worst.max((excess - expected).amax());
        }
        println!("gap {gap}: {worst:.1e}");
        assert!(worst < 400.0 / gap.powi(5) && worst < before / 20.0);
        before = worst;
    }
}
