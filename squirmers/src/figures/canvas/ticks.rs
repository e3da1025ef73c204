//! Ticks of an axis: round numbers, each with a label of its own that is short enough to be read.

use std::ops::Range;

use crate::figures::number::{decimal, raised};

/// How an axis counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::figures) enum Scale {
    Linear,
    /// Its coordinates are logarithms to the base ten.
    Powers,
}

/// Most characters of a label: longer ones leave a common power of ten, and then a common number, to the axis title.
const LONGEST: usize = 7;

/// Numbers from here on have a common power of ten, and so have those with more decimals than these.
const LARGE: f64 = 1e6;
const DECIMALS: i32 = 4;

/// Fewest ticks: a single one tells no scale.
const FEWEST: usize = 3;

/// Steps of ticks, in powers of ten.
const STEPS: [i64; 3] = [5, 2, 1];

/// Slack of a count of ticks: an end of the range that is a tick but for rounding is one.
const SLACK: f64 = 1e-6;

/// Ticks of an axis.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::figures) struct Ticks {
    pub values: Vec<f64>,
    pub labels: Vec<String>,
    /// What is to be added to the labels.
    base: Option<String>,
    /// The power of ten by which the labels are to be multiplied.
    power: i32,
}

/// Ticks at `n * 10^exponent`, `n` in steps.
struct Places {
    ns: Vec<i64>,
    step: i64,
    exponent: i32,
}

impl Places {
    /// The closest ones in steps of one, two or five, no more than `most`, and no closer than `finest` powers of ten.
    fn new(range: &Range<f64>, most: usize, finest: i32) -> Self {
        let extent = range.end - range.start;
        let mut exponent = (extent.log10().floor() as i32 + 1).max(finest);
        let mut places = Self::at(range, 1, exponent);
        while exponent > finest {
            exponent -= 1;
            for step in STEPS {
                let closer = Self::at(range, step, exponent);
                if closer.ns.len() > most {
                    return places;
                }
                places = closer;
            }
        }
        places
    }

    fn at(range: &Range<f64>, step: i64, exponent: i32) -> Self {
        let unit = value(step, exponent);
        let first = (range.start / unit - SLACK).ceil() as i64;
        let last = (range.end / unit + SLACK).floor() as i64;
        Self {
            ns: (first..=last).map(|k| k * step).collect(),
            step,
            exponent,
        }
    }

    fn values(&self) -> Vec<f64> {
        self.ns.iter().map(|n| value(*n, self.exponent)).collect()
    }

    fn step(&self) -> f64 {
        value(self.step, self.exponent)
    }
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

impl Ticks {
    /// About `most` ticks over a range that can be drawn. `fits` says whether labels of so many characters have room,
    /// the ticks a share of the axis apart.
    pub(super) fn new(
        range: &Range<f64>,
        most: usize,
        scale: Scale,
        fits: impl Fn(usize, f64) -> bool,
    ) -> Self {
        let finest = match scale {
            Scale::Linear => i32::MIN,
            Scale::Powers => 0,
        };
        let with = |most: usize| {
            let places = Places::new(range, most, finest);
            let share = places.step() / (range.end - range.start);
            let ticks = match scale {
                Scale::Linear => Self::linear(&places),
                Scale::Powers => Self::powers(&places),
            };
            let longest = ticks.labels.iter().map(|l| l.chars().count()).max();
            (fits(longest.unwrap_or(0), share), ticks)
        };
        let fewest = FEWEST.min(most);
        let mut fewer = (fewest..=most).rev().map(with);
        let fitting = fewer.find_map(|(fits, ticks)| fits.then_some(ticks));
        fitting.unwrap_or_else(|| with(fewest).1)
    }

    fn powers(places: &Places) -> Self {
        let label = |v: &f64| raised(*v as i32);
        let values = places.values();
        Self {
            labels: values.iter().map(label).collect(),
            values,
            base: None,
            power: 0,
        }
    }

    fn linear(places: &Places) -> Self {
        let values = places.values();
        let exponent = places.exponent;
        let labels = |base: i64, power: i32| -> Vec<String> {
            (places.ns.iter())
                .map(|n| decimal(n - base, exponent - power))
                .collect()
        };
        let short = |labels: &[String]| labels.iter().all(|l| l.chars().count() <= LONGEST);
        let of = |base: i64| {
            let size =
                (places.ns.iter()).fold(0.0_f64, |s, n| s.max(value(n - base, exponent).abs()));
            let plain = labels(base, 0);
            if size == 0.0 || (size < LARGE && exponent >= -DECIMALS && short(&plain)) {
                return (plain, 0);
            }
            // The logarithm of a whole power may lie below it by rounding.
            let power = (size.log10() + 1e-9).floor() as i32;
            (labels(base, power), power)
        };
        let (plain, power) = of(0);
        match places.ns.first() {
            Some(&first) if !short(&plain) => {
                let (labels, power) = of(first);
                let (digits, exponent) = trimmed(first, exponent);
                Self {
                    values,
                    labels,
                    base: Some(written(digits, exponent)),
                    power,
                }
            }
            _ => Self {
                values,
                labels: plain,
                base: None,
                power,
            },
        }
    }

    /// The label of one of the values.
    pub(super) fn label(&self, value: f64) -> String {
        let place = self.values.iter().position(|v| v.total_cmp(&value).is_eq());
        place.map_or_else(String::new, |i| self.labels[i].clone())
    }

    /// An axis title, `name (unit)`, that says what is to be done with the labels.
    pub(super) fn titled(&self, title: &str) -> String {
        let (name, unit) = match title.rsplit_once(" (") {
            Some((name, unit)) => (name, unit.strip_suffix(')').unwrap_or(unit)),
            None => (title, ""),
        };
        let base = match self.base.as_deref() {
            Some(base) => match base.strip_prefix('\u{2212}') {
                Some(size) => format!(" + {size}"),
                None => format!(" \u{2212} {base}"),
            },
            None => String::new(),
        };
        let unit = match (self.power, unit) {
            (0, unit) => unit.to_owned(),
            (power, "") => raised(power),
            (power, unit) => format!("{} {unit}", raised(power)),
        };
        if unit.is_empty() {
            format!("{name}{base}")
        } else {
            format!("{name}{base} ({unit})")
        }
    }
}

/// The same number without trailing zeros in its digits.
fn trimmed(mut n: i64, mut exponent: i32) -> (i64, i32) {
    while n != 0 && n % 10 == 0 {
        (n, exponent) = (n / 10, exponent + 1);
    }
    (n, exponent)
}

/// All digits of a number, with a power of ten where it would otherwise be a row of zeros.
fn written(n: i64, exponent: i32) -> String {
    let plain = decimal(n, exponent);
    let digits = n.unsigned_abs().to_string().len();
    if plain.chars().count() <= digits + 3 {
        return plain;
    }
    let point = digits as i32 - 1;
    let text = format!("{}·{}", decimal(n, -point), raised(exponent + point));
    match n {
        1 | -1 => text.replacen("1·", "", 1),
        _ => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::range::{padded, sound};

    fn ticks(range: &Range<f64>) -> Ticks {
        Ticks::new(&sound(range), 8, Scale::Linear, |_, _| true)
    }

    /// What a reader makes of a label and the axis title.
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
        let base = ticks.base.as_deref().map_or(0.0, plain);
        base + format!("{}e{}", plain(label), ticks.power)
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
