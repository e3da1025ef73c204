//! Stresslets and rates of work by unit causes: against lone squirmers, the loads of `exact`, the tractions of the flow, and laws that any solution obeys.

use std::f64::consts::PI;
use std::num::NonZeroUsize;

use crate::moving::pair;
use approx::assert_relative_eq;
use bem::Bem;
use exact::Exact;
use gauss_quad::GaussLegendre;
use nalgebra::{Matrix3, Vector3};
use scene::stress::{Block, BlockStresses, Cause, Stresses};
use scene::{Fluid, Gap, Hydrodynamics, LoadSet};

const MODES: usize = 3;
const SWIRL: usize = 2;

fn stresses(ratio: f64, gap: f64) -> Stresses {
    let bem = Bem::of_ratio(2, ratio).unwrap();
    bem.stresses(Gap::new(gap).unwrap(), MODES, SWIRL).unwrap()
}

fn place(of: &BlockStresses, sphere: usize, cause: Cause) -> usize {
    sphere * of.causes.len() + of.causes.iter().position(|c| *c == cause).unwrap()
}

fn work(of: &BlockStresses, [row, column]: [(usize, Cause); 2]) -> f64 {
    of.work[(place(of, row.0, row.1), place(of, column.0, column.1))]
}

fn block(of: &Stresses, block: Block) -> &BlockStresses {
    of.blocks.iter().find(|of| of.block == block).unwrap()
}

/// What a lone squirmer of mode n dissipates, held still: `16 pi/(n(n+1)) B_n²` over all orders (Blake 1971).
fn lone_order_zero(n: usize) -> f64 {
    16.0 * PI / (n * (n + 1)) as f64
}

#[test]
fn val_far_apart_each_dissipates_what_a_lone_squirmer_does() {
    let far = stresses(1.0, 1e6);
    let axial = block(&far, Block::Order(0));
    for sphere in [0, 1] {
        let own = |cause| [(sphere, cause); 2];
        let drag = work(axial, own(Cause::Translation));
        assert_relative_eq!(drag, 6.0 * PI, max_relative = 1e-6);
        for n in 1..=MODES {
            let found = work(axial, own(Cause::Squirming(n)));
            assert_relative_eq!(found, lone_order_zero(n), max_relative = 1e-6);
        }
        // Free: U = 2/3, P = 8/3 pi (2 B_1² + B_2²).
        let crossed = work(
            axial,
            [(sphere, Cause::Translation), (sphere, Cause::Squirming(1))],
        );
        let first = work(axial, own(Cause::Squirming(1)));
        let free = first + 4.0 / 3.0 * crossed + 4.0 / 9.0 * drag;
        assert_relative_eq!(free, 16.0 / 3.0 * PI, max_relative = 1e-6);
        for (order, expected) in [(0, 4.0 * PI), (1, 4.0 * PI), (2, 8.0 * PI)] {
            let of = block(&far, Block::Order(order));
            let index = place(of, sphere, Cause::Squirming(2));
            assert_relative_eq!(of.stresslets[sphere][index], expected, max_relative = 1e-6);
            assert!(of.stresslets[1 - sphere][index].abs() < 1e-4);
        }
        let twist = block(&far, Block::Twist);
        let spin = work(twist, own(Cause::Rotation));
        assert_relative_eq!(spin, 8.0 * PI, max_relative = 1e-6);
        // The first mode is a rotation; the second has (n+2) ∫ u² = 4 x 8 pi/15.
        assert_relative_eq!(
            work(twist, own(Cause::Swirl(1))),
            8.0 * PI,
            max_relative = 1e-6
        );
        assert_relative_eq!(
            work(twist, own(Cause::Swirl(2))),
            32.0 / 15.0 * PI,
            max_relative = 1e-6
        );
    }
}

/// A squirmer dissipates the same whichever way it points, so that order m has `(n+m)!/(n-m)!/2` of order 0.
#[test]
fn val_orders_of_a_lone_mode_have_their_share() {
    let far = stresses(1.0, 1e6);
    for (n, order, share) in [
        (2, 1, 3.0),
        (2, 2, 12.0),
        (3, 1, 6.0),
        (3, 2, 60.0),
        (3, 3, 360.0),
    ] {
        let of = block(&far, Block::Order(order));
        let found = work(of, [(0, Cause::Squirming(n)); 2]);
        assert_relative_eq!(found, share * lone_order_zero(n), max_relative = 1e-6);
    }
}

#[test]
fn work_is_symmetric_and_positive() {
    for (ratio, gap) in [(1.0, 1.0), (1.0, 0.05), (2.0, 0.3)] {
        for of in stresses(ratio, gap).blocks {
            let scale = of.work.amax();
            let asymmetry = (&of.work - of.work.transpose()).amax() / scale;
            assert!(
                asymmetry < 2e-4,
                "{:?} at {ratio} {gap}: {asymmetry:e}",
                of.block
            );
            let symmetric = (&of.work + of.work.transpose()) * 0.5;
            // Spin and the first swirl mode are one cause.
            let least = symmetric.symmetric_eigenvalues().min();
            assert!(
                least > -2e-4 * scale,
                "{:?} at {ratio} {gap}: {least:e}",
                of.block
            );
        }
    }
}

/// Against `exact`, which shares no code with this crate: forces and torques are work against rigid motions.
#[test]
fn val_rigid_rows_and_columns_are_the_loads() {
    let gap = Gap::new(0.1).unwrap();
    let found = stresses(1.0, 0.1);
    let set = LoadSet::all(MODES).with_swirl(SWIRL);
    let (loads, swirl) = Exact::new().interacting_loads_with_swirl(gap, set).unwrap();
    use Cause::{Rotation, Squirming, Swirl, Translation};
    let axial = block(&found, Block::Order(0));
    let across = block(&found, Block::Order(1));
    let twist = block(&found, Block::Twist);
    let check = |of: &BlockStresses, row: (usize, Cause), column: Cause, expected: f64| {
        for ends in [[row, (0, column)], [(0, column), row]] {
            let found = work(of, ends);
            let scale = expected.abs().max(PI);
            assert!(
                (found - expected).abs() < 5e-4 * scale,
                "{ends:?}: {found} {expected}"
            );
        }
    };
    // Along d of the other sphere axial forces have the other sign, and so have torques.
    check(
        axial,
        (0, Translation),
        Translation,
        6.0 * PI * loads.xa.own(),
    );
    check(
        axial,
        (1, Translation),
        Translation,
        -6.0 * PI * loads.xa.other(),
    );
    check(
        across,
        (0, Translation),
        Translation,
        6.0 * PI * loads.ya.own(),
    );
    check(
        across,
        (1, Translation),
        Translation,
        6.0 * PI * loads.ya.other(),
    );
    check(across, (0, Rotation), Rotation, 8.0 * PI * loads.yc.own());
    check(
        across,
        (1, Rotation),
        Rotation,
        -8.0 * PI * loads.yc.other(),
    );
    check(
        across,
        (0, Translation),
        Rotation,
        -4.0 * PI * loads.yb.own(),
    );
    check(
        across,
        (1, Translation),
        Rotation,
        -4.0 * PI * loads.yb.other(),
    );
    check(twist, (0, Rotation), Rotation, 8.0 * PI * loads.xc.own());
    check(twist, (1, Rotation), Rotation, -8.0 * PI * loads.xc.other());
    for n in 1..=MODES {
        let of = loads.mode(n - 1);
        let by = Squirming(n);
        check(axial, (0, Translation), by, -PI * of.xf.own());
        check(axial, (1, Translation), by, PI * of.xf.other());
        check(across, (0, Translation), by, -PI * of.yf.own());
        check(across, (1, Translation), by, -PI * of.yf.other());
        check(across, (0, Rotation), by, -PI * of.yt.own());
        check(across, (1, Rotation), by, PI * of.yt.other());
    }
    for n in 1..=SWIRL {
        let of = swirl.modes()[n - 1];
        check(twist, (0, Rotation), Swirl(n), -PI * of.xtc.own());
        check(twist, (1, Rotation), Swirl(n), PI * of.xtc.other());
        check(across, (0, Translation), Swirl(n), -PI * of.yfc.own());
        check(across, (1, Translation), Swirl(n), -PI * of.yfc.other());
    }
}

#[test]
fn equal_spheres_are_the_limit_of_unlike_ones() {
    let equal = stresses(1.0, 0.2);
    let nearly = stresses(1.0 + 1e-9, 0.2);
    for (a, b) in equal.blocks.iter().zip(&nearly.blocks) {
        assert_eq!(a.block, b.block);
        let scale = a.work.amax();
        assert!(
            (&a.work - &b.work).amax() < 1e-6 * scale,
            "{:?} {} {}",
            a.block,
            a.work,
            b.work
        );
        for (a, b) in a.stresslets.iter().zip(&b.stresslets) {
            assert!((a - b).amax() < 1e-6 * scale);
        }
    }
}

#[test]
fn val_a_small_sphere_does_not_see_its_unit_of_length() {
    // The same pair with the other sphere's radius for the unit of length: forces go as the length, torques as its square.
    let (one, two) = (stresses(0.5, 0.1), stresses(2.0, 0.2));
    let (a, b) = (block(&one, Block::Order(1)), block(&two, Block::Order(1)));
    for (row, power) in [
        (Cause::Translation, 1),
        (Cause::Rotation, 3),
        (Cause::Squirming(2), 1),
    ] {
        let small = work(a, [(1, row); 2]);
        let large = work(b, [(0, row); 2]);
        assert_relative_eq!(small, large * 0.5f64.powi(power), max_relative = 1e-9);
    }
    let s = |of: &BlockStresses, on: usize| of.stresslets[on][place(of, on, Cause::Squirming(2))];
    assert_relative_eq!(s(a, 1), s(b, 0) * 0.25, max_relative = 1e-9);
}

/// Stresslet and power from the tractions of the flow, which knows nothing of orders or unit causes.
#[test]
fn val_stresslets_and_power_are_the_moments_of_the_tractions() {
    for (ratio, gap) in [(1.0, 0.4), (1.7, 0.5)] {
        let of = pair(ratio, gap);
        let bem = Bem::of_ratio(2, ratio).unwrap();
        let expected = bem
            .stresses(of.configuration.gap, MODES, SWIRL)
            .unwrap()
            .of(&of);
        let flow = bem.flow(&of).unwrap();
        let rings = GaussLegendre::new(NonZeroUsize::new(40).unwrap());
        let around = 40;
        let mut power = 0.0;
        for k in [0, 1] {
            let radius = of.configuration.radii[k];
            let mut stresslet = Matrix3::zeros();
            let mut slip_power = 0.0;
            for &(height, weight) in rings.as_node_weight_pairs() {
                let ring = weight * 2.0 * PI / f64::from(around);
                let across = (1.0 - height * height).sqrt();
                for j in 0..around {
                    let (s, c) = (2.0 * PI * f64::from(j) / f64::from(around)).sin_cos();
                    let [e1, e2] = [Vector3::new(0.8, -0.6, 0.0), Vector3::new(0.48, 0.64, 0.6)];
                    let normal = of.configuration.line * height + (e1 * c + e2 * s) * across;
                    let area = ring * radius * radius;
                    let traction = flow.traction(k, &normal) * area;
                    let velocity = of.surface_velocity(k, &normal);
                    let moment = normal * traction.transpose() * radius;
                    let moved = velocity * normal.transpose() * area;
                    stresslet += (moment + moment.transpose()) * 0.5 - moved - moved.transpose();
                    power -= velocity.dot(&traction);
                    slip_power -= of.slip(k, &normal).dot(&traction);
                }
            }
            stresslet -= Matrix3::identity() * (stresslet.trace() / 3.0);
            let scale = expected.stresslets[k].norm();
            assert!(
                (stresslet - expected.stresslets[k]).norm() < 3e-4 * scale,
                "{ratio} {k}: {stresslet} {}",
                expected.stresslets[k]
            );
            assert_relative_eq!(
                slip_power,
                expected.slip_power[k],
                epsilon = 3e-4 * expected.dissipation
            );
        }
        assert_relative_eq!(power, expected.dissipation, max_relative = 3e-4);
    }
}
