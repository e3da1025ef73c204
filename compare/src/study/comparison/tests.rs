//! Two methods side by side, and what was not asked for.

use super::*;
use crate::Approach;
use crate::encounters;
use crate::made::lubrication;
use crate::sweep::SweepOptions;
use scene::RunOptions;

#[test]
fn errors_are_differences_from_the_exact_deflections_and_nothing_where_a_method_is_missing() {
    let case = |dx: f64| Case {
        approach: Approach::Orthogonal,
        beta: 5.0,
        dx,
        dz: 0.0,
    };
    let models = lubrication();
    let options = SweepOptions {
        run: RunOptions::default(),
        time_limit: None,
    };
    let mut found = encounters(&models, &[case(1.0), case(2.0)], &options);
    let rows = comparison(&found);
    let heads: Vec<(f64, usize)> = rows.iter().map(|row| (row.dx, row.squirmer)).collect();
    assert_eq!(heads, [(1.0, 1), (1.0, 2), (2.0, 1), (2.0, 2)]);
    for (k, row) in rows.iter().enumerate() {
        let deflection =
            |at: usize| found[at].run.as_ref().unwrap().deflections_rad()[k % 2].to_degrees();
        assert_eq!(
            [row.lt_deg, row.lt_corrected_deg].map(f64::to_bits),
            [deflection(k / 2), deflection(2 + k / 2)].map(f64::to_bits)
        );
        assert!(row.exact_deg.is_nan() && row.bem_deg.is_nan() && row.lt_error_deg.is_nan());
        assert_eq!(row.case, "orthogonal");
        assert_eq!(row.outcomes, format!("{} / –", found[k / 2].outcome()));
    }
    // The corrected form in the place of exact loads, and then of boundary elements.
    for encounter in &mut found[2..] {
        encounter.method = Method::Exact;
    }
    for row in comparison(&found) {
        assert!((row.lt_error_deg - (row.lt_deg - row.exact_deg)).abs() < 1e-12);
        assert!(
            row.lt_error_deg.abs() > 0.0 && row.lt_corrected_error_deg.is_nan(),
            "{row:?}"
        );
    }
    for encounter in &mut found[..2] {
        encounter.method = Method::Bem;
    }
    for row in comparison(&found) {
        assert!(
            (row.bem_error_deg - (row.bem_deg - row.exact_deg)).abs() < 1e-12
                && row.bem_error_deg.abs() > 0.0
        );
    }
    for encounter in &mut found[..2] {
        encounter.method = Method::LtCorrected;
    }
    for row in comparison(&found) {
        assert!(
            (row.lt_corrected_error_deg - (row.lt_corrected_deg - row.exact_deg)).abs() < 1e-12
        );
        assert!(row.lt_corrected_error_deg.abs() > 0.0);
    }
}
