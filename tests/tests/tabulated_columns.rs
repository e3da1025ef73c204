//! Tables hold the loads that the scenes at hand read, and no others are computed for them.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::f64::consts::PI;
use std::sync::{Arc, Mutex};

use bem::Bem;
use compare::study::maps::{Pair, unsymmetric_starts};
use compare::{Approach, Case, CompareError, Method, Model, ModelOptions, SceneFile};
use lt::{Form, Lubrication};
use scene::mobility::MobilitySet;
use scene::{
    Gap, GapRange, Gravity, Hydrodynamics, LoadSet, ModelDescription, Orientation, PairLoads, Plan,
    Pose, RunOptions, Scene, SceneError, Squirmer, SwirlLoads, TableOptions, Tabulated, run_plan,
};

/// A model that counts what it is asked for.
#[derive(Default)]
struct Counted {
    asked: Mutex<Vec<LoadSet>>,
}

impl Counted {
    fn note(&self, set: LoadSet) -> Lubrication {
        self.asked.lock().unwrap().push(set);
        Lubrication::new(Form::Corrected)
    }

    fn sets(&self) -> Vec<LoadSet> {
        let mut sets = self.asked.lock().unwrap().clone();
        sets.dedup();
        sets
    }
}

impl Hydrodynamics for Counted {
    fn description(&self) -> ModelDescription<'_> {
        ModelDescription::smooth(GapRange::from(1e-12))
    }

    fn interacting_loads(&self, gap: Gap, set: LoadSet) -> Result<PairLoads, SceneError> {
        self.note(set).interacting_loads(gap, set)
    }

    fn interacting_loads_with_swirl(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<(PairLoads, SwirlLoads), SceneError> {
        self.note(set).interacting_loads_with_swirl(gap, set)
    }

    fn error_estimate(&self, _: Gap, _: LoadSet) -> Result<Option<f64>, SceneError> {
        Ok(None)
    }

    fn fingerprint(&self) -> String {
        "counted".to_owned()
    }
}

/// Near contact, with the paper's repulsion left out.
fn scene(angles: [f64; 2], lift: f64, squirmer: Squirmer, gravity: Option<Gravity>) -> Scene {
    let start = [(-1.2, angles[0]), (1.2, angles[1])].map(|(x, angle)| Pose {
        position: [x, 0.0, lift * x].into(),
        orientation: Orientation::Radians(angle),
    });
    Scene::new([squirmer; 2], start, None, gravity).unwrap()
}

/// What a pair reads whose identical members face each other: no drift along the line of centres.
fn facing(modes: usize) -> LoadSet {
    LoadSet::axial(modes).mirror_symmetric()
}

/// Scenes with the loads that their motion reads.
fn scenes() -> Vec<(Scene, LoadSet)> {
    let plain = |beta: f64| Squirmer::with_beta(1.0, beta).unwrap();
    let heavy = plain(3.0).bottom_heavy(10.0).unwrap();
    let swirling = plain(3.0).with_swirl(&[0.0, 0.5]).unwrap();
    let down = Some(Gravity::DOWN);
    let all = LoadSet::all(2);
    let (turned, mirrored) = (scene([0.4, 0.4 + PI], 0.0, heavy, None), [0.4, PI - 0.4]);
    vec![
        (turned, LoadSet::planar(2).point_symmetric()),
        (
            scene(mirrored, 0.0, heavy, down),
            LoadSet::planar(2).mirror_symmetric(),
        ),
        (scene([0.4, 0.4], 0.0, plain(3.0), None), LoadSet::planar(2)),
        (scene([0.0, 0.0], 0.0, plain(3.0), None), LoadSet::axial(2)),
        (scene([0.0, PI], 0.0, plain(0.0), None), facing(1)),
        (scene([0.0, PI], 0.0, plain(3.0), None), facing(2)),
        (scene([0.4, 2.0], 0.0, plain(0.0), None), LoadSet::planar(1)),
        (scene([0.4, 2.0], 0.0, heavy, down), LoadSet::planar(2)),
        (scene([0.4, 2.0], 0.1, heavy, down), all),
        (scene([0.4, 2.0], 0.0, swirling, None), all.with_swirl(2)),
    ]
}

#[test]
fn a_run_reads_every_load_of_its_table_and_no_other_is_computed_for_it() {
    for (scene, set) in scenes() {
        let plan = Plan::new(&scene).unwrap();
        assert_eq!(plan.load_set(), set);
        let options = TableOptions {
            set: plan.load_set(),
            tolerance: 1e-3,
            smallest_gap: 1e-6,
        };
        let counted = Arc::new(Counted::default());
        let table = Tabulated::build(counted.clone(), options, &|_| ()).unwrap();
        // Modes 1 and 2 are tabulated together.
        let held = LoadSet { modes: 2, ..set };
        let asked = counted.sets().into_iter().reduce(LoadSet::union);
        assert_eq!((table.set(), asked), (held, Some(held)));
        // Run without a table, the motion asks for the same.
        let direct = Counted::default();
        let short = RunOptions {
            end_time: 0.01,
            tolerance: 1e-4,
            ..RunOptions::default()
        };
        run_plan(&plan, &direct, &short).unwrap();
        assert_eq!(direct.sets(), [set]);
    }
}

#[test]
fn tables_of_boundary_elements_solve_the_symmetry_classes_that_are_read() {
    let point = LoadSet::planar(1).point_symmetric();
    for (set, classes) in [
        (facing(1), 1),
        (LoadSet::axial(1), 2),
        (point, 2),
        (LoadSet::planar(1), 4),
    ] {
        let options = TableOptions {
            set,
            tolerance: 0.1,
            smallest_gap: 0.5,
        };
        let bem = Arc::new(Bem::new(1).unwrap());
        let table = Tabulated::build(bem.clone(), options, &|_| ()).unwrap();
        // Each class at gaps of its own, and once for lone spheres.
        assert_eq!(bem.solves(), table.summary().evaluations + classes);
    }
}

/// What a command tabulates for its scenes.
fn tabulated(scenes: impl IntoIterator<Item = Result<Scene, CompareError>>) -> LoadSet {
    let options = ModelOptions::default();
    options.for_scenes(scenes).unwrap().tabulated
}

#[test]
fn commands_tabulate_what_their_scenes_read() {
    let case = |beta: f64, dx: f64, dz: f64| {
        Case {
            approach: Approach::HeadOn,
            beta,
            dx,
            dz,
        }
        .scene()
    };
    let head_on = || case(0.0, 0.0, 0.0);
    assert_eq!(tabulated([head_on()]), facing(1));
    let options = ModelOptions {
        cache: None,
        ..ModelOptions::default()
    };
    let model = Model::set_up(Method::Exact, &options.for_scenes([head_on()]).unwrap()).unwrap();
    assert_eq!(model.tabulated(), Some(facing(2)));
    // What is read of the model is read from the table: the rest is refused.
    let gap = Gap::new(0.1).unwrap();
    let read = |loads| {
        let torque = false;
        model.mobility(gap, MobilitySet { loads, torque })
    };
    assert!(read(facing(2)).is_ok());
    assert!(matches!(
        read(LoadSet::axial(2)),
        Err(SceneError::LoadsNotHeld { .. })
    ));
    assert_eq!(tabulated([case(5.0, 0.0, 0.0)]), facing(2));
    let sweep = [case(0.0, 1.0, 0.0), case(5.0, 0.0, 0.0)];
    assert_eq!(tabulated(sweep), LoadSet::planar(2).point_symmetric());
    // Offset out of the plane too: in the plane of their paths they are each other's image.
    let point = LoadSet::planar(2).point_symmetric();
    assert_eq!(tabulated([case(5.0, 1.0, 0.5)]), point);
    let pairs = [(0.0, 0.0), (0.0, 10.0)].map(|(beta, g)| Pair { beta, g, dz: 0.0 });
    assert_eq!(tabulated(unsymmetric_starts(&pairs)), LoadSet::planar(1));
}

#[test]
fn val_the_unsymmetric_start_of_a_map_reads_what_any_other_reads() {
    for pair in [(0.0, 0.0, 0.0), (5.0, 10.0, 0.0), (1.0, 10.0, 0.5)] {
        let (beta, g, dz) = pair;
        let pair = Pair { beta, g, dz };
        let of = |scene: Scene| Plan::new(&scene).unwrap().load_set();
        let corner = of(unsymmetric_starts(&[pair]).next().unwrap().unwrap());
        for i in 0..=40 {
            for j in 0..=40 {
                let [delta, sigma] = [i, j].map(|k| 0.05 * f64::from(k));
                assert!(corner.holds(of(pair.scene(delta, sigma).unwrap())));
            }
        }
    }
}

#[test]
fn a_scene_file_tabulates_what_its_motion_reads_whatever_the_commands_share() {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../fixtures/scenes/fig2-neutral-standoff.toml"
    );
    let file = SceneFile::parse(&std::fs::read_to_string(path).unwrap()).unwrap();
    let plan = Plan::new(&file.scene).unwrap();
    let options = file.model_options(&plan, ModelOptions::default());
    assert_eq!(options.tabulated, facing(1));
}
