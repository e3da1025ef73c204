//! The closed forms far apart against exact coefficients.

use exact::Exact;
use scene::mobility::MobilitySet;
use scene::{Gap, Hydrodynamics, LoadSet};

use super::*;

const READ: MobilitySet = MobilitySet {
    loads: LoadSet::all(2),
    torque: true,
};

/// A coefficient's series: whether it is times the gap, the power of what is left out, and its terms.
#[derive(Default)]
struct Series {
    times_gap: bool,
    next: i32,
    terms: Vec<(i32, f64)>,
}

fn series() -> Vec<(String, Series)> {
    let mut all: Vec<(String, Series)> = Vec::new();
    for row in rows_of("far-field.csv") {
        if all.last().is_none_or(|(name, _)| *name != row["name"]) {
            all.push((row["name"].clone(), Series::default()));
        }
        let (_, of) = all.last_mut().unwrap();
        of.times_gap = row["times"] == "gap";
        of.next = row["next_power"].parse().unwrap();
        let power = row["power"].parse().unwrap();
        of.terms.push((power, number(&row, "coefficient")));
    }
    all
}

/// What the closed forms leave of each exact coefficient at a distance of the centres.
fn left(distance: f64) -> HashMap<String, f64> {
    let gap = Gap::new(distance - 2.0).unwrap();
    let named = Exact::new().mobility(gap, READ).unwrap().named(READ);
    let named: HashMap<String, f64> = named.into_iter().collect();
    let of = |(name, series): (String, Series)| {
        let times = if series.times_gap { gap.eps() } else { 1.0 };
        let form: f64 = (series.terms.iter())
            .map(|(power, coefficient)| coefficient * distance.powi(-power))
            .sum();
        let rest = times * named[&name] - form;
        (name, rest)
    };
    series().into_iter().map(of).collect()
}

#[test]
fn every_coefficient_has_a_form_far_apart() {
    let mut of_motion: Vec<_> = (rows_of("mobilities.csv").into_iter())
        .map(|row| row["name"].clone())
        .collect();
    of_motion.sort();
    of_motion.dedup();
    let mut of_forms: Vec<_> = series().into_iter().map(|(name, _)| name).collect();
    of_forms.sort();
    assert_eq!(of_motion, of_forms);
    for row in rows_of("far-field.csv") {
        let fraction = &row["fraction"];
        let (over, under) = fraction.split_once('/').unwrap_or((fraction, "1"));
        let [over, under]: [f64; 2] = [over, under].map(|part| part.parse().unwrap());
        assert!(
            (over / under - number(&row, "coefficient")).abs() < 1e-15,
            "{row:?}"
        );
    }
}

#[test]
fn val_what_is_left_out_falls_as_it_says() {
    for distance in [8.0, 16.0, 32.0] {
        let left = left(distance);
        for (name, series) in series() {
            let (rest, scale) = (left[&name].abs(), distance.powi(-series.next));
            println!("{name} at {distance}: {:.3}", rest / scale);
            // A term's coefficient that is off by more than 0.015 would leave more at 32.
            assert!(
                rest < 12.0 * scale + 1e-13,
                "{name} at {distance}: {rest:e}"
            );
        }
    }
}

#[test]
fn val_exact_coefficients_tend_to_the_closed_forms_at_100_and_1000() {
    for distance in [100.0, 1000.0] {
        let left = left(distance);
        for (name, series) in series() {
            let rest = left[&name].abs();
            let allowed = 12.0 * distance.powi(-series.next) + 1e-12;
            assert!(rest < allowed, "{name} at {distance}: {rest:e}");
        }
    }
}
