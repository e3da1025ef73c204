//! Ranges of axes: about values that may be equal, huge, tiny or no numbers at all.

use std::ops::Range;

/// Largest size of a number on an axis: the extent of a range must be a number too.
const LARGEST: f64 = 1e300;

/// Sizes below are drawn as zero: their fractions are no numbers of full precision.
const SMALLEST: f64 = 1e-290;

/// Least extent of a range as a share of the numbers in it: ticks need digits to differ.
const NARROWEST: f64 = 1e-9;

/// Half the extent of an axis about a single value of size one or more, and about zero.
const ABOUT: f64 = 0.5;

/// The least and the largest of the finite values.
pub(super) fn extremes(values: impl IntoIterator<Item = f64>) -> Option<(f64, f64)> {
    let finite = values.into_iter().filter(|v| v.is_finite());
    finite.fold(None, |bounds, v| {
        let v = v.clamp(-LARGEST, LARGEST);
        let (low, high) = bounds.unwrap_or((v, v));
        Some((low.min(v), high.max(v)))
    })
}

/// The range of the values with a margin of `share` of it, and some extent in any case. Values that differ by no more
/// than `least` are drawn as equal.
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

/// Room on either side of a single value of a size.
fn about(size: f64, least: f64) -> f64 {
    if size <= least.max(SMALLEST) {
        return ABOUT;
    }
    (ABOUT * size).min(ABOUT).max(1e-3 * size)
}

/// Whole powers of ten about logarithms to the base ten, at least one decade.
pub(super) fn decades(logs: impl IntoIterator<Item = f64>) -> Range<f64> {
    let (low, high) = extremes(logs).unwrap_or((0.0, 0.0));
    let (low, high) = ((low - 0.1).floor(), (high + 0.1).ceil());
    low..high.max(low + 1.0)
}

/// The same range where an axis can be drawn along it, one about it otherwise.
pub(super) fn sound(range: &Range<f64>) -> Range<f64> {
    padded([range.start, range.end], 0.0, SMALLEST)
}

/// A range of at least the extent `least`, about the same middle.
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
