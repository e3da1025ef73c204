//! Errors of lubrication theory, against itself in the place of exact loads and against exact loads.

use super::*;
use crate::ModelOptions;

#[test]
fn gaps_are_twelve_a_decade_from_a_thousandth_to_a_hundred() {
    let all: Vec<f64> = gaps().collect();
    assert_eq!(all.len(), 61);
    assert!((all[0] - 1e-3).abs() < 1e-18 && (all[60] - 100.0).abs() < 1e-10);
    assert!((all[12] - 1e-2).abs() < 1e-15, "{}", all[12]);
    assert!(all.is_sorted());
}

#[test]
fn errors_are_relative_to_the_larger_of_the_load_and_one() {
    let [lt, corrected, exact] = [Method::Lt, Method::LtCorrected, Method::Exact].map(|method| {
        let options = ModelOptions {
            direct: true,
            ..ModelOptions::default()
        };
        Model::set_up(method, &options).unwrap()
    });
    let set = LoadSet::planar(1);
    // Exact loads have no error of their own, and are left out.
    let rows = load_errors(&[&exact, &lt], &corrected, set).unwrap();
    assert!(rows.iter().all(|row| row.method == Method::Lt));
    let names = corrected
        .loads(Gap::new(1.0).unwrap(), set)
        .unwrap()
        .named()
        .len();
    assert_eq!(rows.len(), 61 * names);
    for row in &rows {
        let gap = Gap::new(row.gap).unwrap();
        let of = |model: &Model| {
            let named = model.loads(gap, set).unwrap().named();
            named
                .into_iter()
                .find(|(name, _)| *name == row.name)
                .unwrap()
                .1
        };
        assert_eq!(
            [row.value, row.exact].map(f64::to_bits),
            [of(&lt), of(&corrected)].map(f64::to_bits)
        );
        let error = (row.value - row.exact).abs();
        let relative = if row.exact.abs() > 1.0 {
            error / row.exact.abs()
        } else {
            error
        };
        assert!((row.error - relative).abs() < 1e-15, "{row:?}");
    }
    assert!(
        rows.iter().any(|row| row.error > 0.1) && rows.iter().any(|row| row.exact.abs() > 100.0)
    );
}
