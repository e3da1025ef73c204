//! Which symmetry a scene has, to the last bit of its numbers, and in which plane it lies.

use nalgebra::Vector3;
use std::f64::consts::{PI, TAU};

use super::State;
use crate::frame::{Configuration, Plane};
use crate::{Gravity, Orientation, Scene};

/// The state without the use of exchange or axial symmetry, and the plane of the motion where that is not one
/// of constant z.
pub(super) fn full_state(
    scene: &Scene,
    start: &Configuration,
    gravity: Option<Gravity>,
    swirls: bool,
) -> (State, Option<Plane>) {
    // Swirl pushes squirmers out of any plane.
    if swirls {
        (State::Spatial, None)
    } else if is_level(scene, gravity) {
        (State::Planar, None)
    } else {
        let plane = Plane::of(scene, start, gravity);
        (plane.map_or(State::Spatial, |_| State::Planar), plane)
    }
}

/// Whether start and gravity lie in a plane of constant z, exactly.
fn is_level(scene: &Scene, gravity: Option<Gravity>) -> bool {
    let [one, two] = &scene.start;
    #[expect(clippy::float_cmp, reason = "level means exactly level")]
    let level = one.position.z == two.position.z;
    let flat = |orientation: Orientation| match orientation {
        Orientation::Radians(_) => true,
        Orientation::Vector(v) => v.z == 0.0,
    };
    level
        && scene.start.iter().all(|pose| flat(pose.orientation))
        && gravity.is_none_or(|gravity| gravity.direction().z == 0.0)
}

/// The state with the fewest numbers that holds the scene's motion, and the plane of the motion where that
/// is used and not one of constant z.
pub(super) fn smallest_state(
    scene: &Scene,
    start: &Configuration,
    gravity: Option<Gravity>,
    swirls: bool,
) -> (State, Option<Plane>) {
    if gravity.is_none() && is_axisymmetric(scene, start) {
        return (State::Axisymmetric, None);
    }
    let (full, plane) = full_state(scene, start, gravity, swirls);
    let [one, two] = &scene.squirmers;
    if full != State::Planar || one != two {
        return (full, plane);
    }
    // In a plane of constant z angles are as they were given; in another one they are rounded.
    let (start, rounding) = match &plane {
        Some(plane) => (plane.within(start), plane.rounding()),
        None => (*start, 0.0),
    };
    if gravity.is_none() && is_point_symmetric(&start, rounding) {
        return (State::PointSymmetric, plane);
    }
    // A mirror that holds the direction of gravity is one of gravity's too.
    let across = |gravity: Gravity| {
        let gravity = (plane.as_ref()).map_or(gravity, |plane| plane.gravity_within(gravity));
        gravity.direction().dot(&start.line).abs() <= rounding
    };
    if gravity.is_none_or(across) && is_mirror_symmetric(&start, rounding) {
        return (State::MirrorSymmetric, plane);
    }
    (full, plane)
}

/// Whether both orientations lie along the line of centres.
fn is_axisymmetric(scene: &Scene, start: &Configuration) -> bool {
    let separation = scene.start[1].position - scene.start[0].position;
    let parallel = |v: &Vector3<f64>| v.cross(&separation) == Vector3::zeros();
    [0, 1]
        .into_iter()
        .all(|k| match scene.start[k].orientation {
            Orientation::Vector(v) => parallel(&v),
            // The sine of pi is not zero in floating-point numbers: half turns are counted.
            Orientation::Radians(angle) => {
                separation.z == 0.0 && (angle - start.line_angle_rad) % PI == 0.0
            }
        })
}

/// Whether the second orientation is opposed to the first.
fn is_point_symmetric(start: &Configuration, rounding: f64) -> bool {
    let [one, two] = start.angles_rad;
    same_direction(two, one + PI, one, rounding)
}

/// Whether the second orientation is the image of the first in the mirror between the two.
fn is_mirror_symmetric(start: &Configuration, rounding: f64) -> bool {
    let [one, two] = start.angles_rad;
    same_direction(two, 2.0 * start.line_angle_rad + PI - one, one, rounding)
}

/// Whether two angles differ by whole turns and no more than the last bit of the largest of the three
/// angles, the image of an angle being rounded where no closer number may exist, and what the rounding of
/// directions adds to each of the three.
fn same_direction(angle: f64, image: f64, of: f64, rounding: f64) -> bool {
    let largest = angle.abs().max(image.abs()).max(of.abs());
    let last_bit = largest.next_up() - largest;
    let difference = angle - image;
    let turns = (difference / TAU).round();
    (difference - turns * TAU).abs() <= last_bit + 3.0 * rounding
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Plan, Pose, Squirmer};
    use nalgebra::Rotation3;
    use std::f64::consts::FRAC_PI_2;

    fn scene(positions: [[f64; 3]; 2], angles: [f64; 2], betas: [f64; 2]) -> Scene {
        let start = [0, 1].map(|k| Pose {
            position: positions[k].into(),
            orientation: Orientation::Radians(angles[k]),
        });
        let squirmers = betas.map(|beta| {
            let squirmer = Squirmer::with_beta(1.0, beta).unwrap();
            squirmer.bottom_heavy(3.0).unwrap()
        });
        Scene::new(squirmers, start, None, None).unwrap()
    }

    fn state(scene: &Scene) -> State {
        Plan::new(scene).unwrap().state()
    }

    const LEVEL: [[f64; 3]; 2] = [[-1.5, 0.0, 0.0], [1.5, 0.0, 0.0]];

    #[test]
    fn opposed_squirmers_are_point_symmetric_wherever_they_start() {
        for dx in [0.1, 1.0, 2.0, 3.0, 7.3] {
            let positions = [[-0.5 * dx, 5.0, 0.0], [0.5 * dx, -5.0, 0.0]];
            let opposed = scene(positions, [-FRAC_PI_2, FRAC_PI_2], [5.0; 2]);
            assert_eq!(state(&opposed), State::PointSymmetric);
            let unlike = scene(positions, [-FRAC_PI_2, FRAC_PI_2], [5.0, 4.0]);
            assert_eq!(state(&unlike), State::Planar);
        }
    }

    #[test]
    fn mirror_symmetric_starts_are_found_for_every_delta() {
        for i in 0..200 {
            let delta = 0.01 * f64::from(i);
            let angles = [FRAC_PI_2 * (1.0 - delta), FRAC_PI_2 * (1.0 + delta)];
            let found = state(&scene(LEVEL, angles, [1.0; 2]));
            let expected = if i == 100 {
                State::Axisymmetric
            } else {
                State::MirrorSymmetric
            };
            assert_eq!(found, expected, "{delta}");
        }
    }

    #[test]
    fn an_asymmetry_of_a_few_last_bits_counts() {
        let angles = [FRAC_PI_2 - 1.0, FRAC_PI_2 + 1.0 + 4e-15];
        assert_eq!(state(&scene(LEVEL, angles, [1.0; 2])), State::Planar);
    }

    #[test]
    fn gravity_breaks_all_symmetries_but_the_mirror_that_holds_it() {
        let with = |angles: [f64; 2], direction: [f64; 3]| {
            let plain = scene(LEVEL, angles, [1.0; 2]);
            let gravity = Gravity::new(direction.into()).unwrap();
            state(&Scene::new(plain.squirmers, plain.start, None, Some(gravity)).unwrap())
        };
        let (mirrored, opposed) = ([0.5, PI - 0.5], [0.5, PI + 0.5]);
        assert_eq!(with(mirrored, [0.0, -1.0, 0.0]), State::MirrorSymmetric);
        assert_eq!(with(mirrored, [0.1, -1.0, 0.0]), State::Planar);
        assert_eq!(with(opposed, [0.0, -1.0, 0.0]), State::Planar);
        assert_eq!(with([0.0, PI], [0.0, -1.0, 0.0]), State::MirrorSymmetric);
        assert_eq!(with([0.0, PI], [0.0, 0.0, -1.0]), State::MirrorSymmetric);
        assert_eq!(with(mirrored, [0.0, 0.0, -1.0]), State::Spatial);
    }

    #[test]
    fn a_pair_on_an_oblique_axis_in_space_is_axisymmetric() {
        let axis = Vector3::new(1.0, 2.0, -3.0);
        let pose = |along: f64, sign: f64| Pose {
            position: axis * along,
            orientation: Orientation::Vector(axis * sign),
        };
        let squirmers = [5.0, -1.0].map(|beta| Squirmer::with_beta(1.0, beta).unwrap());
        let chase = Scene::new(squirmers, [pose(0.0, 1.0), pose(2.0, 0.5)], None, None);
        assert_eq!(state(&chase.unwrap()), State::Axisymmetric);
    }

    /// The scene with the x-y plane turned into the x-z plane and about an oblique axis.
    fn turned(scene: &Scene) -> [Scene; 2] {
        let oblique = Rotation3::new(Vector3::new(0.7, -1.1, 0.4));
        let upright = |v: Vector3<f64>| Vector3::new(v.x, 0.0, v.y);
        let turns: [&dyn Fn(Vector3<f64>) -> Vector3<f64>; 2] = [&upright, &|v| oblique * v];
        turns.map(|turn| {
            let start = scene.start.map(|pose| Pose {
                position: turn(pose.position),
                orientation: Orientation::Vector(turn(pose.orientation.vector().unwrap())),
            });
            let gravity = (scene.gravity).map(|g| Gravity::new(turn(g.direction())).unwrap());
            Scene::new(scene.squirmers, start, scene.repulsion, gravity).unwrap()
        })
    }

    #[test]
    fn a_scene_has_the_state_that_it_has_in_the_x_y_plane_in_any_other_plane() {
        let mirrored = [0.5, PI - 0.5];
        for (angles, betas, gravity) in [
            ([0.5, 1.7], [5.0; 2], None),
            ([0.5, 0.5 + PI], [5.0; 2], None),
            (mirrored, [5.0; 2], None),
            (mirrored, [5.0, 4.0], None),
            (mirrored, [5.0; 2], Some(Gravity::DOWN)),
            ([0.5, 0.5 + PI], [5.0; 2], Some(Gravity::DOWN)),
            ([0.0, PI], [5.0; 2], Some(Gravity::DOWN)),
        ] {
            let level = scene(LEVEL, angles, betas);
            let level = Scene { gravity, ..level };
            for turned in turned(&level) {
                let plan = Plan::new(&turned).unwrap();
                assert_eq!(plan.state(), state(&level), "{angles:?} {gravity:?}");
                assert!(plan.plane().is_some());
                let full = plan.without_symmetry();
                assert_eq!(full.state(), State::Planar);
                assert!(full.in_three_dimensions().plane().is_none());
            }
            assert!(Plan::new(&level).unwrap().plane().is_none());
        }
    }

    #[test]
    fn opposed_squirmers_offset_out_of_the_plane_are_point_symmetric_and_crossing_ones_spatial() {
        for dz in [1e-9, 0.1, 2.0] {
            let positions = [[-0.5, 5.0, 0.5 * dz], [0.5, -5.0, -0.5 * dz]];
            let opposed = scene(positions, [-FRAC_PI_2, FRAC_PI_2], [5.0; 2]);
            assert_eq!(state(&opposed), State::PointSymmetric, "{dz}");
            let crossing = scene(positions, [0.0, FRAC_PI_2], [5.0; 2]);
            assert_eq!(state(&crossing), State::Spatial, "{dz}");
        }
    }

    #[test]
    fn what_leaves_its_plane_is_spatial() {
        for turned in turned(&scene(LEVEL, [0.5, 1.7], [5.0; 2])) {
            let swirling = turned.squirmers.map(|s| s.with_swirl(&[0.0, 0.1]).unwrap());
            let swirling = Scene::new(swirling, turned.start, None, None).unwrap();
            assert_eq!(state(&swirling), State::Spatial);
            let plane = Plan::new(&turned).unwrap().plane().unwrap().normal();
            let tilted = Gravity::new(plane * 1e-12 + turned.start[0].position).unwrap();
            let heavy = Scene::new(turned.squirmers, turned.start, None, Some(tilted)).unwrap();
            assert_eq!(state(&heavy), State::Spatial);
            let mut nudged = turned;
            nudged.start[1].position += plane * 1e-13;
            assert_eq!(state(&nudged), State::Spatial);
        }
    }

    #[test]
    fn a_motion_is_level_if_it_stays_in_a_plane_of_constant_z() {
        let of = |headings: [[f64; 3]; 2], at: [f64; 3]| {
            let pose = |position: [f64; 3], heading: [f64; 3]| Pose {
                position: position.into(),
                orientation: Orientation::Vector(heading.into()),
            };
            let squirmers = [1.0, 2.0].map(|beta| Squirmer::with_beta(1.0, beta).unwrap());
            let start = [pose([0.0; 3], headings[0]), pose(at, headings[1])];
            Plan::new(&Scene::new(squirmers, start, None, None).unwrap())
                .unwrap()
                .is_level()
        };
        let flat = [[0.6, 0.8, 0.0], [-0.8, 0.6, 0.0]];
        assert!(of(flat, [4.0, 1.0, 0.0]));
        assert!(!of(flat, [4.0, 1.0, 0.5]));
        // Along the line of centres, level and not.
        assert!(of([[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]], [4.0, 0.0, 0.0]));
        assert!(!of([[0.0, 0.6, 0.8], [0.0, -0.6, -0.8]], [0.0, 2.4, 3.2]));
        // In a plane that is tilted.
        assert!(!of([[0.0, 0.6, 0.8], [1.0, 0.0, 0.0]], [0.0, 2.4, 3.2]));
    }
}
