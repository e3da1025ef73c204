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
mod tests;
