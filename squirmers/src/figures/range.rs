//! Ranges of axes, for any values: equal, huge, tiny or not finite.

use std::ops::Range;

/// Largest size of a number on an axis, so that the extent of a range is finite.
const LARGEST: f64 = 1e300;

/// Smaller sizes are drawn as zero, because their fractions do not have full precision.
const SMALLEST: f64 = 1e-290;

/// Smallest extent of a range as a share of the numbers in it, so that the labels of ticks differ.
const NARROWEST: f64 = 1e-9;

/// Half the extent of an axis around a single value of size one or more, and around zero.
const ABOUT: f64 = 0.5;

/// The smallest and the largest of the finite values.
pub(super) fn extremes(values: impl IntoIterator<Item = f64>) -> Option<(f64, f64)> {
    let finite = values.into_iter().filter(|v| v.is_finite());
    finite.fold(None, |bounds, v| {
        let v = v.clamp(-LARGEST, LARGEST);
        let (low, high) = bounds.unwrap_or((v, v));
        Some((low.min(v), high.max(v)))
    })
}

/// The range of the values with a margin of `share` of the range. The extent is never zero. Values that differ by at
/// most `least` are drawn as equal.
pub(super) fn padded(values: impl IntoIterator<Item = f64>, share: f64, least: f64) -> Range<f64> {
    let Some((low, high)) = extremes(values) else {
        return 0.0..1.0;
    };
    let (extent, size) = (high - low, low.abs().max(high.abs()));
    let margin = if extent <= least.max(NARROWEST * size) {
        about(size, least)
    } else {
        share * extent
    };
    low - margin..high + margin
}

/// Room on both sides of a single value of this size.
fn about(size: f64, least: f64) -> f64 {
    if size <= least.max(SMALLEST) {
        return ABOUT;
    }
    (ABOUT * size).min(ABOUT).max(1e-3 * size)
}

/// A range of whole powers of ten around logarithms to the base ten; at least one decade.
pub(super) fn decades(logs: impl IntoIterator<Item = f64>) -> Range<f64> {
    let (low, high) = extremes(logs).unwrap_or((0.0, 0.0));
    let (low, high) = ((low - 0.1).floor(), (high + 0.1).ceil());
    low..high.max(low + 1.0)
}

/// Returns the range if an axis can show it, otherwise a wider range around it.
pub(super) fn sound(range: &Range<f64>) -> Range<f64> {
    padded([range.start, range.end], 0.0, SMALLEST)
}

/// A range with at least the extent `least` and the same middle.
pub(super) fn widened(range: &Range<f64>, least: f64) -> Range<f64> {
    let middle = 0.5 * (range.start + range.end);
    let half = 0.5 * (range.end - range.start).max(least);
    middle - half..middle + half
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_drawable(range: &Range<f64>) -> bool {
        let size = range.start.abs().max(range.end.abs());
        range.start.is_finite()
            && range.end.is_finite()
            && range.end - range.start >= 0.99 * NARROWEST * size
            && range.end > range.start
    }

    #[test]
    fn every_set_of_values_has_a_range_that_can_be_drawn() {
        let all: [&[f64]; 12] = [
            &[],
            &[f64::NAN],
            &[f64::INFINITY, f64::NAN],
            &[0.0, -0.0],
            &[5.0],
            &[-1e9, -1e9],
            &[1e-300],
            &[1e-9, 2e-9],
            &[-f64::MAX, f64::MAX],
            &[1e17, 1e17 + 16.0],
            &[f64::NAN, 1.0, 3.0],
            &[f64::NEG_INFINITY, 1.0],
        ];
        for values in all {
            for range in [
                padded(values.iter().copied(), 0.06, 0.0),
                padded(values.iter().copied(), 0.06, 1e-5),
                decades(values.iter().copied()),
            ] {
                let range = sound(&range);
                assert!(is_drawable(&range), "{values:?}: {range:?}");
                for v in values.iter().filter(|v| v.abs() <= LARGEST) {
                    assert!(
                        range.start <= *v && *v <= range.end,
                        "{values:?}: {range:?}"
                    );
                }
            }
        }
        for range in [
            f64::INFINITY..f64::NEG_INFINITY,
            f64::NAN..f64::NAN,
            7.0..7.0,
            0.0..0.0,
            0.0..f64::MIN_POSITIVE,
        ] {
            assert!(is_drawable(&sound(&range)), "{range:?}");
        }
    }

    #[test]
    fn tiny_differences_fill_the_axis_unless_they_are_noise() {
        let tiny = padded([1e-9, 3e-9], 0.1, 0.0);
        assert!(tiny.end - tiny.start < 3e-9, "{tiny:?}");
        let close = padded([1.0, 1.000_000_1], 0.1, 0.0);
        assert!(close.end - close.start < 2e-7, "{close:?}");
        let noise = padded([0.0, 1e-12], 0.1, 1e-5);
        assert!(noise.end - noise.start > 0.5, "{noise:?}");
    }
}
