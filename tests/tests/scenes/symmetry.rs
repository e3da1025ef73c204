//! Symmetric scenes run on half the state.

use super::*;

/// Scenes of identical squirmers with a symmetry, and the state that it allows.
fn symmetric_scenes() -> Vec<(Scene, State)> {
    let mut scenes = Vec::new();
    let push = |scenes: &mut Vec<_>, angles, beta: f64, gravity: Option<Gravity>, state| {
        let squirmer = Squirmer::with_beta(1.0, beta).unwrap();
        let squirmer = squirmer.bottom_heavy(if gravity.is_some() { 10.0 } else { 0.0 });
        let plain = on_axis(0.9, angles, [squirmer.unwrap(); 2]);
        let repulsion = Some(Repulsion::PAPER);
        let scene = Scene::new(plain.squirmers, plain.start, repulsion, gravity).unwrap();
        scenes.push((scene, state));
    };
    for beta in [-5.0, 1.0, 5.0] {
        for angle in [0.3, 1.0, -0.7, 1.5] {
            let opposed = [angle, PI + angle];
            let mirrored = [angle, PI - angle];
            push(&mut scenes, opposed, beta, None, State::PointSymmetric);
            push(&mut scenes, mirrored, beta, None, State::MirrorSymmetric);
            push(
                &mut scenes,
                mirrored,
                beta,
                Some(Gravity::DOWN),
                State::MirrorSymmetric,
            );
        }
        push(&mut scenes, [0.0, PI], beta, None, State::Axisymmetric);
    }
    scenes
}

#[test]
fn reduced_and_full_motion_have_the_same_rates_to_rounding() {
    // Units in the last place of the largest rate.
    const ROUNDING: f64 = 16.0 * f64::EPSILON;
    let model = Lubrication::new(Form::Published);
    for (scene, state) in symmetric_scenes() {
        let reduced = Plan::new(&scene).unwrap();
        assert_eq!(reduced.state(), state);
        let full = reduced.clone().without_symmetry();
        let configuration = reduced.start();
        for eps in [1e-9, 1e-3, 0.1, 0.9] {
            let at = scene::Configuration {
                radii: [1.0; 2],
                gap: Gap::new(eps).unwrap(),
                ..*configuration
            };
            let [a, b] = [&reduced, &full].map(|plan| rates(plan, &model, &at, 1).unwrap());
            let scale = b.ln_gap.abs().max(b.orientations[0].norm()).max(1.0);
            let close = |a: Vector3<f64>, b: Vector3<f64>| (a - b).norm() <= ROUNDING * scale;
            assert!(
                (a.ln_gap - b.ln_gap).abs() <= ROUNDING * scale,
                "{a:?} {b:?}"
            );
            assert!(
                close(a.midpoint, b.midpoint) && close(a.line, b.line),
                "{a:?} {b:?}"
            );
            for k in 0..2 {
                assert!(close(a.orientations[k], b.orientations[k]), "{a:?} {b:?}");
            }
        }
    }
}

#[test]
fn reduced_and_full_trajectories_agree() {
    // Over two time units at the tolerance 1e-12: long enough to collide, too short for an unstable
    // symmetric state to amplify rounding by more than a few hundred.
    let model = Lubrication::new(Form::Published);
    let options = RunOptions {
        tolerance: 1e-12,
        end_time: 2.0,
        ..RunOptions::default()
    };
    for (scene, state) in symmetric_scenes() {
        let plan = Plan::new(&scene).unwrap();
        let reduced = run_plan(&plan, &model, &options).unwrap();
        let full = run_plan(&plan.without_symmetry(), &model, &options).unwrap();
        assert_relative_eq!(reduced.end_time, full.end_time, epsilon = 1e-9);
        for k in 0..2 {
            let [a, b] = [&reduced, &full].map(|run| run.end.positions()[k]);
            assert_relative_eq!(a, b, epsilon = 2e-9);
            let [a, b] = [&reduced, &full].map(|run| run.end.angles_rad[k]);
            assert!((a - b).abs() < 2e-9, "{state}: {a} {b}");
        }
        assert_relative_eq!(reduced.min_gap, full.min_gap, max_relative = 1e-8);
    }
}

#[test]
fn a_settled_symmetric_pair_is_carried_on_to_where_the_full_motion_takes_it() {
    let family = compare::Family::named("incoming-angles").unwrap();
    let model = Lubrication::new(Form::Published);
    let options = RunOptions {
        tolerance: 1e-10,
        ..RunOptions::default()
    };
    for delta in [0.5, 0.8] {
        // Mirror images that come together and swim side by side along the mirror.
        let point = family.scene(&[("beta", 5.0), ("sigma", 1.0), ("delta", delta)]);
        let plan = Plan::new(&point.unwrap().scene).unwrap();
        assert_eq!(plan.state(), State::MirrorSymmetric);
        let reduced = run_plan(&plan, &model, &options).unwrap();
        let full = run_plan(&plan.without_symmetry(), &model, &options).unwrap();
        let settled = reduced.settled.unwrap();
        assert!(settled < options.end_time - 50.0, "{settled}");
        assert_eq!(reduced.outcome, scene::Outcome::Pairwise);
        assert_eq!(full.outcome, scene::Outcome::Pairwise);
        let [a, b] = [&reduced, &full].map(|run| run.end.midpoint);
        assert!(a.norm() > 1.0, "{a}");
        assert_relative_eq!(a, b, max_relative = 1e-9);
    }
}

#[test]
fn reduced_motion_is_symmetric_to_the_last_bit_for_ever() {
    let model = Lubrication::new(Form::Published);
    let options = RunOptions {
        sample_interval: Some(0.5),
        ..RunOptions::default()
    };
    for (scene, state) in symmetric_scenes() {
        let run = run(&scene, &model, &options).unwrap();
        for sample in &run.samples {
            let c = &sample.configuration;
            let [p1, p2] = c.orientations;
            match state {
                State::PointSymmetric => {
                    assert_eq!((p1, c.midpoint), (-p2, Vector3::zeros()));
                }
                State::MirrorSymmetric => {
                    assert_eq!((p1.y, -p1.x), (p2.y, p2.x));
                    assert_eq!((c.line, c.midpoint.x), (Vector3::x(), 0.0));
                }
                _ => assert_eq!(c.midpoint, Vector3::zeros()),
            }
        }
        let [one, two] = run.deflections_rad();
        let expected = if state == State::MirrorSymmetric {
            -one
        } else {
            one
        };
        assert!(
            (expected - two).abs() <= 1e-13 * one.abs().max(1.0),
            "{one} {two}"
        );
    }
}

#[test]
fn a_pair_that_swims_downward_in_a_mirror_does_so_to_the_end() {
    let run = ran(&scene_file("fig8e-downward"));
    assert_eq!(run.outcome, Outcome::Downward);
    assert!(run.end.midpoint.y < -100.0);
}

#[test]
fn plans_ask_for_the_symmetry_classes_that_their_state_needs() {
    for (scene, state) in symmetric_scenes() {
        let needed = Plan::new(&scene).unwrap().needed_loads();
        let classes: Vec<_> = (needed.symmetry_classes().iter())
            .map(ToString::to_string)
            .collect();
        let expected: &[&str] = match state {
            State::Axisymmetric => &["axial mirrored"],
            State::PointSymmetric => &["axial mirrored", "transverse opposite"],
            _ => &["axial mirrored", "transverse mirrored"],
        };
        assert_eq!(classes, expected);
    }
}

/// The loads of a model with one combination put out of place.
struct Disturbed {
    by: f64,
    which: usize,
}

impl scene::Hydrodynamics for Disturbed {
    fn description(&self) -> scene::ModelDescription<'_> {
        scene::ModelDescription::smooth(Lubrication::new(Form::Corrected).range())
    }

    fn interacting_loads(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<scene::PairLoads, scene::SceneError> {
        let set = LoadSet::all(set.modes);
        let loads = Lubrication::new(Form::Corrected).interacting_loads(gap, set)?;
        let mut columns: Vec<_> = loads.columns().collect();
        columns[self.which] *= 1.0 + self.by;
        columns[self.which] += self.by;
        Ok(scene::PairLoads::from_columns(set, set, &columns))
    }

    fn interacting_loads_with_swirl(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<(scene::PairLoads, scene::SwirlLoads), scene::SceneError> {
        Ok((
            self.interacting_loads(gap, set)?,
            scene::SwirlLoads::isolated(set),
        ))
    }

    fn error_estimate(&self, _: Gap, _: LoadSet) -> Result<Option<f64>, scene::SceneError> {
        Ok(None)
    }

    fn fingerprint(&self) -> String {
        "disturbed".to_owned()
    }
}

#[test]
fn val_the_loads_that_a_plan_names_are_those_that_its_motion_feels() {
    // Each combination of the loads in turn is disturbed: the rates must change if the plan names it, and
    // must not to the last bit if it does not. Columns: sum and difference of XA, YA, YB, XC, YC, then of
    // XF, YF, YT of each mode.
    let kinds = [
        "XA", "YA", "YB", "XC", "YC", "XF_1", "YF_1", "YT_1", "XF_2", "YF_2", "YT_2",
    ];
    let mut scenes = symmetric_scenes();
    let crooked = on_axis(0.9, [0.4, 2.0], scenes[0].0.squirmers);
    scenes.push((crooked, State::Planar));
    for (scene, state) in scenes {
        let plan = Plan::new(&scene).unwrap();
        let rates_of = |by: f64, which: usize| {
            rates(&plan, &Disturbed { by, which }, plan.start(), 1).unwrap()
        };
        let plain = rates_of(0.0, 0);
        let names = plan.needed_loads().names();
        for (kind, name) in kinds.iter().enumerate() {
            let (letters, rest) = name.split_at(2);
            let [own, other] = if rest.is_empty() {
                let (axis, kind) = letters.split_at(1);
                [format!("{axis}11{kind}"), format!("{axis}12{kind}")]
            } else {
                [format!("{letters}1{rest}"), format!("{letters}2{rest}")]
            };
            let both = names.contains(&format!("{own}, {other}"));
            for (offset, sign) in ["+", "-"].into_iter().enumerate() {
                let needed = both || names.contains(&format!("{own} {sign} {other}"));
                let changed = rates_of(0.1, 2 * kind + offset) != plain;
                assert_eq!(changed, needed, "{state}: {own} {sign} {other}");
            }
        }
    }
}
