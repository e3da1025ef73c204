//! Stresslets and rates of work by unit causes: against lone squirmers, the loads of the same meshes, and laws that any solution obeys.

#![allow(clippy::unwrap_used, reason = "a test may panic, its helpers too")]

use std::f64::consts::PI;

use approx::assert_relative_eq;
use bem::Bem;
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
        assert_relative_eq!(drag, 6.0 * PI, max_relative = 1e-4);
        for n in 1..=MODES {
            let found = work(axial, own(Cause::Squirming(n)));
            assert_relative_eq!(found, lone_order_zero(n), max_relative = 2e-3);
        }
        // Free: U = 2/3, P = 8/3 pi (2 B_1² + B_2²).
        let crossed = work(
            axial,
            [(sphere, Cause::Translation), (sphere, Cause::Squirming(1))],
        );
        let first = work(axial, own(Cause::Squirming(1)));
        let free = first + 4.0 / 3.0 * crossed + 4.0 / 9.0 * drag;
        assert_relative_eq!(free, 16.0 / 3.0 * PI, max_relative = 1e-3);
        for (order, expected) in [(0, 4.0 * PI), (1, 4.0 * PI), (2, 8.0 * PI)] {
            let of = block(&far, Block::Order(order));
            let index = place(of, sphere, Cause::Squirming(2));
            assert_relative_eq!(of.stresslets[sphere][index], expected, max_relative = 1e-3);
            assert!(of.stresslets[1 - sphere][index].abs() < 1e-3);
        }
        let twist = block(&far, Block::Twist);
        let spin = work(twist, own(Cause::Rotation));
        assert_relative_eq!(spin, 8.0 * PI, max_relative = 1e-4);
        // The first mode is a rotation; the second has (n+2) ∫ u² = 4 x 8 pi/15.
        assert_relative_eq!(
            work(twist, own(Cause::Swirl(1))),
            8.0 * PI,
            max_relative = 1e-4
        );
        assert_relative_eq!(
            work(twist, own(Cause::Swirl(2))),
            32.0 / 15.0 * PI,
            max_relative = 1e-3
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
        assert_relative_eq!(found, share * lone_order_zero(n), max_relative = 5e-3);
    }
}

#[test]
fn work_is_symmetric_and_positive() {
    for (ratio, gap) in [(1.0, 1.0), (1.0, 0.05), (2.0, 0.3)] {
        for of in stresses(ratio, gap).blocks {
            let scale = of.work.amax();
            let asymmetry = (&of.work - of.work.transpose()).amax() / scale;
            assert!(
                asymmetry < 2e-3,
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

#[test]
fn val_rigid_rows_are_the_loads() {
    let gap = Gap::new(0.1).unwrap();
    let found = stresses(1.0, 0.1);
    let set = LoadSet::all(MODES).with_swirl(SWIRL);
    let bem = Bem::new(2).unwrap();
    let (loads, swirl) = bem.interacting_loads_with_swirl(gap, set).unwrap();
    use Cause::{Rotation, Squirming, Swirl, Translation};
    let rigid = 1e-9;
    // Slip loads follow there from rigid densities, here from those of slip.
    let reciprocal = 3e-3;
    let axial = block(&found, Block::Order(0));
    let across = block(&found, Block::Order(1));
    let twist = block(&found, Block::Twist);
    let check =
        |of: &BlockStresses, row: (usize, Cause), column: Cause, expected: f64, within: f64| {
            let found = work(of, [row, (0, column)]);
            let scale = expected.abs().max(1.0);
            assert!(
                (found - expected).abs() < within * scale,
                "{row:?} {column:?}: {found} {expected}"
            );
        };
    // Along d of the other sphere axial forces have the other sign, and so have torques.
    check(
        axial,
        (0, Translation),
        Translation,
        6.0 * PI * loads.xa.own(),
        rigid,
    );
    check(
        axial,
        (1, Translation),
        Translation,
        -6.0 * PI * loads.xa.other(),
        rigid,
    );
    check(
        across,
        (0, Translation),
        Translation,
        6.0 * PI * loads.ya.own(),
        rigid,
    );
    check(
        across,
        (1, Translation),
        Translation,
        6.0 * PI * loads.ya.other(),
        rigid,
    );
    check(
        across,
        (0, Rotation),
        Rotation,
        8.0 * PI * loads.yc.own(),
        rigid,
    );
    check(
        across,
        (1, Rotation),
        Rotation,
        -8.0 * PI * loads.yc.other(),
        rigid,
    );
    check(
        across,
        (0, Translation),
        Rotation,
        -4.0 * PI * loads.yb.own(),
        rigid,
    );
    check(
        across,
        (1, Translation),
        Rotation,
        -4.0 * PI * loads.yb.other(),
        rigid,
    );
    check(
        twist,
        (0, Rotation),
        Rotation,
        8.0 * PI * loads.xc.own(),
        rigid,
    );
    check(
        twist,
        (1, Rotation),
        Rotation,
        -8.0 * PI * loads.xc.other(),
        rigid,
    );
    for n in 1..=MODES {
        let of = loads.mode(n - 1);
        let by = Squirming(n);
        check(axial, (0, Translation), by, -PI * of.xf.own(), reciprocal);
        check(axial, (1, Translation), by, PI * of.xf.other(), reciprocal);
        check(across, (0, Translation), by, -PI * of.yf.own(), reciprocal);
        check(
            across,
            (1, Translation),
            by,
            -PI * of.yf.other(),
            reciprocal,
        );
        check(across, (0, Rotation), by, -PI * of.yt.own(), reciprocal);
        check(across, (1, Rotation), by, PI * of.yt.other(), reciprocal);
    }
    for n in 1..=SWIRL {
        let of = swirl.modes()[n - 1];
        check(
            twist,
            (0, Rotation),
            Swirl(n),
            -PI * of.xtc.own(),
            reciprocal,
        );
        check(
            twist,
            (1, Rotation),
            Swirl(n),
            PI * of.xtc.other(),
            reciprocal,
        );
        check(
            across,
            (0, Translation),
            Swirl(n),
            -PI * of.yfc.own(),
            reciprocal,
        );
        check(
            across,
            (1, Translation),
            Swirl(n),
            -PI * of.yfc.other(),
            reciprocal,
        );
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
