//! Events inside a step: where a scalar `g(t, y)` changes sign, and where it is smallest.
//!
//! `g` is sampled over the step by the dense output, at its ends by the states themselves, so that
//! two neighbouring steps see the same value. Samples that turn towards zero are followed to their
//! extremum, so that a crossing and its return between two samples are both found. Roots are then
//! bracketed and closed in by ITP: I. F. D. Oliveira & R. H. C. Takahashi, ACM Trans. Math. Softw.
//! 47 (2020) 5; minima by golden section with parabolas: R. P. Brent, *Algorithms for Minimization
//! without Derivatives*, 1973, ch. 5.

use super::Dense;

/// Samples as fractions of the step: eight Chebyshev nodes inside, the ends, and a probe next to
/// each end that tells the slope there.
const SAMPLES: [f64; 12] = [
    0.0,
    1e-6,
    0.030_153_689_607_045_8,
    0.116_977_778_440_511,
    0.25,
    0.413_175_911_166_535,
    0.586_824_088_833_465,
    0.75,
    0.883_022_221_559_489,
    0.969_846_310_392_954,
    1.0 - 1e-6,
    1.0,
];

/// Width of the final bracket of a root, as a fraction of the step; less than the resolution of
/// time for steps shorter than the time itself, which is then the limit.
const ROOT_WIDTH: f64 = 4.0 * f64::EPSILON;

/// Width of the final bracket of a minimum as a fraction of the step, near the square root of the
/// rounding unit: closer in, `g` does not change.
const MINIMUM_WIDTH: f64 = 1e-8;

/// Iterations allowed to either search; ITP on a unit bracket needs at most 53.
const MAX_ITERATIONS: usize = 100;

/// Which crossings of zero count.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Direction {
    /// From negative to positive, in the direction of integration.
    Rising,
    /// From positive to negative, in the direction of integration.
    Falling,
    /// Both.
    Either,
}

impl Direction {
    /// Whether leaving the side `sign` of zero counts.
    fn leaves(self, sign: f64) -> bool {
        match self {
            Self::Rising => sign < 0.0,
            Self::Falling => sign > 0.0,
            Self::Either => true,
        }
    }
}

/// Time of the first crossing of zero by `g` over the step, none if there is none.
///
/// Values with `|g| <= zero` count as zero. A start at zero counts as already crossed, an end at
/// zero as crossed now; hence no crossing is reported twice or missed between two steps. The time
/// returned is on the far side of the root, within the rounding of time, so that a restart there
/// does not find it again even with `zero = 0`; give a positive `zero` if the state is changed at
/// the restart. Touching zero counts as crossing it.
///
/// ```
/// use scene::ode::{Direction, OdeError, Stepper, first_crossing};
/// let mut fall = |_: f64, y: &[f64; 2]| [y[1], -9.81];
/// let mut stepper = Stepper::new(&mut fall, 0.0, [1.0, 0.0], 1e-10, 1.0)?;
/// let mut landing = None;
/// while landing.is_none() {
///     let dense = stepper.step(&mut fall, 1.0)?.dense(&mut fall)?;
///     landing = first_crossing(&dense, |_, y| y[0], Direction::Falling, 0.0);
/// }
/// assert!(landing.is_some_and(|t| (t - (2.0f64 / 9.81).sqrt()).abs() < 1e-12));
/// # Ok::<(), OdeError>(())
/// ```
pub fn first_crossing<const N: usize>(
    dense: &Dense<N>,
    g: impl Fn(f64, &[f64; N]) -> f64,
    direction: Direction,
    zero: f64,
) -> Option<f64> {
    let over = Over { dense, g };
    let side_of = |point: Point| {
        if point.1.abs() <= zero {
            0.0
        } else {
            point.1.signum()
        }
    };
    let samples = over.samples();
    let mut left = samples[0];
    let mut crossing_up_to = |right: Point| {
        let from = std::mem::replace(&mut left, right);
        let side = side_of(from);
        let crosses = side.abs() > 0.0 && side * side_of(right) <= 0.0 && direction.leaves(side);
        crosses.then(|| over.time(over.root(from, right)))
    };
    for of in samples.windows(3) {
        // A sample that turns towards zero may hide a crossing and its return on either side.
        let side = side_of(of[1]);
        let hidden = turns(side, of)
            .then(|| over.minimum(side, of))
            .filter(|&extremum| side * side_of(extremum) <= 0.0);
        let (first, second) = match hidden {
            Some(extremum) if extremum.0 < of[1].0 => (extremum, Some(of[1])),
            later => (of[1], later),
        };
        let found = crossing_up_to(first).or_else(|| second.and_then(&mut crossing_up_to));
        if found.is_some() {
            return found;
        }
    }
    crossing_up_to(samples[SAMPLES.len() - 1])
}

/// Time of the first local minimum of `g` inside the step, none if there is none.
///
/// The time is as precise as the values of `g` can tell, about `1e-8` of the step, and the minimal
/// value to rounding; a sharper time is that of the crossing of `dg/dt`. A minimum within `1e-6` of
/// the step from one of its ends may be left to the value of `g` at that end, which is then larger
/// by `1e-12` of the step squared times the curvature: a smallest value over a trajectory is the
/// smallest over the minima and over the ends. Where `g` is constant to rounding, the time found is
/// arbitrary.
pub fn first_minimum<const N: usize>(
    dense: &Dense<N>,
    g: impl Fn(f64, &[f64; N]) -> f64,
) -> Option<f64> {
    let over = Over { dense, g };
    (over.samples().windows(3))
        .find(|of| turns(1.0, of))
        .map(|of| over.time(over.minimum(1.0, of).0))
}

/// A point of the graph of `g`: fraction of the step, value.
type Point = (f64, f64);

/// Whether `sign g` is smallest at the centre of three points.
fn turns(sign: f64, of: &[Point]) -> bool {
    sign * of[1].1 < sign * of[0].1 && sign * of[1].1 <= sign * of[2].1
}

/// `g` as a function of the fraction of a step.
struct Over<'a, const N: usize, G> {
    dense: &'a Dense<N>,
    g: G,
}

impl<const N: usize, G: Fn(f64, &[f64; N]) -> f64> Over<'_, N, G> {
    fn time(&self, x: f64) -> f64 {
        let Dense { t0, t1, .. } = *self.dense;
        if x >= 1.0 { t1 } else { t0 + x * (t1 - t0) }
    }

    fn value(&self, x: f64) -> f64 {
        if x <= 0.0 {
            (self.g)(self.dense.t0, &self.dense.y0)
        } else if x >= 1.0 {
            (self.g)(self.dense.t1, &self.dense.y1)
        } else {
            let t = self.time(x);
            (self.g)(t, &self.dense.at(t))
        }
    }

    fn samples(&self) -> [Point; SAMPLES.len()] {
        SAMPLES.map(|x| (x, self.value(x)))
    }

    /// Far end of a bracket of the root between `a` and `b`, `a.0 < b.0`; `b.0` if the values do
    /// not differ in sign.
    fn root(&self, mut a: Point, mut b: Point) -> f64 {
        let side = a.1.signum();
        if side * b.1 > 0.0 {
            return b.0;
        }
        let resolution = 2.0 * f64::EPSILON * self.dense.t0.abs().max(self.dense.t1.abs())
            / (self.dense.t1 - self.dense.t0).abs();
        let tolerance = 0.5 * ROOT_WIDTH.max(resolution);
        let width = b.0 - a.0;
        // What bisection needs, with one halving more that the secants may waste.
        let mut budget = 2.0 * tolerance;
        while budget < width {
            budget *= 2.0;
        }
        for _ in 0..MAX_ITERATIONS {
            if b.0 - a.0 <= 2.0 * tolerance {
                break;
            }
            let half = 0.5 * (a.0 + b.0);
            let secant = (b.1 * a.0 - a.1 * b.0) / (b.1 - a.1);
            let towards = (half - secant).signum();
            let push = (0.2 / width * (b.0 - a.0).powi(2)).max(tolerance);
            let pushed = if push <= (half - secant).abs() {
                secant + towards * push
            } else {
                half
            };
            let reach = budget - 0.5 * (b.0 - a.0);
            let x = if (pushed - half).abs() <= reach {
                pushed
            } else {
                half - towards * reach.max(0.0)
            };
            let value = self.value(x);
            if side * value > 0.0 {
                a = (x, value);
            } else {
                b = (x, value);
            }
            budget *= 0.5;
        }
        b.0
    }

    /// Minimum of `sign g` from three points that bracket it, with the raw value of `g`.
    fn minimum(&self, sign: f64, of: &[Point]) -> Point {
        /// Smaller part of a golden section, `(3 - sqrt 5)/2`.
        const GOLDEN: f64 = 0.381_966_011_250_105;
        let (mut low, mut high) = (of[0].0, of[2].0);
        let mut best = of[1];
        let (mut second, mut third) = if sign * of[0].1 < sign * of[2].1 {
            (of[0], of[2])
        } else {
            (of[2], of[0])
        };
        let (mut step, mut step_before) = (high - low, high - low);
        for _ in 0..MAX_ITERATIONS {
            let half = 0.5 * (low + high);
            if (best.0 - half).abs() + 0.5 * (high - low) <= 2.0 * MINIMUM_WIDTH {
                break;
            }
            let r = (best.0 - second.0) * (best.1 - third.1);
            let q = (best.0 - third.0) * (best.1 - second.1);
            let p = (best.0 - third.0) * q - (best.0 - second.0) * r;
            let parabola = -p / (2.0 * (q - r));
            let to = best.0 + parabola;
            let trusted = parabola.abs() < 0.5 * step_before.abs() && to > low && to < high;
            step_before = step;
            step = if trusted {
                if to - low < 2.0 * MINIMUM_WIDTH || high - to < 2.0 * MINIMUM_WIDTH {
                    MINIMUM_WIDTH.copysign(half - best.0)
                } else {
                    parabola
                }
            } else {
                step_before = if best.0 >= half {
                    low - best.0
                } else {
                    high - best.0
                };
                GOLDEN * step_before
            };
            let x = best.0 + step.abs().max(MINIMUM_WIDTH).copysign(step);
            let next = (x, self.value(x));
            if sign * next.1 <= sign * best.1 {
                if x >= best.0 {
                    low = best.0;
                } else {
                    high = best.0;
                }
                (third, second, best) = (second, best, next);
            } else {
                if x < best.0 {
                    low = x;
                } else {
                    high = x;
                }
                if sign * next.1 <= sign * second.1 {
                    (third, second) = (second, next);
                } else if sign * next.1 <= sign * third.1 {
                    third = next;
                }
            }
        }
        best
    }
}

#[cfg(test)]
mod tests {
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
}
