use super::*;
use crate::ode::tableau::{ROWS, STAGE_13, STAGE_14, STAGE_15};

/// Kepler orbit of eccentricity 0.1 with unit semi-major axis: period `2 pi`.
fn kepler(_: f64, y: &[f64; 4]) -> [f64; 4] {
    let cube = (y[0] * y[0] + y[1] * y[1]).powf(1.5);
    [y[2], y[3], -y[0] / cube, -y[1] / cube]
}
const PERIHELION: [f64; 4] = [0.9, 0.0, 0.0, 1.105_541_596_785_133_2];
const PERIOD: f64 = std::f64::consts::TAU;

fn distance<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    (a.iter().zip(b)).fold(0.0, |d, (a, b)| d.max((a - b).abs()))
}

fn integrate<S: System<N>, const N: usize>(
    system: &mut S,
    (t, t_end): (f64, f64),
    y: [f64; N],
    tol: f64,
) -> Stepper<N> {
    let mut stepper = Stepper::new(system, t, y, tol, t_end).unwrap();
    while (t_end - stepper.t()).abs() > 0.0 {
        stepper.step(system, t_end).unwrap();
    }
    stepper
}

/// One step of given length, whatever its error.
pub(in crate::ode) fn fixed<S: System<N>, const N: usize>(
    system: &mut S,
    t0: f64,
    y0: [f64; N],
    h: f64,
) -> Step<N> {
    let mut stepper = Stepper::new(system, t0, y0, 1e30, t0 + h).unwrap();
    stepper.h = h;
    stepper.step(system, t0 + h).unwrap()
}

/// Largest errors in equal steps, so many a Kepler period: after one period, and of the dense
/// output within the first step, against much tighter solutions.
fn kepler_errors(steps: u32) -> (f64, f64) {
    let h = PERIOD / f64::from(steps);
    let mut y = PERIHELION;
    for _ in 0..steps {
        y = fixed(&mut kepler, 0.0, y, h).y1;
    }
    let first = fixed(&mut kepler, 0.0, PERIHELION, h);
    let dense = first.dense(&mut kepler).unwrap();
    let inside = (1..10).map(|i| {
        let t = h * f64::from(i) / 10.0;
        let exact = integrate(&mut kepler, (0.0, t), PERIHELION, 1e-16);
        distance(&dense.at(t), exact.y())
    });
    (distance(&y, &PERIHELION), inside.fold(0.0, f64::max))
}

#[test]
fn a_kepler_orbit_converges_with_order_8() {
    let orders: Vec<f64> = [24, 28, 32]
        .map(|n| (kepler_errors(n).0 / kepler_errors(2 * n).0).log2())
        .to_vec();
    assert!(orders.iter().all(|p| (7.7..8.3).contains(p)), "{orders:?}");
}

#[test]
fn the_dense_output_has_order_7() {
    // One step: the local error of a method of order 7 falls as h^8.
    let orders: Vec<f64> = [16, 24, 32]
        .map(|n| (kepler_errors(n).1 / kepler_errors(2 * n).1).log2())
        .to_vec();
    assert!(orders.iter().all(|p| (7.7..8.3).contains(p)), "{orders:?}");
}

#[test]
fn the_dense_output_meets_the_ends_and_their_slopes() {
    let step = fixed(&mut kepler, 0.5, PERIHELION, 0.1);
    let dense = step.dense(&mut kepler).unwrap();
    assert!(distance(&dense.at(step.t0), &step.y0) <= 0.0);
    assert!(distance(&dense.at(step.t1), &step.y1) < 1e-15);
    let d = 1e-6;
    for (t, dy) in [(step.t0, step.dy0), (step.t1, step.dy1)] {
        let (after, before) = (dense.at(t + d), dense.at(t - d));
        let slope = std::array::from_fn(|i| (after[i] - before[i]) / (2.0 * d));
        assert!(distance(&slope, &dy) < 1e-9);
    }
}

#[test]
fn the_tableau_meets_the_quadrature_conditions() {
    let steps = ROWS.iter().map(|row| (row.c, row.a.iter().sum()));
    let dense = [STAGE_13, STAGE_14, STAGE_15].map(|s| (s.c, s.a.iter().map(|(_, a)| a).sum()));
    for (time, sum) in steps.chain(dense) {
        let sum: f64 = sum;
        approx::assert_abs_diff_eq!(sum, time, epsilon = 2e-14);
    }
    for power in 0..8 {
        // dy/dt = (p + 1) t^p is integrated exactly.
        let mut monomial = |t: f64, _: &[f64; 1]| [f64::from(power + 1) * t.powi(power)];
        let step = fixed(&mut monomial, 0.0, [0.0], 1.0);
        approx::assert_abs_diff_eq!(step.y1[0], 1.0, epsilon = 2e-15);
        if power < 7 {
            let dense = step.dense(&mut monomial).unwrap();
            let exact = 0.3f64.powi(power + 1);
            approx::assert_abs_diff_eq!(dense.at(0.3)[0], exact, epsilon = 2e-14);
        }
    }
}

/// From `(0.5, 1)` at `t = 0` with a first step of 0.4: its end and a point inside by the same tableau in
/// 40 digits, the error by SciPy 1.17.1, `DOP853`.
#[test]
fn val_one_step_of_a_driven_pendulum_agrees_with_40_digits_and_with_scipy() {
    // Three roundings of each product, of which h times the sum of |b k| is 6, and 16 for the point inside.
    const ROUNDING: f64 = 3.0 * 0.5 * f64::EPSILON;
    let mut pendulum = |t: f64, y: &[f64; 2]| [y[1], t.cos() - y[0].sin()];
    let step = fixed(&mut pendulum, 0.0, [0.5, 1.0], 0.4);
    let expected = [0.931_458_011_940_626_4, 1.130_305_429_435_399_5];
    assert!(distance(&step.y1, &expected) < 6.0 * ROUNDING);
    let inside = step.dense(&mut pendulum).unwrap().at(0.13);
    let expected = [0.634_066_638_797_950_3, 1.059_930_503_122_819_7];
    assert!(distance(&inside, &expected) < 16.0 * ROUNDING);
    let error = step.error(0.4, 1e-3);
    // The estimate is what is left of products as large as those of the step.
    let rounding = 6.0 * ROUNDING / (1e-3 * error);
    approx::assert_relative_eq!(error, 1.847_681_825_181_316e-6, max_relative = rounding);
}

/// Restricted three-body problem, Hairer, Norsett & Wanner (II.0.1), mass ratio of the Moon.
fn arenstorf(_: f64, y: &[f64; 4]) -> [f64; 4] {
    let (moon, earth) = (0.012_277_471, 1.0 - 0.012_277_471);
    let to_earth = ((y[0] + moon).powi(2) + y[1].powi(2)).powf(1.5);
    let to_moon = ((y[0] - earth).powi(2) + y[1].powi(2)).powf(1.5);
    [
        y[2],
        y[3],
        y[0] + 2.0 * y[3] - earth * (y[0] + moon) / to_earth - moon * (y[0] - earth) / to_moon,
        y[1] - 2.0 * y[2] - earth * y[1] / to_earth - moon * y[1] / to_moon,
    ]
}
const ARENSTORF: [f64; 4] = [0.994, 0.0, 0.0, -2.001_585_106_379_082_5];

/// Period 17.0652165601579625588917206249, Hairer, Norsett & Wanner (II.0.2).
#[test]
fn the_arenstorf_orbit_returns_after_its_published_period() {
    let period = 17.065_216_560_157_964;
    let orbit = integrate(&mut arenstorf, (0.0, period), ARENSTORF, 1e-13);
    let back = distance(orbit.y(), &ARENSTORF);
    assert!(back < 1e-7, "{back:e} {orbit:?}");
    let moon_side = (orbit.y()[0] - ARENSTORF[0]).abs() + orbit.y()[1].abs();
    assert!(moon_side < 1e-9, "{moon_side:e}");
}

/// SciPy 1.17.1, `solve_ivp` with `DOP853`, `rtol = atol = 1e-13`.
#[test]
fn the_arenstorf_orbit_agrees_with_scipy_before_its_return() {
    let orbit = integrate(&mut arenstorf, (0.0, 8.0), ARENSTORF, 1e-13);
    let expected = [
        -1.174_553_507_277_498_6,
        -0.275_945_077_013_635_2,
        -0.253_170_749_968_332_4,
        0.447_376_747_860_520_95,
    ];
    assert!(distance(orbit.y(), &expected) < 1e-9);
}

#[test]
fn the_error_is_proportional_to_the_tolerance() {
    for exponent in 4..=13 {
        let tol = 10f64.powi(-exponent);
        let orbit = integrate(&mut kepler, (0.0, 3.0 * PERIOD), PERIHELION, tol);
        let ratio = distance(orbit.y(), &PERIHELION) / tol;
        assert!((10.0..100.0).contains(&ratio), "{ratio} at {tol:e}");
    }
}

#[test]
fn integration_there_and_back_returns() {
    let there = integrate(&mut kepler, (0.0, 5.0), PERIHELION, 1e-13);
    let back = integrate(&mut kepler, (5.0, 0.0), *there.y(), 1e-13);
    assert!(distance(back.y(), &PERIHELION) < 1e-11);
}

#[test]
fn the_end_is_hit_exactly_and_never_passed() {
    let (mut latest, t_end) = (0.0f64, 0.1 + 0.2 + 3.0);
    let mut decay = |t: f64, y: &[f64; 1]| {
        latest = latest.max(t);
        [-y[0]]
    };
    let end = integrate(&mut decay, (0.0, t_end), [1.0], 1e-10);
    assert_eq!(end.t().to_bits(), t_end.to_bits());
    assert!(latest <= t_end);
    approx::assert_relative_eq!(end.y()[0], (-t_end).exp(), max_relative = 1e-9);
}

#[test]
fn an_end_closer_than_the_resolution_of_time_is_reached() {
    let mut decay = |_: f64, y: &[f64; 1]| [-y[0]];
    let mut stepper = Stepper::new(&mut decay, 1.0, [1.0], 1e-10, 2.0).unwrap();
    let h = stepper.h();
    let next = 1.0f64.next_up();
    stepper.step(&mut decay, next).unwrap();
    assert_eq!(stepper.t().to_bits(), next.to_bits());
    assert!(
        stepper.h() >= h,
        "a step cut short must not shorten the next"
    );
}

#[test]
fn a_step_at_the_end_is_an_error() {
    let mut decay = |_: f64, y: &[f64; 1]| [-y[0]];
    let mut stepper = Stepper::new(&mut decay, 1.0, [1.0], 1e-10, 2.0).unwrap();
    let nothing = OdeError::EmptyInterval { t: 1.0, t_end: 1.0 };
    assert_eq!(stepper.step(&mut decay, 1.0).unwrap_err(), nothing);
    assert!(stepper.step(&mut decay, f64::NAN).is_err());
}

#[test]
fn a_system_that_is_nan_ahead_is_approached_by_shorter_steps() {
    // y = (1 - t)^2 has y' = -2 sqrt y, NaN for y < 0: a long step falls off the domain.
    let mut root = |_: f64, y: &[f64; 1]| [-2.0 * y[0].sqrt()];
    let mut stepper = Stepper::new(&mut root, 0.0, [1.0], 1e-8, 0.99).unwrap();
    stepper.h = 100.0;
    while stepper.t() < 0.99 {
        stepper.h = stepper.h.max(0.5);
        stepper.step(&mut root, 0.99).unwrap();
    }
    assert!(stepper.rejected() > 0);
    approx::assert_abs_diff_eq!(stepper.y()[0], 1e-4, epsilon = 1e-7);
}

#[test]
fn a_step_into_nan_is_cut_to_a_fifth() {
    let mut wall = |t: f64, _: &[f64; 1]| [if t > 0.3 { f64::NAN } else { 1.0 }];
    let mut stepper = Stepper::new(&mut wall, 0.0, [0.0], 1e-8, 10.0).unwrap();
    stepper.h = 1.0;
    let step = stepper.step(&mut wall, 10.0).unwrap();
    approx::assert_abs_diff_eq!(step.t1, 0.2, epsilon = 1e-15);
    approx::assert_abs_diff_eq!(stepper.h(), 0.2, epsilon = 1e-15);
    assert_eq!((stepper.accepted(), stepper.rejected()), (1, 1));
}

#[test]
fn a_wall_of_nan_makes_the_step_too_small() {
    let mut wall = |t: f64, _: &[f64; 1]| [if t > 1.0 { f64::NAN } else { 1.0 }];
    let mut stepper = Stepper::new(&mut wall, 0.0, [0.0], 1e-8, 2.0).unwrap();
    let error = loop {
        if let Err(error) = stepper.step(&mut wall, 2.0) {
            break error;
        }
    };
    assert!(
        matches!(error, OdeError::StepTooSmall { t, h } if (1.0 - t).abs() < 1e-12 && h < 1e-14),
        "{error}"
    );
    assert!(stepper.y()[0].is_finite());
}

#[test]
fn a_start_that_is_not_finite_and_a_bad_tolerance_are_refused() {
    let mut decay = |_: f64, y: &[f64; 1]| [-y[0]];
    for (y, tol) in [(f64::NAN, 1e-8), (1.0, 0.0), (1.0, f64::NAN)] {
        assert!(Stepper::new(&mut decay, 0.0, [y], tol, 1.0).is_err());
    }
}

#[test]
fn too_many_steps_are_an_error() {
    let mut stepper = Stepper::new(&mut kepler, 0.0, PERIHELION, 1e-12, 100.0)
        .unwrap()
        .with_max_steps(3);
    for _ in 0..3 - stepper.rejected() {
        stepper.step(&mut kepler, 100.0).unwrap();
    }
    let error = stepper.step(&mut kepler, 100.0).unwrap_err();
    assert!(
        matches!(error, OdeError::TooManySteps { steps: 3, .. }),
        "{error}"
    );
}

#[test]
fn counters_count() {
    let mut calls = 0;
    let mut counted = |t: f64, y: &[f64; 4]| {
        calls += 1;
        arenstorf(t, y)
    };
    let orbit = integrate(&mut counted, (0.0, 17.0), ARENSTORF, 1e-7);
    assert_eq!(calls, orbit.evaluations());
    assert!(orbit.rejected() > 0);
    // Two to start, twelve a step, eleven a rejection.
    let expected = 2 + 12 * orbit.accepted() + 11 * orbit.rejected();
    assert_eq!(orbit.evaluations(), expected);
}

#[test]
fn the_dense_output_costs_three_evaluations() {
    let mut calls = 0;
    let mut counted = |t: f64, y: &[f64; 4]| {
        calls += 1;
        kepler(t, y)
    };
    let step = fixed(&mut kepler, 0.0, PERIHELION, 0.1);
    step.dense(&mut counted).unwrap();
    assert_eq!(calls, 3);
}

#[test]
fn a_restart_replaces_the_derivative_and_keeps_the_step() {
    let mut stepper = Stepper::new(&mut kepler, 0.0, PERIHELION, 1e-10, 1.0).unwrap();
    stepper.step(&mut kepler, 1.0).unwrap();
    let h = stepper.h();
    let turned = [1.0, 0.5, 0.0, -1.0];
    stepper.restart_at(&mut kepler, 0.25, turned).unwrap();
    assert_eq!(stepper.h().to_bits(), h.to_bits());
    assert_eq!((stepper.t(), *stepper.y()), (0.25, turned));
    assert!(distance(stepper.dy(), &kepler(0.25, &turned)) <= 0.0);
    let nowhere = stepper.restart_at(&mut kepler, 0.5, [0.0; 4]);
    assert_eq!(nowhere, Err(OdeError::NotFinite { t: 0.5 }));
    assert_eq!((stepper.t(), *stepper.y()), (0.25, turned));
}

#[test]
fn the_same_run_gives_the_same_bits() {
    let run = || integrate(&mut arenstorf, (0.0, 17.0), ARENSTORF, 1e-9);
    let (one, two) = (run(), run());
    assert_eq!(one.y().map(f64::to_bits), two.y().map(f64::to_bits));
    assert_eq!(one.h().to_bits(), two.h().to_bits());
    assert_eq!(one.evaluations(), two.evaluations());
}

#[test]
fn a_state_at_rest_takes_growing_steps() {
    let mut rest = |_: f64, _: &[f64; 2]| [0.0; 2];
    let end = integrate(&mut rest, (0.0, 1e6), [1.0, 0.0], 1e-9);
    assert!(end.accepted() < 30);
    assert!(distance(end.y(), &[1.0, 0.0]) <= 0.0);
}
