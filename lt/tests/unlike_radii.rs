//! Collisions of squirmers of unlike radii by lubrication theory: what holds whatever the radii.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use approx::assert_relative_eq;
use lt::{Form, Lubrication, UnlikeLubrication};
use scene::nalgebra::{Rotation3, Unit, Vector3};
use scene::{
    Gravity, Hydrodynamics, Orientation, Outcome, Pose, Repulsion, Run, RunOptions, Scene,
    SceneError, Squirmer, run,
};

/// A squirmer with swirl and bottom-heaviness, of some radius.
#[derive(Clone, Copy)]
struct Body {
    beta: f64,
    swirl: f64,
    g_bh: f64,
    radius: f64,
}

impl Body {
    fn squirmer(&self, unit: f64) -> Squirmer {
        Squirmer::with_beta(1.0, self.beta)
            .and_then(|s| s.with_swirl(&[0.0, self.swirl]))
            .and_then(|s| s.bottom_heavy(self.g_bh))
            .and_then(|s| s.with_radius(self.radius / unit))
            .unwrap()
    }
}

const SMALL: Body = Body {
    beta: 3.0,
    swirl: 0.0,
    g_bh: 0.0,
    radius: 1.0,
};

const LARGE: Body = Body {
    beta: -1.0,
    radius: 2.5,
    ..SMALL
};

const TOLERANCE: f64 = 1e-11;

/// Two squirmers that meet, in some frame: positions, headings and gravity turned by `turn`, the first of `order` the first of the scene,
/// whose radius is the unit of length.
fn meet(
    bodies: [Body; 2],
    order: [usize; 2],
    turn: &Rotation3<f64>,
    gravity: Option<Vector3<f64>>,
    tilt: f64,
) -> (Run, f64) {
    let unit = bodies[order[0]].radius;
    let start = [
        ([-3.0, 4.0, 0.0], [0.3, -1.0, 0.0]),
        ([1.0, -3.0, 0.3 * tilt], [-0.2, 0.9, tilt]),
    ]
    .map(|(position, heading)| Pose {
        position: turn * Vector3::from(position) / unit,
        orientation: Orientation::Vector(turn * Vector3::from(heading)),
    });
    // The same force in other units of length.
    let repulsion = Repulsion::new(10.0 / (unit * unit), 100.0 * unit).unwrap();
    let scene = Scene::new(
        order.map(|k| bodies[k].squirmer(unit)),
        order.map(|k| start[k]),
        Some(repulsion),
        gravity.map(|g| Gravity::new(turn * g).unwrap()),
    )
    .unwrap();
    let options = RunOptions {
        end_time: 30.0 / unit,
        tolerance: TOLERANCE,
        ..RunOptions::default()
    };
    let model = UnlikeLubrication::new(Form::Corrected, scene.ratio()).unwrap();
    (run(&scene, &model, &options).unwrap(), unit)
}

/// Kinds of scenes: planar, in three dimensions, with gravity, with swirl and gravity.
fn kinds() -> [([Body; 2], Option<Vector3<f64>>, f64); 4] {
    let heavy = |body: Body| Body { g_bh: 4.0, ..body };
    let swirling = |body: Body| Body { swirl: 2.0, ..body };
    let down = Vector3::new(0.1, -1.0, 0.3);
    [
        ([SMALL, LARGE], None, 0.0),
        ([SMALL, LARGE], None, 0.2),
        ([SMALL, LARGE].map(heavy), Some(down), 0.2),
        (
            [SMALL, LARGE].map(|body| swirling(heavy(body))),
            Some(down),
            0.1,
        ),
    ]
}

#[test]
fn val_the_same_pair_named_the_other_way_round_moves_alike() {
    let still = Rotation3::identity();
    for (bodies, gravity, tilt) in kinds() {
        let (one, _) = meet(bodies, [0, 1], &still, gravity, tilt);
        let (two, unit) = meet(bodies, [1, 0], &still, gravity, tilt);
        assert!(one.min_gap < 0.5, "they meet: {one:?}");
        assert_eq!(one.outcome, two.outcome);
        assert_relative_eq!(one.min_gap, two.min_gap * unit, max_relative = 1e-7);
        assert_relative_eq!(one.contact_time, two.contact_time * unit, epsilon = 1e-7);
        for k in [0, 1] {
            let (a, b) = (one.end.orientations[k], two.end.orientations[1 - k]);
            assert_relative_eq!(a, b, epsilon = 1e-6);
            let (a, b) = (one.end.positions()[k], two.end.positions()[1 - k] * unit);
            assert_relative_eq!(a, b, epsilon = 1e-5);
        }
    }
}

#[test]
fn val_a_turned_pair_moves_alike() {
    let turn = Rotation3::from_axis_angle(&Unit::new_normalize(Vector3::new(1.0, -2.0, 0.5)), 2.0);
    let still = Rotation3::identity();
    for (bodies, gravity, tilt) in kinds() {
        let (one, _) = meet(bodies, [0, 1], &still, gravity, tilt);
        let (two, _) = meet(bodies, [0, 1], &turn, gravity, tilt);
        assert_eq!(one.outcome, two.outcome);
        for k in [0, 1] {
            let (a, b) = (one.end.orientations[k], two.end.orientations[k]);
            assert_relative_eq!(turn * a, b, epsilon = 1e-6);
        }
    }
}

#[test]
fn radii_that_are_almost_equal_move_as_equal_ones() {
    let nearly = |radius: f64| {
        let squirmers = [
            Squirmer::with_beta(1.0, 3.0).unwrap(),
            Squirmer::with_beta(1.0, -1.0)
                .and_then(|s| s.with_radius(radius))
                .unwrap(),
        ];
        let start = [
            Pose::planar(-0.4, 4.0, -80.0),
            Pose::planar(0.5, -4.0, 95.0),
        ];
        let scene = Scene::new(squirmers, start, Some(Repulsion::PAPER), None).unwrap();
        let options = RunOptions {
            tolerance: TOLERANCE,
            ..RunOptions::default()
        };
        if radius > 1.0 {
            let model = UnlikeLubrication::new(Form::Published, radius).unwrap();
            run(&scene, &model, &options).unwrap()
        } else {
            run(&scene, &Lubrication::new(Form::Published), &options).unwrap()
        }
    };
    let (equal, unlike) = (nearly(1.0), nearly(1.0 + 1e-11));
    assert!(equal.min_gap < 0.1);
    for k in [0, 1] {
        let [a, b] = [&equal, &unlike].map(|run| run.deflections_rad()[k]);
        assert_relative_eq!(a, b, epsilon = 1e-7);
    }
}

#[test]
fn passive_spheres_rest_and_a_passive_one_is_pushed_along() {
    let passive = |radius: f64| Squirmer::new(&[]).unwrap().with_radius(radius).unwrap();
    let start = [Pose::planar(0.0, 0.0, 0.0), Pose::planar(3.6, 0.0, 0.0)];
    let model = UnlikeLubrication::new(Form::Corrected, 2.0).unwrap();
    let options = RunOptions {
        end_time: 20.0,
        ..RunOptions::default()
    };
    let rest = Scene::new([passive(1.0), passive(2.0)], start, None, None).unwrap();
    let rest = run(&rest, &model, &options).unwrap();
    assert_relative_eq!(rest.end.midpoint, rest.start.midpoint);
    assert_relative_eq!(rest.min_gap, 0.6, max_relative = 1e-14);
    let swimmer = Squirmer::with_beta(1.0, 0.0).unwrap();
    let pair = [swimmer, passive(2.0)];
    let pushed = Scene::new(pair, start, Some(Repulsion::PAPER), None).unwrap();
    let pushed = run(&pushed, &model, &options).unwrap();
    assert_eq!(pushed.outcome, Outcome::Pairwise);
    // The two swim as one: the thrust of the first against the drag of both, V_s/(1 + 2), as long as lubrication theory has no more.
    let speed = (pushed.end.midpoint - pushed.start.midpoint).norm() / pushed.end_time;
    assert_relative_eq!(speed, 1.0 / 3.0, epsilon = 0.02);
}

#[test]
fn a_model_of_other_radii_is_refused() {
    let pair = [
        Squirmer::with_beta(1.0, 0.0).unwrap(),
        Squirmer::with_beta(1.0, 0.0)
            .and_then(|s| s.with_radius(2.0))
            .unwrap(),
    ];
    let start = [Pose::planar(0.0, 0.0, 0.0), Pose::planar(5.0, 0.0, 180.0)];
    let scene = Scene::new(pair, start, None, None).unwrap();
    let options = RunOptions::default();
    let equal = run(&scene, &Lubrication::new(Form::Published), &options);
    let other = SceneError::OtherRatio {
        model: 1.0,
        asked: 2.0,
    };
    assert_eq!(equal, Err(other));
    let model = UnlikeLubrication::new(Form::Published, 2.0).unwrap();
    let gap = scene.gap().unwrap();
    let set = scene::mobility::MobilitySet {
        loads: scene::LoadSet::planar(2),
        torque: false,
    };
    let of_equal = model.interacting_mobilities(gap, set);
    assert!(matches!(of_equal, Err(SceneError::OtherRatio { .. })));
    let [second, first] = pair;
    let turned = Scene::new([first, second], start, None, None);
    assert_eq!(turned, Err(SceneError::FirstRadius { radius: 2.0 }));
    let huge = Squirmer::new(&[]).unwrap().with_radius(101.0);
    assert!(matches!(huge, Err(SceneError::Radius { .. })));
}

#[test]
fn ratios_that_no_scene_has_are_refused() {
    // Powers of them are no numbers: X11A was NaN.
    for ratio in [7.45e181, 1e-200, 100.1, 0.0099] {
        let refused = UnlikeLubrication::new(Form::Corrected, ratio);
        assert!(
            matches!(refused, Err(scene::SceneError::Radius { .. })),
            "{ratio}: {refused:?}"
        );
    }
    for ratio in [0.01, 100.0] {
        assert!(UnlikeLubrication::new(Form::Corrected, ratio).is_ok());
    }
}
