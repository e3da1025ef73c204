//! Symmetric pairs are solved for the half of the loads that they read: the same numbers, in less time.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::sync::Arc;
use std::time::Instant;

use bem::Bem;
use compare::{Approach, Case};
use exact::Exact;
use scene::mobility::MobilitySet;
use scene::{
    Gap, Hydrodynamics, LoadSet, ModelDescription, PairLoads, Plan, RunOptions, SceneError, State,
    SwirlLoads, TableOptions, Tabulated, run_plan,
};

/// Sets of symmetric pairs, and how many classes of the six they need.
fn sets() -> [(LoadSet, usize); 3] {
    [
        (LoadSet::axial(2).mirror_symmetric(), 1),
        (LoadSet::planar(2).mirror_symmetric(), 2),
        (LoadSet::planar(2).point_symmetric(), 2),
    ]
}

/// A model that is asked for both combinations whatever is read.
struct Both<'a, M>(&'a M);

impl<M: Hydrodynamics> Hydrodynamics for Both<'_, M> {
    fn description(&self) -> ModelDescription<'_> {
        self.0.description()
    }

    fn interacting_loads(&self, gap: Gap, set: LoadSet) -> Result<PairLoads, SceneError> {
        self.0.interacting_loads(gap, set.of_any_pair())
    }

    fn interacting_loads_with_swirl(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<(PairLoads, SwirlLoads), SceneError> {
        self.0.interacting_loads_with_swirl(gap, set)
    }

    fn error_estimate(&self, gap: Gap, set: LoadSet) -> Result<Option<f64>, SceneError> {
        self.0.error_estimate(gap, set)
    }

    fn fingerprint(&self) -> String {
        self.0.fingerprint()
    }
}

/// Reads the loads of `all` as if they were of `set`.
fn read_as(all: &PairLoads, set: LoadSet) -> Vec<(String, u64)> {
    let columns: Vec<_> = all.columns().collect();
    let part = PairLoads::from_columns(set, all.set(), &columns).named();
    part.into_iter().map(|(n, v)| (n, v.to_bits())).collect()
}

#[test]
fn loads_that_are_read_are_the_same_to_the_last_bit_whatever_else_is_solved() {
    let (exact, bem) = (Exact::new(), Bem::new(1).unwrap());
    for (set, classes) in sets() {
        for eps in [1e-6, 0.01, 0.7, 20.0, 5000.0] {
            let gap = Gap::new(eps).unwrap();
            let all = set.of_any_pair();
            let mut models: Vec<&dyn Hydrodynamics> = vec![&exact];
            if eps > 0.004 {
                models.push(&bem);
                assert_eq!(bem.solve(gap, set).unwrap().solves, classes);
            }
            for model in models {
                let half = model.loads(gap, set).unwrap();
                let whole = model.loads(gap, all).unwrap();
                assert_eq!(read_as(&half, set), read_as(&whole, set), "{set} at {eps}");
                // XA, XF_1, XF_2; across, YA, YB, YC and YF, YT of both modes too: one number of each.
                let read = if set.transverse.any() { 10 } else { 3 };
                assert_eq!(half.named().len(), read);
                // Errors are relative to the larger of the load and 1: two loads of this size may cancel.
                let size = (whole.named().iter()).fold(1.0, |size: f64, (_, v)| size.max(v.abs()));
                let of = |set| model.error_estimate(gap, set).unwrap().unwrap();
                assert!(of(set) > 0.0 && of(set) <= 2.0 * size * of(all));
            }
        }
    }
}

#[test]
fn symmetric_pairs_by_boundary_elements_move_the_same_to_the_last_bit_at_less_cost() {
    let bem = Bem::new(1).unwrap();
    for (dx, state) in [(0.0, State::Axisymmetric), (1.0, State::PointSymmetric)] {
        let case = Case {
            approach: Approach::HeadOn,
            beta: 1.0,
            dx,
            dz: 0.0,
        };
        let plan = Plan::new(&case.scene().unwrap()).unwrap();
        assert_eq!(plan.state(), state);
        let options = RunOptions {
            end_time: 4.0,
            tolerance: 1e-4,
            ..RunOptions::default()
        };
        let (started, before) = (Instant::now(), bem.solves());
        let half = run_plan(&plan, &bem, &options).unwrap();
        let (half_seconds, half_solves) = (started.elapsed(), bem.solves() - before);
        let (started, before) = (Instant::now(), bem.solves());
        let whole = run_plan(&plan, &Both(&bem), &options).unwrap();
        let (seconds, solves) = (started.elapsed(), bem.solves() - before);
        println!("{state}: {seconds:.2?} with both combinations, {half_seconds:.2?} with one");
        assert_eq!(half, whole);
        assert_eq!(solves, 2 * half_solves);
    }
}

#[test]
fn tables_for_symmetric_pairs_hold_what_these_read_within_their_tolerance() {
    for (set, _) in sets() {
        let options = TableOptions {
            set,
            tolerance: 1e-7,
            smallest_gap: 1e-3,
        };
        let table = Tabulated::build(Arc::new(Exact::new()), options, &|_| ()).unwrap();
        let reads = |loads| MobilitySet {
            loads,
            torque: true,
        };
        let all = reads(set.of_any_pair());
        assert!(table.mobility(Gap::new(0.1).unwrap(), all).is_err());
        for i in 0..60 {
            let gap = Gap::from_ln(-6.9 + 0.21 * f64::from(i));
            let named = |model: &dyn Hydrodynamics| {
                let mobility = model.mobility(gap, reads(set)).unwrap();
                mobility.named(reads(set))
            };
            for ((name, a), (_, b)) in named(&table).into_iter().zip(named(table.model())) {
                assert!(
                    (a - b).abs() < 3e-7 * b.abs().max(1.0),
                    "{set}: {name} at {gap:?}"
                );
            }
        }
    }
}
