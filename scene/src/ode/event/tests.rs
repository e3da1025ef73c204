use super::*;
use crate::ode::Stepper;
use crate::ode::dop853::tests::fixed;
use std::f64::consts::PI;

fn circle(_: f64, y: &[f64; 2]) -> [f64; 2] {
    [y[1], -y[0]]
}

/// One step of `sin t, cos t` from `t0` to `t1`.
fn one_step(t0: f64, t1: f64) -> Dense<2> {
    let step = fixed(&mut circle, t0, [t0.sin(), t0.cos()], t1 - t0);
    step.dense(&mut circle).unwrap()
}

fn sine(_: f64, y: &[f64; 2]) -> f64 {
    y[0]
}

/// Crossings over `0.1..end` (or back), each followed by a restart there.
fn crossings_of_sine(direction: Direction, zero: f64, t0: f64, end: f64) -> Vec<f64> {
    let mut stepper = Stepper::new(&mut circle, t0, [t0.sin(), t0.cos()], 1e-14, end).unwrap();
    let mut found = Vec::new();
    while (end - stepper.t()).abs() > 0.0 {
        let step = stepper.step(&mut circle, end).unwrap();
        let dense = step.dense(&mut circle).unwrap();
        if let Some(t) = first_crossing(&dense, sine, direction, zero) {
            found.push(t);
            stepper.restart_at(&mut circle, t, dense.at(t)).unwrap();
        }
    }
    found
}

fn assert_times(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (t, exact) in found.iter().zip(expected) {
        assert!((t - exact).abs() < 1e-12, "{t} is not {exact}");
    }
}

#[test]
fn zeros_of_the_sine_are_found_to_1e_12_and_only_once() {
    let up = [2.0 * PI, 4.0 * PI];
    let down = [PI, 3.0 * PI];
    let both = [PI, 2.0 * PI, 3.0 * PI, 4.0 * PI];
    for zero in [0.0, 1e-13] {
        assert_times(&crossings_of_sine(Direction::Rising, zero, 0.1, 13.0), &up);
        assert_times(
            &crossings_of_sine(Direction::Falling, zero, 0.1, 13.0),
            &down,
        );
        assert_times(
            &crossings_of_sine(Direction::Either, zero, 0.1, 13.0),
            &both,
        );
    }
}

#[test]
fn directions_follow_the_integration_backwards_in_time() {
    let found = crossings_of_sine(Direction::Rising, 0.0, 7.0, 1.0);
    assert_times(&found, &[PI]);
}

#[test]
fn a_start_at_zero_counts_as_crossed() {
    let found = crossings_of_sine(Direction::Either, 0.0, 0.0, 4.0);
    assert_times(&found, &[PI]);
}

#[test]
fn a_start_within_zero_counts_as_crossed() {
    let found = crossings_of_sine(Direction::Rising, 1e-9, -1e-10, 1.0);
    assert_times(&found, &[]);
    let found = crossings_of_sine(Direction::Rising, 1e-11, -1e-10, 1.0);
    assert_eq!(found.len(), 1);
}

#[test]
fn an_end_at_zero_counts_as_crossed() {
    let (dense, end) = (one_step(0.0, 0.5), 0.5);
    let to_end = |t: f64, _: &[f64; 2]| t - end;
    let found = first_crossing(&dense, to_end, Direction::Rising, 0.0);
    assert_eq!(found, Some(end));
    assert_eq!(
        first_crossing(&dense, to_end, Direction::Falling, 0.0),
        None
    );
}

#[test]
fn a_grazing_double_crossing_inside_one_step_is_found() {
    let dense = one_step(0.3, 1.1);
    // Dips of half-widths down to 1e-7 between and at the samples, and next to the ends.
    for half_width in [1e-2, 1e-4, 1e-6, 1e-7] {
        for i in 0..=100 {
            let centre = 0.3 + 1e-5 + (0.8 - 2e-5) * f64::from(i) / 100.0;
            let dip = |t: f64, _: &[f64; 2]| (t - centre).powi(2) - half_width * half_width;
            if centre - half_width <= 0.3 || centre + half_width >= 1.1 {
                continue;
            }
            for (direction, root) in [
                (Direction::Falling, centre - half_width),
                (Direction::Rising, centre + half_width),
                (Direction::Either, centre - half_width),
            ] {
                let t = first_crossing(&dense, dip, direction, 0.0).unwrap();
                // `g` itself is known to 1e-16 only, over a slope of twice the half-width.
                assert!((t - root).abs() < 1e-14 + 1e-16 / half_width, "{t} {root}");
            }
        }
    }
}

#[test]
fn a_near_miss_is_not_a_crossing() {
    let dense = one_step(0.3, 1.1);
    for i in 1..100 {
        let centre = 0.3 + 0.008 * f64::from(i);
        let miss = |t: f64, _: &[f64; 2]| (t - centre).powi(2) + 1e-12;
        assert_eq!(first_crossing(&dense, miss, Direction::Either, 0.0), None);
    }
}

#[test]
fn the_root_returned_is_on_the_far_side() {
    let dense = one_step(2.8, 3.3);
    let t = first_crossing(&dense, sine, Direction::Falling, 0.0).unwrap();
    assert!(dense.at(t)[0] <= 0.0);
    assert!(dense.at(t - 4.0 * f64::EPSILON * t)[0] > 0.0);
}

#[test]
fn the_minimum_of_the_sine_is_found() {
    let dense = one_step(4.65, 4.8);
    let t = first_minimum(&dense, sine).unwrap();
    approx::assert_abs_diff_eq!(t, 1.5 * PI, epsilon = 1e-7);
    approx::assert_abs_diff_eq!(dense.at(t)[0], -1.0, epsilon = 1e-12);
}

#[test]
fn a_step_without_an_interior_minimum_has_none() {
    let dense = one_step(1.2, 1.9);
    assert_eq!(first_minimum(&dense, sine), None);
    let dense = one_step(0.2, 0.9);
    assert_eq!(first_minimum(&dense, sine), None);
}

#[test]
fn minima_near_the_ends_of_a_step_are_found() {
    let dense = one_step(0.0, 0.5);
    for centre in [2e-6, 1e-3, 0.1, 0.25, 0.499, 0.5 - 2e-6] {
        let g = |t: f64, _: &[f64; 2]| (t - centre).powi(2);
        let t = first_minimum(&dense, g).unwrap();
        assert!((t - centre).abs() < 2e-8, "{t} is not {centre}");
    }
}

#[test]
fn roots_and_minima_cost_few_evaluations() {
    let count = std::cell::Cell::new(0);
    let counted = |t: f64, y: &[f64; 2]| {
        count.set(count.get() + 1);
        sine(t, y)
    };
    let dense = one_step(2.8, 3.3);
    first_crossing(&dense, counted, Direction::Either, 0.0).unwrap();
    let root = count.replace(0) - SAMPLES.len();
    let dense = one_step(4.5, 5.0);
    first_minimum(&dense, counted).unwrap();
    let minimum = count.get() - SAMPLES.len();
    assert!(root <= 12 && minimum <= 20, "{root} {minimum}");
}

#[test]
fn steep_flat_and_jumping_roots_are_closed_in() {
    let dense = one_step(0.3, 1.1);
    for i in 1..200 {
        let centre = 0.3 + 0.004 * f64::from(i);
        let shapes: [fn(f64) -> f64; 4] = [
            |x| (1e8 * x).tanh(),
            |x| x.powi(3),
            f64::signum,
            |x| if x < 0.0 { -1e-12 } else { 1e12 },
        ];
        for shape in shapes {
            let count = std::cell::Cell::new(0);
            let g = |t: f64, _: &[f64; 2]| {
                count.set(count.get() + 1);
                shape(t - centre)
            };
            let t = first_crossing(&dense, g, Direction::Rising, 0.0).unwrap();
            assert!(shape(t - centre) >= 0.0);
            assert!((t - centre).abs() < 2e-15, "{t} is not {centre}");
            assert!(count.get() <= SAMPLES.len() + 53, "{}", count.get());
        }
    }
}
