//! Tables of unlike radii.

use std::sync::Arc;

use super::*;
use crate::made::Unlike;

const TOLERANCE: f64 = 1e-9;

fn table(ratio: f64, set: LoadSet) -> Tabulated {
    let options = TableOptions {
        set,
        tolerance: TOLERANCE,
        smallest_gap: 1e-3,
    };
    Tabulated::build(Arc::new(Unlike(ratio)), options, &|_| ()).unwrap()
}

/// All coefficients by name, with those of the second squirmer marked.
fn named(model: &dyn Hydrodynamics, gap: Gap, set: MobilitySet) -> Vec<(String, f64)> {
    model
        .interacting_mobility_of_each(gap, set)
        .unwrap()
        .named(set)
}

#[test]
fn a_table_of_unlike_radii_agrees_with_its_model_between_its_nodes_and_to_infinity() {
    for ratio in [0.3, 4.0] {
        let set = MobilitySet {
            loads: LoadSet::all(3).with_swirl(2),
            torque: true,
        };
        let table = table(ratio, set.loads);
        assert_eq!(table.summary().limit, TableLimit::Tolerance(TOLERANCE));
        for i in 0..250 {
            let gap = Gap::new((-6.9 + 0.1 * f64::from(i)).exp()).unwrap();
            let both = named(&table, gap, set)
                .into_iter()
                .zip(named(table.model(), gap, set));
            for ((name, found), (_, truth)) in both {
                let scale = if name.starts_with("opening") {
                    gap.eps().max(1.0)
                } else {
                    1.0
                };
                let error = scale * (found - truth).abs() / truth.abs().max(1.0);
                assert!(error <= 3.0 * TOLERANCE, "{name} at {}: {error}", gap.eps());
            }
        }
    }
}

#[test]
fn coefficients_do_not_depend_on_what_else_a_table_of_unlike_radii_holds() {
    let planar = LoadSet::planar(2);
    let [plain, whole] = [planar, LoadSet::all(3).with_swirl(2)].map(|set| table(2.0, set));
    let set = MobilitySet {
        loads: planar,
        torque: true,
    };
    for eps in [0.002, 0.3, 5.0, 1e3] {
        let gap = Gap::new(eps).unwrap();
        assert_eq!(named(&plain, gap, set), named(&whole, gap, set));
    }
    let more = MobilitySet {
        loads: LoadSet::all(2),
        torque: true,
    };
    let refused = plain.interacting_mobility_of_each(Gap::new(0.1).unwrap(), more);
    assert!(matches!(refused, Err(SceneError::LoadsNotHeld { .. })));
}

#[test]
fn a_table_of_equal_radii_gives_the_coefficients_of_each_as_its_model_does() {
    let set = MobilitySet {
        loads: LoadSet::planar(2),
        torque: false,
    };
    let table = table(1.0, set.loads);
    let gap = Gap::new(0.01).unwrap();
    let of_model = table.model().interacting_mobility_of_each(gap, set);
    let of_table = table.interacting_mobility_of_each(gap, set);
    assert_eq!(of_table.unwrap(), of_model.unwrap());
}
