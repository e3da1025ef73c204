//! Options at and beyond their limits.

use super::*;

#[test]
fn tolerances_distances_and_times_are_allowed_up_to_their_limits() {
    for tolerance in [1e-14, 1e-8, 1e-2] {
        assert!(checked_tolerance(tolerance).is_ok());
    }
    for tolerance in [0.9e-14, 1.1e-2, 0.0, -1e-8, f64::NAN, f64::INFINITY] {
        let error = checked_tolerance(tolerance).unwrap_err().to_string();
        assert!(error.contains("1e-14 to 1e-2"), "{error}");
    }
    let lt = [Method::Lt];
    for distance in [2.000_001, 12.0, 1e9, f64::INFINITY] {
        assert!(checked_angles_at(distance, &lt).is_ok(), "{distance}");
    }
    for distance in [2.0, 1.0, -3.0, f64::NAN] {
        let error = checked_angles_at(distance, &lt).unwrap_err().to_string();
        assert!(error.contains("greater than 2"), "{error}");
    }
    for (seconds, limit) in [(0.0, 0), (2.5, 2500)] {
        let found = checked_time_limit(Some(seconds)).unwrap();
        assert_eq!(found, Some(Duration::from_millis(limit)));
    }
    assert_eq!(checked_time_limit(None).unwrap(), None);
    for seconds in [-1.0, f64::NAN, f64::INFINITY] {
        assert!(checked_time_limit(Some(seconds)).is_err(), "{seconds}");
    }
}
