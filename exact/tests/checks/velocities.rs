//! The table of mobilities moves a pair as the direct solve does, at any gap.

use std::sync::{Arc, OnceLock};

use scene::mobility::{External, Heading, MobilitySet, pair_velocity};
use scene::{Gap, Hydrodynamics, LoadSet, Squirmer, TableOptions, Tabulated};

use crate::common::EQUAL;

const READ: MobilitySet = MobilitySet {
    loads: LoadSet::planar(2),
    torque: true,
};

fn table() -> &'static Tabulated {
    static TABLE: OnceLock<Tabulated> = OnceLock::new();
    TABLE.get_or_init(|| {
        let exact = EQUAL.clone();
        let options = TableOptions {
            set: READ.loads,
            tolerance: 1e-9,
            smallest_gap: exact.range().smallest,
        };
        Tabulated::build(Arc::new(exact), options, &|_| ()).unwrap()
    })
}

/// Opening, and the velocities of the pair in swimming speeds: opening, mean and turning of the line of centres as velocities, spins.
fn velocities(model: &dyn Hydrodynamics, gap: Gap, angles: [f64; 2]) -> (f64, [f64; 6]) {
    let mobility = model.mobility(gap, READ).unwrap();
    let squirmers = [0.5, 5.0].map(|beta| Squirmer::with_beta(1.0, beta).unwrap());
    let headings = angles.map(|angle| Heading {
        cosine: angle.cos(),
        transverse: angle.sin(),
    });
    let external = External {
        repulsion: 0.3,
        torque: Some([0.7, -0.2]),
    };
    let by = (&mobility.pair, &mobility.modes[..2]);
    let v = pair_velocity(by, &squirmers, &headings, &external);
    let (apart, around) = (v.opening * gap.eps(), v.turning * gap.distance());
    let [one, two] = v.spin;
    (
        v.opening,
        [apart, around, v.mean_axial, v.mean_transverse, one, two],
    )
}

#[test]
fn val_a_velocity_by_the_table_is_that_of_the_direct_solve_at_any_gap() {
    let (mut worst, mut worst_opening) = (0.0_f64, 0.0_f64);
    let decades = (-300..-20).step_by(7).map(f64::from);
    let finer = (-20 * 8..=6 * 8).map(|eighth| f64::from(eighth) / 8.0);
    for decade in decades.chain(finer) {
        let gap = Gap::new(10_f64.powf(decade)).unwrap();
        for angles in [[0.3, 0.3], [1.2, -0.4], [2.0, 2.9], [-1.5, 0.9]] {
            let (opening, found) = velocities(table(), gap, angles);
            let (direct, truth) = velocities(table().model(), gap, angles);
            for (a, b) in found.into_iter().zip(truth) {
                worst = worst.max((a - b).abs());
            }
            let scale = 1.0 + gap.log_inverse().max(0.0);
            worst_opening = worst_opening.max((opening - direct).abs() / scale);
        }
    }
    println!("velocities {worst:e}, opening over 1 + ln(1/eps) {worst_opening:e}");
    assert!(worst < 1e-8, "{worst:e}");
    assert!(worst_opening < 1e-8, "{worst_opening:e}");
}

#[test]
fn the_opening_keeps_its_digits_at_contact() {
    // As lubrication theory has it: by slip -2 L per B_n P_n(c) and more slowly varying parts, by repulsion 2/3.
    let by = |eps: f64| table().mobility(Gap::new(eps).unwrap(), READ).unwrap();
    let (near, nearer) = (by(1e-14), by(1e-15));
    for mode in 0..2 {
        let slope = (nearer.modes[mode].opening - near.modes[mode].opening) / 10_f64.ln();
        assert!((slope + 2.0).abs() < 1e-8, "mode {mode}: {slope}");
    }
    assert!((nearer.pair.repulsion - 2.0 / 3.0).abs() < 1e-9);
}
