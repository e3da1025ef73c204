use std::sync::Arc;

use super::*;
use crate::balance;
use crate::made::Made;
use crate::mobility::{Block, Mobility};
use approx::assert_relative_eq;

fn table(seam: Option<f64>, noise: f64, tolerance: f64) -> Tabulated {
    let options = TableOptions {
        set: LoadSet::all(2),
        tolerance,
        smallest_gap: 1e-3,
    };
    Tabulated::build(Arc::new(Made { seam, noise }), options, &|_| ()).unwrap()
}

fn read(set: LoadSet) -> MobilitySet {
    MobilitySet {
        loads: set,
        torque: true,
    }
}

/// What a model answers for spheres that interact.
fn answer(model: &dyn Hydrodynamics, eps: f64, set: LoadSet) -> Result<Mobility, SceneError> {
    model.interacting_mobilities(Gap::new(eps)?, read(set))
}

/// The largest difference of a coefficient from that of a table's model, relative to the larger of it and 1; that of the opening as a
/// velocity where the two are far apart.
fn worst(table: &Tabulated, eps: f64, set: LoadSet) -> f64 {
    let named = |model: &dyn Hydrodynamics| answer(model, eps, set).unwrap().named(read(set));
    let (found, truth) = (named(table), named(table.model()));
    assert_eq!(found.len(), truth.len());
    (found.into_iter().zip(truth)).fold(0.0, |most, ((name, a), (_, b))| {
        let scale = if name.starts_with("opening") {
            eps.max(1.0)
        } else {
            1.0
        };
        most.max(scale * (a - b).abs() / b.abs().max(1.0))
    })
}

#[test]
fn a_table_agrees_with_its_model_between_its_nodes() {
    for tolerance in [1e-6, 1e-9] {
        let table = table(Some(0.3), 1e-14, tolerance);
        assert_eq!(table.summary().limit, TableLimit::Tolerance(tolerance));
        for i in 0..400 {
            let eps = (-6.9 + 0.047 * f64::from(i)).exp();
            let error = worst(&table, eps, LoadSet::all(2));
            assert!(error <= 3.0 * tolerance, "{eps}: {error}");
        }
    }
}

/// Both the derivative of a table's polynomials and the difference of its model's own coefficients, from contact to far apart.
#[test]
fn val_a_table_gives_the_slopes_of_its_model() {
    let set = LoadSet {
        swirl: 2,
        ..LoadSet::all(3)
    };
    let model = Made {
        seam: None,
        noise: 1e-14,
    };
    let options = TableOptions {
        set,
        tolerance: 1e-11,
        smallest_gap: 1e-3,
    };
    let table = Tabulated::build(Arc::new(model), options, &|_| ()).unwrap();
    for eps in [2e-3, 0.0317, 0.4, 1.7, 2.3, 9.1, 77.0] {
        let slope = |model: &dyn Hydrodynamics| {
            let mut read_into = [MobilityOfEach::default(), MobilityOfEach::default()];
            let [value, slope] = &mut read_into;
            let gap = Gap::new(eps).unwrap();
            (model.interacting_mobility_with_slope(gap, read(set), [value, slope])).unwrap();
            slope.named(read(set))
        };
        let (found, truth) = (slope(&table), slope(table.model()));
        assert_eq!(found.len(), truth.len());
        for ((name, a), (_, b)) in found.into_iter().zip(truth) {
            let off = (a - b).abs() / b.abs().max(1.0);
            assert!(off < 1e-7, "{name} at {eps}: {a}, {b}");
        }
    }
}

#[test]
fn a_table_with_swirl_agrees_with_its_model_and_leaves_the_other_coefficients_as_they_are() {
    let model = Made {
        seam: None,
        noise: 1e-14,
    };
    let tabulated = |swirl| {
        let options = TableOptions {
            set: LoadSet::all(2).with_swirl(swirl),
            tolerance: 1e-9,
            smallest_gap: 1e-3,
        };
        Tabulated::build(Arc::new(model.clone()), options, &|_| ()).unwrap()
    };
    let (plain, two, four) = (tabulated(0), tabulated(2), tabulated(4));
    for i in 0..100 {
        let eps = (-6.9 + 0.19 * f64::from(i)).exp();
        let set = LoadSet::all(2).with_swirl(2);
        let error = worst(&two, eps, set);
        assert!(error <= 3e-9, "{eps}: {error}");
        let [alone, both] = [answer(&plain, eps, LoadSet::all(2)), answer(&two, eps, set)];
        let [alone, both] = [alone.unwrap(), both.unwrap()];
        assert_eq!((alone.pair, alone.modes), (both.pair, both.modes));
        assert_eq!(answer(&four, eps, set).unwrap(), both);
    }
    assert!(answer(&plain, 1.0, LoadSet::all(2).with_swirl(1)).is_err());
}

#[test]
fn a_table_reaches_to_infinity() {
    let table = table(None, 1e-14, 1e-10);
    let set = LoadSet::all(2);
    let gap = Gap::new(1e15).unwrap();
    let far = answer(&table, gap.eps(), set).unwrap();
    let lone = balance::solve(gap, &PairLoads::isolated(set), read(set));
    let both = far.named(read(set)).into_iter().zip(lone.named(read(set)));
    for ((name, found), (_, lone)) in both {
        assert!((found - lone).abs() < 1e-9, "{name}: {found}, {lone}");
    }
}

#[test]
fn a_table_jumps_at_a_seam_as_its_model_does() {
    let table = table(Some(0.3), 1e-14, 1e-9);
    let at = |model: &dyn Hydrodynamics, eps| {
        let mobility = answer(model, eps, LoadSet::all(2)).unwrap();
        mobility.modes[0].across.mean_transverse
    };
    let jump = |model| at(model, 0.3 + 1e-9) - at(model, 0.3 - 1e-9);
    assert!(jump(table.model()).abs() > 1e-5);
    assert_relative_eq!(jump(&table), jump(table.model()), epsilon = 1e-8);
}

#[test]
fn a_table_stops_at_the_noise_of_its_model_and_says_so() {
    let fine = table(None, 1e-14, 1e-12);
    let noisy = table(None, 1e-5, 1e-12);
    assert_eq!(noisy.summary().limit, TableLimit::Noise(1e-5));
    assert!(noisy.summary().evaluations < fine.summary().evaluations);
}

#[test]
fn gaps_under_the_range_are_refused() {
    let table = table(None, 1e-14, 1e-6);
    let refused = answer(&table, 9.9e-4, LoadSet::all(2));
    assert!(matches!(refused, Err(SceneError::GapOutsideRange { .. })));
    assert!(answer(&table, 1e-3, LoadSet::all(2)).is_ok());
}

#[test]
fn below_a_table_the_model_answers() {
    let options = TableOptions {
        set: LoadSet::all(2),
        tolerance: 1e-6,
        smallest_gap: 0.01,
    };
    let model = Made {
        seam: None,
        noise: 1e-14,
    };
    let table = Tabulated::build(Arc::new(model), options, &|_| ()).unwrap();
    let of = |model| answer(model, 2e-3, LoadSet::all(2));
    assert_eq!(of(&table), of(table.model()));
    assert_eq!(table.range(), table.model().range());
    let gap = Gap::new(0.1).unwrap();
    let loads = |model: &dyn Hydrodynamics| model.loads(gap, LoadSet::all(5));
    assert_eq!(
        loads(&table),
        loads(table.model()),
        "loads are the model's own"
    );
}

#[test]
fn fewer_modes_than_tabulated_are_read_and_more_refused() {
    let table = table(None, 1e-14, 1e-6);
    let gap = Gap::new(0.1).unwrap();
    let both = answer(&table, 0.1, LoadSet::all(2)).unwrap();
    let (mut pair, mut modes) = (PairMobility::default(), [ModeMobility::default()]);
    let one = read(LoadSet::all(1));
    table
        .interacting_mobility(gap, one, (&mut pair, &mut modes))
        .unwrap();
    assert_eq!((pair, modes[0]), (both.pair, both.modes[0]));
    assert_eq!(
        table.mobility(gap, one).unwrap().named(one),
        both.named(one)
    );
    let three = answer(&table, 0.1, LoadSet::all(3));
    assert!(matches!(three, Err(SceneError::LoadsNotHeld { .. })));
}

#[test]
fn without_torque_the_same_is_read_but_for_its_coefficients() {
    let table = table(None, 1e-14, 1e-6);
    for eps in [0.02, 5.0] {
        let gap = Gap::new(eps).unwrap();
        let [with, without] = [true, false].map(|torque| {
            let loads = LoadSet::all(2);
            table.mobility(gap, MobilitySet { loads, torque }).unwrap()
        });
        assert_eq!(with.modes, without.modes);
        let [repulsion, same] = [&with, &without].map(|of| of.pair.repulsion.to_bits());
        assert_eq!(repulsion, same);
        assert!(with.pair.torque != without.pair.torque);
    }
}

#[test]
fn a_table_of_part_of_the_balance_holds_that_part_alone() {
    let whole = table(Some(0.3), 1e-5, 1e-5);
    for set in [
        LoadSet::axial(2),
        LoadSet::axial(1).mirror_symmetric(),
        LoadSet::axial_and_twist(1),
        LoadSet::planar(2),
        LoadSet::planar(2).point_symmetric(),
        LoadSet::planar(2).mirror_symmetric(),
        LoadSet::all(3),
    ] {
        let options = TableOptions {
            set,
            tolerance: 1e-5,
            smallest_gap: 1e-3,
        };
        let part = Tabulated::build(Arc::clone(&whole.model), options, &|_| ()).unwrap();
        for eps in [7e-3, 0.4, 7.0] {
            assert!(worst(&part, eps, set) < 3e-5);
            for block in Block::ALL {
                let held = answer(&part, eps, block.loads(2)).is_ok();
                assert_eq!(held, block.is_in(set), "{block:?} of {set}");
            }
            if whole.set.holds(set) {
                let [found, same] =
                    [&part, &whole].map(|table| answer(table, eps, set).unwrap().named(read(set)));
                assert_eq!(
                    found, same,
                    "the same to the last bit whatever else is held"
                );
            }
        }
        assert!(answer(&part, 1.0, LoadSet::all(4)).is_err());
    }
}

/// A model that says other things of itself than it does: no seams, no error estimate, and perhaps a cut.
struct Says {
    made: Made,
    cutoff: Option<f64>,
}

impl Hydrodynamics for Says {
    fn description(&self) -> ModelDescription<'_> {
        ModelDescription {
            cutoff: self.cutoff,
            seams: &[],
            ..self.made.description()
        }
    }

    fn interacting_loads(&self, gap: Gap, set: LoadSet) -> Result<PairLoads, SceneError> {
        self.made.interacting_loads(gap, set)
    }

    fn interacting_loads_with_swirl(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<(PairLoads, SwirlLoads), SceneError> {
        self.made.interacting_loads_with_swirl(gap, set)
    }

    fn error_estimate(&self, _: Gap, _: LoadSet) -> Result<Option<f64>, SceneError> {
        Ok(None)
    }

    fn fingerprint(&self) -> String {
        "says otherwise".to_owned()
    }
}

/// A table of a model that jumps at `seam` without saying so.
pub(super) fn table_that_says(
    cutoff: Option<f64>,
    seam: Option<f64>,
    progress: &(dyn Fn(BuildProgress) + Sync),
) -> Tabulated {
    let options = TableOptions {
        set: LoadSet::all(2),
        tolerance: 1e-8,
        smallest_gap: 1e-3,
    };
    let made = Made { seam, noise: 1e-13 };
    Tabulated::build(Arc::new(Says { made, cutoff }), options, progress).unwrap()
}

#[test]
fn a_table_keeps_the_cut_of_its_model() {
    let table = table_that_says(Some(1.0), None, &|_| ());
    assert_eq!(table.cutoff(), Some(1.0));
    assert!(table.summary().interpolation_error <= 1e-8);
    let set = LoadSet::all(2);
    for eps in [2e-3, 0.3, 1.0 - 1e-12, 1.0, 1.0 + 1e-12, 1.5, 2.5, 40.0] {
        let gap = Gap::new(eps).unwrap();
        if eps > 1.0 {
            let lone = balance::solve(gap, &PairLoads::isolated(set), read(set));
            assert_eq!(table.mobility(gap, read(set)), Ok(lone));
        }
        // A trial step past the cut has the mobility of spheres that interact.
        let error = worst(&table, eps, set);
        assert!(error < 2e-8, "{eps}: {error}");
    }
}

#[test]
fn a_table_of_a_model_that_jumps_without_a_seam_says_that_it_missed_its_tolerance() {
    let summary = table_that_says(None, Some(0.37), &|_| ()).summary();
    assert!(summary.interpolation_error > 1e-4);
    assert_eq!(
        summary.limit,
        TableLimit::Missed(summary.interpolation_error)
    );
}

/// A model that knows no gap that it was not told of before.
struct Told {
    made: Made,
    gaps: std::sync::Mutex<Vec<u64>>,
}

impl Hydrodynamics for Told {
    fn description(&self) -> ModelDescription<'_> {
        self.made.description()
    }

    fn interacting_loads(&self, gap: Gap, set: LoadSet) -> Result<PairLoads, SceneError> {
        if !self.gaps.lock().unwrap().contains(&gap.eps().to_bits()) {
            return Err(SceneError::InvalidGap { eps: gap.eps() });
        }
        self.made.interacting_loads(gap, set)
    }

    fn interacting_loads_with_swirl(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<(PairLoads, SwirlLoads), SceneError> {
        self.made.interacting_loads_with_swirl(gap, set)
    }

    fn foresee(&self, gaps: &[Gap]) -> Result<(), SceneError> {
        let new = gaps.iter().map(|gap| gap.eps().to_bits());
        self.gaps.lock().unwrap().extend(new);
        Ok(())
    }

    fn error_estimate(&self, _: Gap, _: LoadSet) -> Result<Option<f64>, SceneError> {
        Ok(None)
    }

    fn fingerprint(&self) -> String {
        "told".to_owned()
    }
}

#[test]
fn a_table_says_at_which_gaps_it_asks_and_is_the_same_table() {
    let told = Told {
        made: Made {
            seam: Some(0.37),
            noise: 1e-13,
        },
        gaps: std::sync::Mutex::default(),
    };
    let options = TableOptions {
        set: LoadSet::all(2),
        tolerance: 1e-8,
        smallest_gap: 1e-3,
    };
    let found = Tabulated::build(Arc::new(told), options, &|_| ()).unwrap();
    let usual = table(Some(0.37), 1e-13, 1e-8);
    for eps in [2e-3, 0.1, 0.5, 3.0, 70.0] {
        let set = LoadSet::all(2);
        assert_eq!(answer(&found, eps, set), answer(&usual, eps, set));
    }
}
