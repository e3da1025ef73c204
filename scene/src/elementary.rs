//! Sine, cosine and exponential as a right-hand side takes them: inlined, without a call to the system's mathematical library.
//!
//! They took half of the instructions of a tabulated right-hand side. The polynomials of the sines and the reductions are those of fdlibm (Sun
//! Microsystems, 1993), within two units in the last place on the arguments that occur; all others go to the standard library. With it
//! the same bits come out on every machine.

use std::ops::{Add, Mul, Sub};

use wide::{f64x2, u64x2};

/// Largest argument of the sines whose reduction is exact.
const LARGEST_ANGLE: f64 = 1e5;

/// Largest argument of the exponential whose scale is a normal number.
const LARGEST_EXPONENT: f64 = 700.0;

/// Added and subtracted, it rounds to the nearest integer, which its lowest bits then hold.
const ROUND: f64 = 6_755_399_441_055_744.0;

/// A number, or two of them side by side.
trait Lanes: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    /// The same number in each.
    fn all(x: f64) -> Self;
    /// Sine and cosine of an angle, from those of what is left of it beyond so many quarters of a turn, given as [`ROUND`] plus
    /// their number.
    fn turned(sin: Self, cos: Self, shifted: Self) -> (Self, Self);
}

impl Lanes for f64 {
    #[inline(always)]
    fn all(x: f64) -> Self {
        x
    }

    #[inline(always)]
    fn turned(sin: Self, cos: Self, shifted: Self) -> (Self, Self) {
        let number = shifted.to_bits();
        let (a, b) = if number & 1 == 0 {
            (sin, cos)
        } else {
            (cos, sin)
        };
        let signed = |x: f64, quarter: u64| f64::from_bits(x.to_bits() ^ ((quarter & 2) << 62));
        (signed(a, number), signed(b, number.wrapping_add(1)))
    }
}

impl Lanes for f64x2 {
    #[inline(always)]
    fn all(x: f64) -> Self {
        Self::splat(x)
    }

    #[inline(always)]
    fn turned(sin: Self, cos: Self, shifted: Self) -> (Self, Self) {
        let (one, two) = (u64x2::splat(1), u64x2::splat(2));
        let number = shifted.to_bits();
        let odd = u64x2::splat(0) - (number & one);
        let (sin, cos) = (sin.to_bits(), cos.to_bits());
        let swapped = (sin ^ cos) & odd;
        let signed = |x: u64x2, quarter: u64x2| Self::from_bits(x ^ ((quarter & two) << 62_u32));
        (
            signed(sin ^ swapped, number),
            signed(cos ^ swapped, number + one),
        )
    }
}

/// Sine and cosine of an angle in radians.
#[inline(always)]
#[must_use]
pub fn sin_cos(x: f64) -> (f64, f64) {
    // NaN goes on too.
    if x.abs() <= LARGEST_ANGLE {
        reduced_sin_cos(x)
    } else {
        library_sin_cos(x)
    }
}

/// [`sin_cos`] of two angles at a time, with the same bits.
#[inline(always)]
#[must_use]
pub fn sines_cosines([x, y]: [f64; 2]) -> [(f64, f64); 2] {
    if (x.abs() <= LARGEST_ANGLE) & (y.abs() <= LARGEST_ANGLE) {
        let (sin, cos) = reduced_sin_cos(f64x2::from([x, y]));
        let ([s, t], [c, d]) = (sin.to_array(), cos.to_array());
        [(s, c), (t, d)]
    } else {
        [sin_cos(x), sin_cos(y)]
    }
}

#[cold]
#[inline(never)]
fn library_sin_cos(x: f64) -> (f64, f64) {
    x.sin_cos()
}

#[inline(always)]
fn reduced_sin_cos<T: Lanes>(x: T) -> (T, T) {
    // pi/2 in two parts, the first of 33 bits.
    const QUARTER: [f64; 2] = [1.570_796_326_734_125_6, 6.077_100_506_506_192e-11];
    const SIN: [f64; 6] = [
        -1.666_666_666_666_663_2e-1,
        8.333_333_333_322_49e-3,
        -1.984_126_982_985_795e-4,
        2.755_731_370_707_006_8e-6,
        -2.505_076_025_340_686_3e-8,
        1.589_690_995_211_55e-10,
    ];
    const COS: [f64; 6] = [
        4.166_666_666_666_66e-2,
        -1.388_888_888_887_411e-3,
        2.480_158_728_947_673e-5,
        -2.755_731_435_139_066_3e-7,
        2.087_572_321_298_175e-9,
        -1.135_964_755_778_819_5e-11,
    ];
    let shifted = x * T::all(std::f64::consts::FRAC_2_PI) + T::all(ROUND);
    let quarters = shifted - T::all(ROUND);
    let r = (x - quarters * T::all(QUARTER[0])) - quarters * T::all(QUARTER[1]);
    let z = r * r;
    let sin = r + r * z * polynomial(&SIN, z);
    let cos = T::all(1.0) - z * (T::all(0.5) - z * polynomial(&COS, z));
    T::turned(sin, cos, shifted)
}

/// The exponential.
#[inline(always)]
#[must_use]
pub fn exp(x: f64) -> f64 {
    if x.abs() <= LARGEST_EXPONENT {
        reduced_exp(x)
    } else {
        library_exp(x)
    }
}

#[cold]
#[inline(never)]
fn library_exp(x: f64) -> f64 {
    x.exp()
}

#[inline(always)]
fn reduced_exp(x: f64) -> f64 {
    // ln 2 in two parts, the first of 32 bits.
    const LN_2: [f64; 2] = [6.931_471_803_691_238e-1, 1.908_214_929_270_587_7e-10];
    // 1/2! to 1/7!, and 1/8! to 1/13!.
    const LOW: [f64; 6] = [
        0.5,
        0.166_666_666_666_666_66,
        4.166_666_666_666_666_4e-2,
        8.333_333_333_333_333e-3,
        1.388_888_888_888_889e-3,
        1.984_126_984_126_984e-4,
    ];
    const HIGH: [f64; 6] = [
        2.480_158_730_158_73e-5,
        2.755_731_922_398_589e-6,
        2.755_731_922_398_589e-7,
        2.505_210_838_544_172e-8,
        2.087_675_698_786_81e-9,
        1.605_904_383_682_161_3e-10,
    ];
    let shifted = x * std::f64::consts::LOG2_E + ROUND;
    let power = shifted - ROUND;
    let r = (x - power * LN_2[0]) - power * LN_2[1];
    let z = r * r;
    // Taylor's series: what is left out is below 1e-17 for |r| up to ln(2)/2. There is no division to wait for.
    let value =
        1.0 + (r + z * (early_polynomial(&LOW, r) + z * z * z * early_polynomial(&HIGH, r)));
    let scale = f64::from_bits(shifted.to_bits().wrapping_add(1023) << 52);
    value * scale
}

/// A polynomial of six terms, the lowest power first, by Horner's rule.
#[inline(always)]
fn polynomial<T: Lanes>([others @ .., last]: &[f64; 6], z: T) -> T {
    (others.iter().rev()).fold(T::all(*last), |sum, &c| sum * z + T::all(c))
}

/// The same in a chain of half the length, for what others wait for.
#[inline(always)]
fn early_polynomial([a, b, c, d, e, f]: &[f64; 6], z: f64) -> f64 {
    let z2 = z * z;
    ((a + z * b) + z2 * (c + z * d)) + (z2 * z2) * (e + z * f)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Distance in units in the last place of the truth.
    fn units(found: f64, truth: f64) -> f64 {
        (found - truth).abs() / (truth.abs().next_up() - truth.abs())
    }

    #[test]
    fn val_sines_are_those_of_the_library_within_two_units() {
        for i in -200_000..=200_000 {
            let i = f64::from(i);
            for x in [
                i * 1.234_567e-4,
                i * std::f64::consts::FRAC_PI_4,
                i * 0.3,
                1e-9 * i,
            ] {
                let ((sin, cos), (s, c)) = (sin_cos(x), x.sin_cos());
                assert_eq!(
                    sines_cosines([x, -0.7 * x]),
                    [(sin, cos), sin_cos(-0.7 * x)]
                );
                assert!(
                    units(sin, s) <= 2.0 || (sin - s).abs() < 1e-21 * x.abs(),
                    "sin {x}: {sin}, {s}"
                );
                assert!(
                    units(cos, c) <= 2.0 || (cos - c).abs() < 1e-21 * x.abs(),
                    "cos {x}: {cos}, {c}"
                );
            }
        }
        for x in [1e6, -1e300, f64::MIN_POSITIVE, 0.0, -0.0] {
            assert_eq!(sin_cos(x), x.sin_cos());
        }
        assert!(sin_cos(f64::NAN).0.is_nan() && sin_cos(f64::INFINITY).1.is_nan());
    }

    #[test]
    fn a_sine_is_odd_and_a_cosine_even_to_the_last_bit() {
        for i in 0..10_000 {
            let x = 0.017_3 * f64::from(i);
            let ((s, c), (t, d)) = (sin_cos(x), sin_cos(-x));
            assert_eq!((s, c), (-t, d));
        }
    }

    #[test]
    fn val_the_exponential_is_that_of_the_library_within_two_units() {
        for i in -700_000..=700_000 {
            let x = f64::from(i) * 1e-3;
            assert!(units(exp(x), x.exp()) <= 2.0, "{x}");
        }
        for x in [800.0, -800.0, f64::INFINITY, f64::NEG_INFINITY, -744.9, 0.0] {
            assert_eq!(exp(x).to_bits(), x.exp().to_bits(), "{x}");
        }
        assert!(exp(f64::NAN).is_nan());
    }
}
