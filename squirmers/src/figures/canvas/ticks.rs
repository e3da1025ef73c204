//! Ticks of an axis: round numbers with different, short labels.

use std::ops::Range;

use crate::figures::number::{exact, raised, signed};

/// Scale of an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scale {
    Linear,
    /// The coordinates are logarithms to the base ten.
    Powers,
}

/// Largest number of characters of a label. For longer labels a common power of ten, and then a common number, is
/// written in the axis title instead.
pub(super) const LONGEST: usize = 7;

/// Numbers of at least this size have a common power of ten in the axis title.
const LARGE: f64 = 1e6;

/// Tolerance for ticks at the ends of the range, so that rounding does not drop them.
const SLACK: f64 = 1e-6;

/// Ticks of an axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Ticks {
    pub values: Vec<f64>,
    pub labels: Vec<String>,
    /// A number to add to the labels, after they are multiplied by a power of ten.
    base: f64,
    power: i32,
}

/// `n * 10^exponent`, rounded once.
fn value(n: i64, exponent: i32) -> f64 {
    let scale = 10_f64.powi(exponent.abs());
    if exponent < 0 {
        n as f64 / scale
    } else {
        n as f64 * scale
    }
}

/// Labels of `(n - base) * 10^exponent`, and the power of ten that is not in the labels.
fn labels(ns: &[i64], base: i64, exponent: i32) -> (Vec<String>, i32) {
    let without = |power: i32| -> Vec<String> {
        let text = |n: &i64| signed(&value(n - base, exponent - power).to_string());
        ns.iter().map(text).collect()
    };
    let sizes = ns.iter().map(|n| value(n - base, exponent).abs());
    let size = sizes.fold(0.0, f64::max);
    let plain = without(0);
    if size == 0.0 || (size < LARGE && are_short(&plain)) {
        return (plain, 0);
    }
    // By rounding, the logarithm of a power of ten may be slightly too small.
    let power = (size.log10() + 1e-9).floor() as i32;
    (without(power), power)
}

fn longest(labels: &[String]) -> usize {
    labels.iter().map(|l| l.chars().count()).max().unwrap_or(0)
}

fn are_short(labels: &[String]) -> bool {
    longest(labels) <= LONGEST
}

impl Ticks {
    /// Ticks at places with names, of which each second, third, ... is left out until all have room along `extent`.
    pub(super) fn named(
        places: &[(f64, String)],
        width: impl Fn(usize) -> f64,
        extent: f64,
    ) -> Self {
        let longest = places.iter().map(|(_, name)| name.chars().count()).max();
        let room = width(longest.unwrap_or(0));
        let stride = (room * places.len() as f64 / extent).ceil().max(1.0) as usize;
        let shown = places.iter().step_by(stride).cloned();
        let (values, labels) = shown.unzip();
        Self {
            values,
            labels,
            ..Self::default()
        }
    }

    /// The densest ticks of a range in steps of one, two or five: at most `most`, and at least two if possible. The
    /// function `fits` says whether labels of a number of characters fit, for ticks at a distance given as a share of
    /// the axis.
    pub(super) fn new(
        range: &Range<f64>,
        most: usize,
        scale: Scale,
        fits: impl Fn(usize, f64) -> bool,
    ) -> Self {
        let extent = range.end - range.start;
        let finest = (extent / most as f64).log10().floor() as i32;
        let finest = match scale {
            Scale::Linear => finest,
            Scale::Powers => finest.max(0),
        };
        let steps = (finest..=finest + 3).flat_map(|exponent| [1, 2, 5].map(|n| (n, exponent)));
        let all: Vec<Self> = steps
            .map(|(n, exponent)| Self::at(range, n, exponent, scale))
            .filter(|ticks| ticks.values.len() <= most)
            .collect();
        let mut several = all.iter().filter(|ticks| ticks.values.len() > 1);
        let has_room = |ticks: &&Self| {
            let share = (ticks.values[1] - ticks.values[0]) / extent;
            fits(longest(&ticks.labels), share)
        };
        let fitting = several.clone().find(has_room);
        let best = fitting.or(several.next_back()).or(all.first());
        best.cloned().unwrap_or_default()
    }

    /// Ticks at the multiples of `step * 10^exponent`.
    fn at(range: &Range<f64>, step: i64, exponent: i32, scale: Scale) -> Self {
        let unit = value(step, exponent);
        let first = (range.start / unit - SLACK).ceil() as i64;
        let last = (range.end / unit + SLACK).floor() as i64;
        let ns: Vec<i64> = (first..=last).map(|k| k * step).collect();
        let values: Vec<f64> = ns.iter().map(|n| value(*n, exponent)).collect();
        if scale == Scale::Powers {
            let labels = values.iter().map(|v| raised(*v as i32)).collect();
            return Self {
                values,
                labels,
                ..Self::default()
            };
        }
        let mut base = 0;
        let (mut texts, mut power) = labels(&ns, base, exponent);
        if !are_short(&texts) {
            base = ns.first().copied().unwrap_or(0);
            (texts, power) = labels(&ns, base, exponent);
        }
        Self {
            values,
            labels: texts,
            base: value(base, exponent),
            power,
        }
    }

    /// An axis title `name (unit)`, with the power of ten and the number that belong to all labels.
    pub(super) fn titled(&self, title: &str) -> String {
        let parts = title
            .strip_suffix(')')
            .and_then(|title| title.rsplit_once(" ("));
        let (name, unit) = parts.unwrap_or((title, ""));
        let base = match self.base {
            base if base < 0.0 => format!(" + {}", exact(-base)),
            base if base > 0.0 => format!(" \u{2212} {}", exact(base)),
            _ => String::new(),
        };
        let power = match self.power {
            0 => String::new(),
            power => raised(power),
        };
        match format!("{power} {unit}").trim() {
            "" => format!("{name}{base}"),
            unit => format!("{name}{base} ({unit})"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::range::{padded, sound};

    fn ticks(range: &Range<f64>) -> Ticks {
        Ticks::new(&sound(range), 8, Scale::Linear, |_, _| true)
    }

    /// The number that a reader computes from a label and the axis title.
    fn read(ticks: &Ticks, label: &str) -> f64 {
        let plain = |text: &str| -> f64 {
            let text = text.replace('\u{2212}', "-");
            match text.split_once("·10") {
                Some((digits, power)) => {
                    let power: String = (power.chars())
                        .map(|c| match "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().position(|d| d == c) {
                            Some(digit) => char::from(b'0' + digit as u8),
                            None => '-',
                        })
                        .collect();
                    format!("{digits}e{power}").parse().unwrap()
                }
                None => text.parse().unwrap(),
            }
        };
        plain(&exact(ticks.base))
            + format!("{}e{}", plain(label), ticks.power)
                .parse::<f64>()
                .unwrap()
    }

    #[test]
    fn labels_differ_are_short_and_say_the_value_of_their_tick_at_every_magnitude() {
        for power in -290..290 {
            for (low, high) in [(0.0, 1.0), (-3.0, 7.0), (1.0, 1.02), (-9.99, 9.99)] {
                let scale = 10_f64.powi(power);
                let range = low * scale..high * scale;
                let ticks = ticks(&range);
                let mut labels = ticks.labels.clone();
                labels.sort();
                labels.dedup();
                assert_eq!(labels.len(), ticks.values.len(), "{range:?}: {ticks:?}");
                assert!((3..=8).contains(&labels.len()), "{range:?}: {ticks:?}");
                for (label, value) in ticks.labels.iter().zip(&ticks.values) {
                    assert!(label.chars().count() <= LONGEST, "{range:?}: {ticks:?}");
                    let off = (read(&ticks, label) - value).abs();
                    assert!(off <= 1e-9 * (high - low) * scale, "{range:?}: {ticks:?}");
                }
            }
        }
    }

    #[test]
    fn an_axis_without_extent_has_distinct_ticks_about_its_value() {
        for value in [0.0, 5.0, -90.0, 1e-9, 1e9, -1e300, 1e-300] {
            for range in [value..value, padded([value, value], 0.06, 0.0)] {
                let range = sound(&range);
                let ticks = ticks(&range);
                assert!(ticks.labels.len() >= 3, "{value}: {ticks:?}");
                let (first, last) = (&ticks.labels[0], &ticks.labels[ticks.labels.len() - 1]);
                assert_ne!(first, last);
                assert!(range.contains(&value) || value.abs() < 1e-290);
            }
        }
        assert_eq!(
            ticks(&padded([0.0, 0.0], 0.06, 0.0)).labels,
            ["−0.4", "−0.2", "0", "0.2", "0.4"]
        );
    }

    #[test]
    fn a_narrow_range_far_from_zero_is_counted_from_a_number_in_the_title() {
        let far = ticks(&(1e9..1e9 + 4.0));
        assert_eq!(far.labels[0], "0");
        assert_eq!(far.titled("x (radii a)"), "x − 10⁹ (radii a)", "{far:?}");
        let far = ticks(&(-1e250 - 4e243..-1e250));
        assert!(far.titled("x").contains("x + "), "{}", far.titled("x"));
    }

    #[test]
    fn a_common_power_of_ten_stands_before_the_unit() {
        let tiny = ticks(&(0.0..4e-9));
        assert_eq!(tiny.labels[..3], ["0", "1", "2"]);
        assert_eq!(tiny.titled("angle (degrees)"), "angle (10⁻⁹ degrees)");
        assert_eq!(
            tiny.titled("squirmer parameter, β"),
            "squirmer parameter, β (10⁻⁹)"
        );
        let usual = ticks(&(-120.0..120.0));
        assert_eq!(usual.titled("angle (degrees)"), "angle (degrees)");
    }

    #[test]
    fn powers_of_ten_are_ticks_and_nothing_between_them() {
        for range in [0.0..1.0, -7.0..1.0, -300.0..2.0] {
            let ticks = Ticks::new(&range, 12, Scale::Powers, |_, _| true);
            assert!(ticks.labels.len() >= 2, "{ticks:?}");
            for (label, value) in ticks.labels.iter().zip(&ticks.values) {
                assert_eq!(*label, raised(*value as i32));
            }
        }
    }

    #[test]
    fn ticks_thin_out_until_their_labels_have_room() {
        let room = |chars: usize, share: f64| chars as f64 * 10.0 < 100.0 * share;
        let ticks = Ticks::new(&(0.0..1000.0), 9, Scale::Linear, room);
        assert_eq!(ticks.labels, ["0", "500", "1000"]);
    }
}
