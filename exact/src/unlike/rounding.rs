//! Numbers close to 1 whose digits beyond the last are kept on the average over the degrees.
//!
//! On a large sphere `cosh(alpha) - 1` is as small as 1e-8, and it is what the equations hang on: neighbouring degrees nearly cancel.
//! Rounded the same way in every degree, `cosh(alpha)` would be that of another sphere, in the eighth digit. So it is rounded up in
//! as many degrees, evenly spread, as its remainder says. Solutions are smooth in the degree, and take its mean.

/// A number `1 + excess`.
#[derive(Clone, Copy, Debug)]
pub struct NearOne {
    below: f64,
    /// What is left of the number, in units of the last place.
    remainder: f64,
}

impl NearOne {
    /// `1 + excess`, for a positive excess.
    pub fn new(excess: f64) -> Self {
        let nearest = 1.0 + excess;
        if nearest >= 2.0 {
            return Self {
                below: nearest,
                remainder: 0.0,
            };
        }
        let left = (excess - (nearest - 1.0)) / f64::EPSILON;
        if left < 0.0 {
            Self {
                below: nearest - f64::EPSILON,
                remainder: 1.0 + left,
            }
        } else {
            Self {
                below: nearest,
                remainder: left,
            }
        }
    }

    /// The number as it is rounded in degree `n`.
    pub fn at(self, n: usize) -> f64 {
        let n = n as f64;
        let up = (self.remainder * (n + 1.0)).floor() > (self.remainder * n).floor();
        self.below + if up { f64::EPSILON } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_over_the_degrees_has_the_digits_that_rounding_cuts() {
        for excess in [1.2345e-8, 1.7e-5, 7e-17] {
            let number = NearOne::new(excess);
            let count: u16 = 1 << 12;
            let errors = (0..count).map(|n| (number.at(n.into()) - 1.0) - excess);
            let mean = errors.sum::<f64>() / f64::from(count);
            let one_roundings_share = f64::EPSILON / f64::from(count);
            assert!(mean.abs() < 2.0 * one_roundings_share, "{mean:e}");
        }
    }
}
