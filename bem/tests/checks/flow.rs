//! The flow: against singularities within the spheres, lone spheres, and the equations themselves.

use crate::moving::{configuration, pair};
use approx::assert_relative_eq;
use bem::{Bem, Layers};
use nalgebra::{Matrix3, Vector3};
use scene::{Configuration, Fluid, SceneError, Squirmer};

/// Velocity and pressure of a Stokeslet and a stresslet near each centre, 8 pi left out.
fn singular(of: &Configuration, x: &Vector3<f64>) -> (Vector3<f64>, f64) {
    let strain = Matrix3::new(0.2, 0.5, -0.1, 0.5, 0.3, 0.4, -0.1, 0.4, -0.5);
    let mut sum = (Vector3::zeros(), 0.0);
    for (k, f, at) in [
        (
            0,
            Vector3::new(0.7, -0.4, 0.5),
            Vector3::new(0.06, -0.09, 0.03),
        ),
        (
            1,
            Vector3::new(-0.3, 0.8, 0.6),
            Vector3::new(-0.03, 0.06, 0.08),
        ),
    ] {
        let r = x - of.positions()[k] - at * of.radii[k];
        let s = r.norm();
        let (along, twice) = (r.dot(&f) / s.powi(3), r.dot(&(strain * r)) / s.powi(5));
        sum.0 += f / s + r * (along - 3.0 * twice);
        sum.1 += 2.0 * along - 6.0 * twice;
    }
    sum
}

fn layers(level: usize, of: &Configuration) -> Layers {
    let bem = Bem::of_ratio(level, of.radii[1]).unwrap();
    let velocity =
        |k: usize, n: &Vector3<f64>| singular(of, &(of.positions()[k] + n * of.radii[k])).0;
    bem.layers(of, velocity).unwrap()
}

/// Unit vectors all over the sphere.
fn directions(count: usize) -> impl Iterator<Item = Vector3<f64>> {
    (0..count).map(move |i| {
        let z = 1.0 - (2 * i + 1) as f64 / count as f64;
        let (s, c) = (2.4 * i as f64).sin_cos();
        let r = (1.0 - z * z).sqrt();
        Vector3::new(r * c, r * s, z)
    })
}

#[test]
fn val_singularities_within_the_spheres_are_found_in_the_gap_and_away_from_the_surfaces() {
    for (ratio, gap, within) in [
        (1.0, 50.0, 1e-5),
        (1.0, 1.0, 5e-5),
        (1.0, 0.1, 1e-4),
        (1.0, 0.05, 2e-4),
        (2.0, 0.1, 1e-4),
    ] {
        let of = configuration(ratio, gap);
        let found = layers(3, &of);
        let across = Vector3::new(0.8, -0.6, 0.0);
        let middle = of.positions()[0] + of.line * (1.0 + 0.5 * gap);
        let in_gap = (0..10).map(|i| middle + across * (0.03 * f64::from(i)));
        let away = directions(20).map(|n| of.midpoint + n * (4.0 * ratio + 2.0 * gap));
        for x in in_gap.chain(away) {
            let (u, p) = singular(&of, &x);
            let state = found.at(&x);
            assert!((state.velocity - u).norm() < within, "{ratio} {gap} {x}");
            assert!(
                (state.pressure - p).abs() < 50.0 * within / gap.min(1.0),
                "{ratio} {gap}: {} {p}",
                state.pressure
            );
        }
    }
}

#[test]
fn val_the_mismatch_bounds_the_error_everywhere() {
    for (ratio, gap) in [(1.0, 50.0), (1.0, 0.05), (0.5, 0.1)] {
        let of = configuration(ratio, gap);
        let found = layers(2, &of);
        let bound =
            3.0 * found.mismatch(|k, n| singular(&of, &(of.positions()[k] + n * of.radii[k])).0);
        let (mut worst, mut fastest): (f64, f64) = (0.0, 0.0);
        for k in [0, 1] {
            for n in directions(12) {
                for height in [0.0, 1e-9, 1e-4, 0.01, 0.1, 1.0, 1e4] {
                    let x = of.positions()[k] + n * (of.radii[k] + height);
                    let other = (x - of.positions()[1 - k]).norm() - of.radii[1 - k];
                    if other > 0.0 {
                        let (truth, _) = singular(&of, &x);
                        worst = worst.max((found.at(&x).velocity - truth).norm());
                        fastest = fastest.max(truth.norm());
                    }
                }
            }
        }
        assert!(
            worst < bound && bound < 30.0 * worst && bound < 0.1 * fastest,
            "{ratio} {gap}: {worst:e} {bound:e} of {fastest}"
        );
    }
}

#[test]
fn velocity_and_pressure_are_continuous_up_to_the_surface() {
    let of = configuration(1.0, 0.2);
    let found = layers(2, &of);
    for n in directions(10) {
        let at = |height: f64| found.at(&(of.positions()[0] + n * (1.0 + height)));
        let (on, near) = (at(0.0), at(1e-5));
        assert!((on.velocity - near.velocity).norm() < 1e-3);
        assert!((on.pressure - near.pressure).abs() < 1e-2 * (1.0 + on.pressure.abs()));
    }
}

#[test]
fn the_flow_obeys_the_stokes_equations_and_its_gradient_is_that_of_the_velocity() {
    let of = pair(1.0, 0.2);
    let flow = Bem::new(2).unwrap().flow(&of).unwrap();
    let [one, two] = of.configuration.positions();
    let middle = one + of.configuration.line * 1.1 + Vector3::new(0.08, -0.06, 0.0);
    for x in [
        middle,
        one + Vector3::new(0.4, -1.0, 0.6),
        two + Vector3::new(2.0, 1.0, 0.0),
    ] {
        let step = 1e-3;
        let mut laplacian = flow.at(&x).velocity * -6.0;
        let mut slope = Vector3::zeros();
        let mut gradient = Matrix3::zeros();
        for k in 0..3 {
            let e = Vector3::ith(k, step);
            let (ahead, behind) = (flow.at(&(x + e)), flow.at(&(x - e)));
            laplacian += ahead.velocity + behind.velocity;
            slope[k] = (ahead.pressure - behind.pressure) / (2.0 * step);
            gradient.set_column(k, &((ahead.velocity - behind.velocity) / (2.0 * step)));
        }
        laplacian /= step * step;
        let found = flow.gradient(&x);
        assert_relative_eq!(found, gradient, epsilon = 2e-4 * (1.0 + found.norm()));
        assert!(
            found.trace().abs() < 1e-6 * (1.0 + found.norm()),
            "{}",
            found.trace()
        );
        assert_relative_eq!(laplacian, slope, epsilon = 5e-3 * (1.0 + slope.norm()));
    }
}

#[test]
fn val_lone_spheres_have_stokes_tractions_and_squirmers_their_closed_form() {
    let mut of = pair(1.0, 1e5);
    let flow = Bem::new(2).unwrap().flow(&of).unwrap();
    assert!(flow.error_estimate() < 1e-4);
    for k in [0, 1] {
        for n in directions(12) {
            let x = of.configuration.positions()[k] + n;
            let velocity = of.surface_velocity(k, &n);
            assert!((flow.at(&x).velocity - velocity).norm() < 1e-4);
            // From the other formula of the traction.
            let gradient = flow.gradient(&x);
            let stress =
                gradient + gradient.transpose() - Matrix3::identity() * flow.at(&x).pressure;
            assert_relative_eq!(flow.traction(k, &n), stress * n, epsilon = 1e-3);
        }
    }
    of.squirmers = [Squirmer::new(&[]).unwrap(); 2];
    let flow = Bem::new(2).unwrap().flow(&of).unwrap();
    for n in directions(12) {
        let expected = of.velocities[0] * -1.5 - of.angular_velocities[0].cross(&n) * 3.0;
        assert_relative_eq!(flow.traction(0, &n), expected, epsilon = 1e-4);
    }
}

#[test]
fn tractions_are_those_of_pressure_and_gradient_on_both_surfaces() {
    for (ratio, gap) in [(1.0, 0.3), (2.0, 0.5)] {
        let of = pair(ratio, gap);
        let flow = Bem::of_ratio(3, ratio).unwrap().flow(&of).unwrap();
        for k in [0, 1] {
            let mut worst: f64 = 0.0;
            for n in directions(30) {
                let x = of.configuration.positions()[k] + n * of.configuration.radii[k];
                let gradient = flow.gradient(&x);
                let stress =
                    gradient + gradient.transpose() - Matrix3::identity() * flow.at(&x).pressure;
                let traction = flow.traction(k, &n);
                worst = worst.max((traction - stress * n).norm() / (1.0 + traction.norm()));
            }
            assert!(worst < 0.05, "{ratio} {k}: {worst}");
        }
    }
}

#[test]
fn levels_differ_by_less_than_the_estimate_of_the_coarser_one() {
    let of = pair(1.0, 0.3);
    let [coarse, fine] = [1, 3].map(|level| Bem::new(level).unwrap().flow(&of).unwrap());
    let bound = coarse.error_estimate();
    let mut worst: f64 = 0.0;
    for n in directions(25) {
        for k in [0, 1] {
            let x = of.configuration.positions()[k] + n * 1.02;
            worst = worst.max((coarse.at(&x).velocity - fine.at(&x).velocity).norm());
        }
    }
    assert!(worst < bound, "{worst:e} {bound:e}");
    assert!(fine.error_estimate() < 0.3 * bound);
}

#[test]
fn a_pair_of_other_radii_is_refused() {
    let refused = Bem::new(1).unwrap().flow(&pair(2.0, 0.5));
    assert!(matches!(refused.err(), Some(SceneError::OtherRatio { .. })));
}
