//! Where a model stops to resolve the gap, and contact.

use super::*;

/// Lubrication theory that answers from a gap on, as boundary elements do.
struct Resolving(Lubrication, f64);

impl Hydrodynamics for Resolving {
    fn description(&self) -> ModelDescription<'_> {
        ModelDescription::smooth(GapRange::from(self.1))
    }

    fn interacting_loads(&self, gap: Gap, set: LoadSet) -> Result<PairLoads, SceneError> {
        self.range().check(gap)?;
        self.0.interacting_loads(gap, set)
    }

    fn interacting_loads_with_swirl(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<(PairLoads, SwirlLoads), SceneError> {
        self.range().check(gap)?;
        self.0.interacting_loads_with_swirl(gap, set)
    }

    fn error_estimate(&self, gap: Gap, _: LoadSet) -> Result<Option<f64>, SceneError> {
        self.range().check(gap).map(|()| None)
    }

    fn fingerprint(&self) -> String {
        format!("lubrication theory from {}", self.1)
    }
}

#[test]
fn a_run_ends_where_its_model_ceases_to_resolve_the_gap() {
    let limit = 2.5e-4;
    let limited = Resolving(Lubrication::new(Form::Corrected), limit);
    // Without an end of its range it goes on.
    let endless = Resolving(Lubrication::new(Form::Corrected), 0.0);
    let neutral = Squirmer::with_beta(1.0, 1.0).unwrap();
    let swirling = neutral.with_swirl(&[0.0, 0.3]).unwrap();
    let facing = on_axis(0.5, [0.0, PI], [neutral; 2]);
    let reduced = Plan::new(&facing).unwrap();
    let swirling = on_axis(0.5, [0.02, PI - 0.01], [swirling, neutral]);
    for plan in [
        reduced.clone().without_symmetry(),
        reduced.clone().in_three_dimensions(),
        reduced,
        Plan::new(&on_axis(0.5, [0.01, PI + 0.01], [neutral; 2])).unwrap(),
        Plan::new(&swirling).unwrap(),
    ] {
        let run = run_plan(&plan, &limited, &RunOptions::default()).unwrap();
        assert_eq!(run.outcome, Outcome::Unresolved, "{}", plan.state());
        assert_relative_eq!(run.min_gap, limit, max_relative = 1e-12);
        assert_relative_eq!(run.end.gap.eps(), limit, max_relative = 1e-12);
        // Located: the same pair by the same loads is there at that time. The gap closes at a rate of 4 S L, about a hundred
        // times itself, so that what is left of 1e-8 a step in time is a hundred times that in the gap.
        let options = RunOptions {
            end_time: run.end_time,
            ..RunOptions::default()
        };
        let there = run_plan(&plan, &endless, &options).unwrap();
        println!("{}: gap then {:e}", plan.state(), there.end.gap.eps());
        assert_relative_eq!(there.end.gap.eps(), limit, max_relative = 1e-6);
        // And not by creeping up to it: steps shorten by no more than it takes to see the kink in the loads there.
        assert!(
            run.counters.steps <= there.counters.steps + 4,
            "{:?}",
            run.counters
        );
        assert!(
            run.counters.rejected <= there.counters.rejected + 16,
            "{:?}",
            run.counters
        );
    }
}

#[test]
fn a_gap_that_dips_below_the_range_within_a_step_is_found() {
    let puller = Squirmer::with_beta(1.0, 5.0).unwrap();
    let start = on_axis(0.5, [0.4, PI - 0.2], [puller; 2]);
    let scene = Scene::new(start.squirmers, start.start, Some(Repulsion::PAPER), None).unwrap();
    let form = Lubrication::new(Form::Corrected);
    let options = RunOptions {
        end_time: 20.0,
        ..RunOptions::default()
    };
    let run_from = |smallest: f64| run(&scene, &Resolving(form, smallest), &options).unwrap();
    let least = run_from(0.0).min_gap;
    // Just above and just below the smallest gap of the encounter.
    for (limit, ends) in [(least * (1.0 + 1e-6), true), (least * (1.0 - 1e-6), false)] {
        let run = run_from(limit);
        assert_eq!(
            run.outcome == Outcome::Unresolved,
            ends,
            "{limit:e} {}",
            run.outcome
        );
        let expected = if ends { limit } else { least };
        assert_relative_eq!(run.min_gap, expected, max_relative = 1e-7);
    }
}

#[test]
fn val_a_facing_pair_by_boundary_elements_ends_at_their_smallest_gap_when_the_exact_one_is_there() {
    let neutral = Squirmer::with_beta(1.0, 1.0).unwrap();
    let scene = on_axis(0.006, [0.0, PI], [neutral; 2]);
    let model = bem::Bem::new(1).unwrap();
    let options = RunOptions {
        tolerance: 1e-6,
        ..RunOptions::default()
    };
    let found = run(&scene, &model, &options).unwrap();
    assert_eq!(found.outcome, Outcome::Unresolved);
    let limit = model.range().smallest;
    assert_relative_eq!(found.min_gap, limit, max_relative = 1e-12);
    let options = RunOptions {
        end_time: found.end_time,
        ..options
    };
    let exact = run(&scene, &exact::Exact::new(), &options).unwrap();
    // Within 0.5 % of every load, the closing of ln(0.006/0.004) is off by as much of each of two loads.
    let within = 0.01 * (0.006_f64 / limit).ln();
    assert_relative_eq!(exact.end.gap.eps(), limit, max_relative = within);

    let below = on_axis(0.5 * limit, [0.0, PI], [neutral; 2]);
    let error = run(&below, &model, &options).unwrap_err().to_string();
    assert!(
        error.contains("is not resolved by mesh level 1: level 2 would do"),
        "{error}"
    );
}

#[test]
fn contact_ends_runs_on_every_state() {
    let model = Lubrication::new(Form::Corrected);
    let puller = Squirmer::with_beta(1.0, 2.0).unwrap();
    let scene = on_axis(0.1, [0.0, PI], [puller; 2]);
    let reduced = Plan::new(&scene).unwrap();
    assert_eq!(reduced.state(), State::Axisymmetric);
    let options = RunOptions {
        tolerance: 1e-11,
        ..RunOptions::default()
    };
    let time = |plan: &Plan| {
        let run = run_plan(plan, &model, &options).unwrap();
        assert_eq!(run.outcome, Outcome::Contact);
        run.end_time
    };
    let expected = time(&reduced);
    for plan in [
        reduced.clone().without_symmetry(),
        reduced.in_three_dimensions(),
    ] {
        assert_relative_eq!(time(&plan), expected, max_relative = 1e-8);
    }
}
