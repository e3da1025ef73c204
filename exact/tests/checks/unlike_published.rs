//! Numbers that others published for spheres of unlike radii, to the digits that they have.

use scene::{ActiveLoads, Gap, Hydrodynamics, LoadSet, jeffrey_onishi};

use crate::common::{fitted, model};

/// Loads of rotation about the line of centres come with those of swirl, whose form other tests fit too.
const SET: LoadSet = LoadSet::all(2).with_swirl(1);

/// Rows of a CSV file without its header: first column, names, numbers of the columns asked for.
fn rows<'a>(text: &'a str, columns: &[usize]) -> Vec<(Vec<&'a str>, Vec<f64>)> {
    let lines = text.lines().filter(|line| !line.starts_with('#')).skip(1);
    let row = |line: &'a str| {
        let cells: Vec<&str> = line.split(',').collect();
        let numbers = columns.iter().map(|k| cells[*k].parse().expect("a number"));
        let numbers = numbers.collect();
        (cells, numbers)
    };
    lines.map(row).collect()
}

fn of_name(table: &[(&str, f64)], name: &str) -> f64 {
    let row = table.iter().find(|(n, _)| *n == name);
    row.expect("a scalar of this name").1
}

fn ratios(rows: &[(Vec<&str>, Vec<f64>)]) -> Vec<f64> {
    let mut ratios: Vec<f64> = rows.iter().map(|row| row.1[0]).collect();
    ratios.dedup();
    ratios
}

#[test]
fn val_resistance_scalars_are_those_of_jeffrey_and_onishi() {
    let rows = rows(fixtures::UNEQUAL_RESISTANCE, &[0, 1, 3]);
    for ratio in ratios(&rows) {
        let model = model(ratio);
        for (cells, numbers) in rows
            .iter()
            .filter(|row| row.1[0].to_bits() == ratio.to_bits())
        {
            let (distance, published) = (numbers[1], numbers[2]);
            let gap = Gap::new((distance - 2.0) * 0.5 * (1.0 + ratio)).unwrap();
            let loads = model
                .interacting_loads_of_each(gap, LoadSet::all(0))
                .unwrap();
            let own = of_name(&jeffrey_onishi(&loads, ratio), cells[2]);
            let digit = if distance < 2.4 { 1e-9 } else { 1e-11 };
            let error = (own - published).abs() / published.abs();
            assert!(error < digit, "{cells:?}: {own:.13} ({error:.1e})");
        }
    }
    assert_eq!(rows.len(), 768);
}

#[test]
fn val_contact_constants_are_those_of_multipole_collocation() {
    let rows = rows(fixtures::UNEQUAL_CONTACT, &[0, 3, 4]);
    for ratio in ratios(&rows) {
        let model = fitted(ratio);
        let constants = model.contact_constants_of_each(SET).unwrap();
        let constants = jeffrey_onishi(&constants, ratio);
        for (cells, numbers) in rows
            .iter()
            .filter(|row| row.1[0].to_bits() == ratio.to_bits())
        {
            // Ours are next to the logarithm of the smaller radius over the gap.
            let shift = (2.0 * ratio.min(1.0) / (1.0 + ratio)).ln();
            let own = of_name(&constants, cells[1]) + numbers[1] * shift;
            let digit = if cells[1].starts_with('X') && cells[1].ends_with('A') {
                1e-7
            } else {
                1.5e-9
            };
            let error = (own - numbers[2]).abs();
            println!("{ratio} {} {own:.10} {error:.1e}", cells[1]);
            assert!(error < 2.0 * digit, "{cells:?}: {own:.10}");
        }
    }
    assert_eq!(rows.len(), 30);
}

/// One load of a mode, of the sphere that is active and of the other one.
fn of_mode(loads: &ActiveLoads, name: &str, mode: usize) -> f64 {
    let mode = loads.pair.modes()[mode - 1];
    let load = match &name[..2] {
        "XF" => mode.xf,
        "YF" => mode.yf,
        _ => mode.yt,
    };
    if name.ends_with('1') {
        load.own()
    } else {
        load.other()
    }
}

#[test]
fn val_squirming_slopes_and_constants_at_contact_are_those_of_multipole_collocation() {
    let rows = rows(fixtures::UNEQUAL_SQUIRMING, &[0, 3, 4, 2]);
    for other in ratios(&rows) {
        // The squirmer once as sphere 1 and once as sphere 2.
        for (active, ratio) in [(0, other), (1, 1.0 / other)] {
            let model = fitted(ratio);
            let constants = model.contact_constants_of_each(SET).unwrap();
            let slopes = model.log_slopes_of_each(LoadSet::all(2)).unwrap();
            let (constants, slopes) = (constants[active], slopes[active]);
            for (cells, numbers) in rows
                .iter()
                .filter(|row| row.1[0].to_bits() == other.to_bits())
            {
                let (slope, constant, mode) = (numbers[1], numbers[2], numbers[3] as usize);
                let own = of_mode(&constants, cells[1], mode) + slope * other.min(1.0).ln();
                let digit = if cells[1].starts_with('X') {
                    1e-7
                } else {
                    1.5e-8
                };
                assert!((own - constant).abs() < digit, "{cells:?}: {own:.10}");
                let own = of_mode(&slopes, cells[1], mode);
                assert!((own - slope).abs() < 5e-4 * slope.abs(), "{cells:?}: {own}");
            }
        }
    }
    assert_eq!(rows.len(), 36);
}
