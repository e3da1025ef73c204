use std::sync::Arc;

use super::*;
use crate::SelfOther;
use approx::assert_relative_eq;

/// A made-up model with the true singular parts, a seam at which it jumps, and stated noise.
#[derive(Clone)]
pub(super) struct Made {
    pub seam: Option<f64>,
    pub noise: f64,
}

impl Hydrodynamics for Made {
    fn description(&self) -> ModelDescription<'_> {
        ModelDescription {
            range: GapRange::from(1e-3),
            cutoff: None,
            seams: self.seam.as_slice(),
            noise: self.noise,
        }
    }

    fn interacting_loads(&self, gap: Gap, set: LoadSet) -> Result<PairLoads, SceneError> {
        self.range().check(gap)?;
        let (eps, r) = (gap.eps(), gap.distance());
        let mut loads = PairLoads::isolated(set);
        let jump = match self.seam {
            Some(seam) if eps > seam => 1e-3,
            _ => 0.0,
        };
        // Decays as 1/r far away, has the singular part and an eps ln eps term at contact.
        let fade = (2.0 / r).powi(3);
        let singular = singular::loads(gap, set, singular::AXIAL_SQUIRMING);
        loads.xa.difference += fade * (singular.xa.difference + eps * gap.ln()) - 1.5 / r;
        loads.ya += SelfOther::new(0.2 / (r * r) + jump, -0.7 / r);
        for mode in loads.modes_mut() {
            mode.yt.sum += fade * gap.log_inverse() * 2.0;
        }
        Ok(loads)
    }

    fn interacting_loads_with_swirl(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<(PairLoads, SwirlLoads), SceneError> {
        let mut swirl = singular::swirl(gap, set);
        let fade = (2.0 / gap.distance()).powi(3);
        for (n, mode) in (1u8..).zip(swirl.modes_mut()) {
            let smooth = SelfOther::new(f64::from(n), gap.eps() * gap.ln());
            for load in [&mut mode.xtc, &mut mode.yfc, &mut mode.ytc] {
                load.sum = fade * (load.sum + smooth.sum);
                load.difference = fade * (load.difference + smooth.difference);
            }
        }
        Ok((self.interacting_loads(gap, set)?, swirl))
    }

    fn error_estimate(&self, gap: Gap, _: LoadSet) -> Result<Option<f64>, SceneError> {
        Ok(Some(1e-6 / gap.eps()))
    }

    fn fingerprint(&self) -> String {
        format!("made {:?} {}", self.seam, self.noise)
    }
}

fn table(seam: Option<f64>, noise: f64, tolerance: f64) -> Tabulated {
    let options = TableOptions {
        set: LoadSet::all(2),
        tolerance,
        smallest_gap: 1e-3,
    };
    Tabulated::build(Made { seam, noise }, options, &|_| ()).unwrap()
}

#[test]
fn a_table_agrees_with_its_model_between_its_nodes() {
    for tolerance in [1e-6, 1e-9] {
        let table = table(Some(0.3), 1e-14, tolerance);
        assert_eq!(table.summary().limit, TableLimit::Tolerance(tolerance));
        for i in 0..400 {
            let gap = Gap::from_ln(-6.9 + 0.047 * f64::from(i));
            let expected = table.model().loads(gap, LoadSet::all(2)).unwrap();
            let found = table.loads(gap, LoadSet::all(2)).unwrap();
            for (e, f) in expected.columns().zip(found.columns()) {
                assert!(
                    (e - f).abs() <= 3.0 * tolerance * e.abs().max(1.0),
                    "{gap:?}"
                );
            }
        }
    }
}

#[test]
fn a_table_with_swirl_agrees_with_its_model_and_leaves_the_other_loads_as_they_are() {
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
        Tabulated::build(model.clone(), options, &|_| ()).unwrap()
    };
    let (plain, two, four) = (tabulated(0), tabulated(2), tabulated(4));
    for i in 0..100 {
        let gap = Gap::from_ln(-6.9 + 0.19 * f64::from(i));
        let set = LoadSet::all(2).with_swirl(2);
        let (pair, swirl) = two.loads_with_swirl(gap, set).unwrap();
        let (_, expected) = model.loads_with_swirl(gap, set).unwrap();
        for (f, e) in swirl.columns().zip(expected.columns()) {
            assert!((e - f).abs() <= 3e-9 * e.abs().max(1.0), "{gap:?}");
        }
        let (_, more) = four
            .loads_with_swirl(gap, LoadSet::all(2).with_swirl(4))
            .unwrap();
        assert_eq!(
            more.modes()[..2],
            four.loads_with_swirl(gap, set).unwrap().1.modes()[..]
        );
        let alone = plain.loads(gap, LoadSet::all(2)).unwrap();
        for (with, without) in pair.columns().zip(alone.columns()) {
            assert!(
                (with - without).abs() <= 3e-9 * without.abs().max(1.0),
                "{gap:?}"
            );
        }
    }
    assert!(
        plain
            .loads_with_swirl(Gap::from_ln(0.0), LoadSet::all(2).with_swirl(1))
            .is_err()
    );
}

#[test]
fn a_table_reaches_to_infinity() {
    let table = table(None, 1e-14, 1e-10);
    let far = table
        .loads(Gap::new(1e15).unwrap(), LoadSet::all(2))
        .unwrap();
    for (found, isolated) in far
        .columns()
        .zip(PairLoads::isolated(LoadSet::all(2)).columns())
    {
        assert_relative_eq!(found, isolated, epsilon = 1e-9);
    }
}

#[test]
fn a_table_jumps_at_a_seam_as_its_model_does() {
    let table = table(Some(0.3), 1e-14, 1e-9);
    let at = |eps| {
        table
            .loads(Gap::new(eps).unwrap(), LoadSet::all(2))
            .unwrap()
            .ya
            .own()
    };
    assert_relative_eq!(at(0.3 + 1e-9) - at(0.3 - 1e-9), 1e-3, epsilon = 1e-8);
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
    let refused = table.loads(Gap::new(9.9e-4).unwrap(), LoadSet::all(2));
    assert!(matches!(refused, Err(SceneError::GapOutsideRange { .. })));
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
    let table = Tabulated::build(model, options, &|_| ()).unwrap();
    let gap = Gap::new(2e-3).unwrap();
    assert_eq!(
        table.loads(gap, LoadSet::all(2)),
        table.model().loads(gap, LoadSet::all(2))
    );
    assert_eq!(table.range(), table.model().range());
}

#[test]
fn fewer_modes_than_tabulated_are_read_and_more_refused() {
    let table = table(None, 1e-14, 1e-6);
    let gap = Gap::new(0.1).unwrap();
    let one = table.loads(gap, LoadSet::all(1)).unwrap();
    assert_eq!(
        one.modes(),
        &table.loads(gap, LoadSet::all(2)).unwrap().modes()[..1]
    );
    assert!(matches!(
        table.loads(gap, LoadSet::all(3)),
        Err(SceneError::LoadsNotHeld { .. })
    ));
}

#[test]
fn a_table_of_part_of_the_loads_holds_that_part_alone() {
    let whole = table(Some(0.3), 1e-5, 1e-5);
    for set in [
        LoadSet::axial(2),
        LoadSet::axial_and_twist(1),
        LoadSet::planar(2),
        LoadSet::all(3),
    ] {
        let options = TableOptions {
            set,
            tolerance: 1e-5,
            smallest_gap: 1e-3,
        };
        let part = Tabulated::build(Arc::clone(&whole.model), options, &|_| ()).unwrap();
        for piece in part.table.near.iter().chain(&part.table.far) {
            assert_eq!(piece.pair.columns, set.column_count());
            assert_eq!(piece.swirl.columns, 0);
        }
        for ln_gap in [-5.0, -1.0, 2.0] {
            let gap = Gap::from_ln(ln_gap);
            let found = part.loads(gap, set).unwrap();
            assert_eq!(found.set(), set);
            let truth = whole.model().loads(gap, set).unwrap();
            for ((name, a), (_, b)) in found.named().into_iter().zip(truth.named()) {
                assert!(
                    (a - b).abs() < 3e-5 * b.abs().max(1.0),
                    "{name} at {ln_gap}"
                );
            }
            if whole.table.set.holds(set) {
                assert_eq!(whole.loads(gap, set).unwrap().set(), set);
            }
        }
        assert!(part.loads(Gap::from_ln(0.0), LoadSet::all(4)).is_err());
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
    Tabulated::build(Says { made, cutoff }, options, progress).unwrap()
}

#[test]
fn a_table_keeps_the_cut_of_its_model() {
    let table = table_that_says(Some(1.0), None, &|_| ());
    assert_eq!(table.cutoff(), Some(1.0));
    assert!(table.summary().interpolation_error <= 1e-8);
    let set = LoadSet::all(2);
    for eps in [2e-3, 0.3, 1.0 - 1e-12, 1.0, 1.0 + 1e-12, 1.5, 2.5, 40.0] {
        let gap = Gap::new(eps).unwrap();
        let [found, truth] = [table.loads(gap, set), table.model().loads(gap, set)];
        let (_, error) = found.unwrap().worst_error(&truth.unwrap());
        assert!(error < 2e-8, "{eps}: {error}");
        // A trial step past the cut has the loads of spheres that interact.
        let found = table.interacting_loads(gap, set).unwrap();
        let (_, error) = found.worst_error(&table.model().interacting_loads(gap, set).unwrap());
        assert!(error < 2e-8, "{eps}: {error}");
        assert_eq!(table.error_estimate(gap, set), Ok(None));
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
