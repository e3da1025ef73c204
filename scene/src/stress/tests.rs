use super::*;
use crate::{Configuration, Squirmer};

pub(super) fn pair() -> MovingPair {
    let line = Vector3::new(0.36, 0.48, -0.8);
    let squirmer =
        |modes: &[f64], swirl: &[f64]| Squirmer::new(modes).unwrap().with_swirl(swirl).unwrap();
    MovingPair {
        squirmers: [
            squirmer(&[1.5, -2.0, 0.7, 0.4], &[0.3, 0.8, -0.5]),
            squirmer(&[0.9, 1.1, -0.6, 0.2], &[0.1, -0.4, 0.9]),
        ],
        configuration: Configuration {
            radii: [1.0, 1.0],
            gap: Gap::new(0.3).unwrap(),
            midpoint: Vector3::zeros(),
            line,
            orientations: [Vector3::new(0.6, 0.0, 0.8), Vector3::new(-0.48, 0.64, 0.6)],
            line_angle_rad: 0.0,
            angles_rad: [0.0; 2],
        },
        velocities: [Vector3::new(0.1, -0.5, 0.3), Vector3::new(0.7, 0.2, -0.4)],
        angular_velocities: [Vector3::new(-0.2, 0.6, 0.1), Vector3::new(0.3, 0.5, 0.9)],
        forces: Default::default(),
        torques: Default::default(),
    }
}

/// `Σ_m Re[A_m conj(s^m)] P_n^(m)(x)` of the squirming mode `n`.
fn summed(pair: &MovingPair, sphere: usize, n: usize, normal: &Vector3<f64>) -> f64 {
    let axes = Axes::of(pair);
    let s = axes.across(normal);
    let x = normal.dot(&axes.towards_other(sphere));
    (0..=n)
        .map(|m| {
            let block = Block::Order(m);
            let causes = block.causes(n, 0);
            let index = causes
                .iter()
                .position(|c| *c == Cause::Squirming(n))
                .unwrap();
            let all = amplitudes(pair, &axes, block, &causes);
            let amplitude = all[sphere * causes.len() + index];
            (amplitude * s.powu(m as u32).conj()).re * legendre_derivative(n, m, x)
        })
        .sum()
}

#[test]
fn amplitudes_of_all_orders_add_up_to_the_slip_potential() {
    let pair = pair();
    let normal = Vector3::new(2.0, -1.0, 2.0) / 3.0;
    for sphere in [0, 1] {
        for n in 1..=4 {
            let c = pair.configuration.orientations[sphere].dot(&normal);
            let whole = pair.squirmers[sphere].mode(n - 1) * legendre_derivative(n, 0, c);
            let found = summed(&pair, sphere, n, &normal);
            assert!(
                (found - whole).abs() < 1e-13,
                "{sphere} {n}: {found} {whole}"
            );
        }
    }
}

#[test]
fn spin_and_swirl_of_the_first_mode_are_one_cause() {
    // C_1 p x n is the velocity of a spin C_1 p; across the line, `omega x d` and `d x p` have opposite signs.
    let mut pair = pair();
    for k in [0, 1] {
        let strength = pair.squirmers[k].swirl()[0];
        pair.angular_velocities[k] = pair.configuration.orientations[k] * strength;
    }
    let axes = Axes::of(&pair);
    for (block, spin, swirl, sign) in [(Block::Twist, 0, 1, 1.0), (Block::Order(1), 1, 6, -1.0)] {
        let causes = block.causes(4, 1);
        assert_eq!(
            (causes[spin], causes[swirl]),
            (Cause::Rotation, Cause::Swirl(1))
        );
        let all = amplitudes(&pair, &axes, block, &causes);
        for sphere in [0, 1] {
            let of = |index: usize| all[sphere * causes.len() + index];
            assert!(
                (of(spin) - of(swirl) * sign).norm() < 1e-14,
                "{block:?} {sphere}"
            );
        }
    }
}

#[test]
fn the_lone_stresslet_is_the_sum_of_its_three_orders() {
    let pair = pair();
    let axes = Axes::of(&pair);
    for sphere in [0, 1] {
        let mut sum = Matrix3::zeros();
        // Per amplitude: 4 pi of orders 0 and 1; order 2 has P_2'' 2/4! = 1/4 of p^2.
        for (order, scale) in [(0, 4.0), (1, 4.0), (2, 8.0)] {
            let block = Block::Order(order);
            let causes = block.causes(2, 0);
            let index = causes
                .iter()
                .position(|c| *c == Cause::Squirming(2))
                .unwrap();
            let all = amplitudes(&pair, &axes, block, &causes);
            let amplitude = all[sphere * causes.len() + index];
            let scale = scale * std::f64::consts::PI;
            sum += axes.stresslet(sphere, order, amplitude * scale);
        }
        assert!((sum - lone_stresslet(&pair, sphere)).norm() < 1e-13);
    }
}
