//! Spheres of any radii in the laboratory's frame, and pairs of them against the pair frame: slip is solved for here, and follows
//! from the reciprocal theorem there.

use std::f64::consts::PI;

use approx::assert_relative_eq;
use bem::{Bem, BemError, Body, Lab, Load, Motion};
use exact::Exact;
use nalgebra::{UnitQuaternion, Vector3};
use scene::{ActiveLoads, Gap, Hydrodynamics, LoadSet, SelfOther};

const SET: LoadSet = LoadSet::all(2).with_swirl(2);

fn gap(eps: f64) -> Gap {
    Gap::new(eps).unwrap()
}

/// Unit vectors: from a sphere to the other one, across that, and across both.
#[derive(Clone, Copy)]
struct Frame {
    d: Vector3<f64>,
    t: Vector3<f64>,
    c: Vector3<f64>,
}

impl Frame {
    fn new(d: Vector3<f64>, t: Vector3<f64>) -> Self {
        Self {
            d,
            t,
            c: d.cross(&t),
        }
    }
}

/// What one sphere does: it moves in the plane of d and t, turns about d and c, squirms and swirls.
struct Deed {
    velocity: [f64; 2],
    spin: [f64; 2],
    /// Angle of its orientation from d towards t.
    angle: f64,
    modes: [f64; 2],
    swirl: [f64; 2],
}

/// Loads on the sphere itself and on the other one, by the definitions of `scene::active_loads`.
fn by_definition(deed: &Deed, loads: &ActiveLoads, a: f64, frame: Frame) -> [Load; 2] {
    let Frame { d, t, c } = frame;
    let (cosine, sine) = (deed.angle.cos(), deed.angle.sin());
    let [along, across] = [[cosine, 1.5 * cosine * cosine - 0.5], [sine, cosine * sine]];
    [0, 1].map(|k| {
        let of = |s: SelfOther| if k == 0 { s.own() } else { s.other() };
        let rigid = &loads.pair;
        let crossed = if k == 0 {
            rigid.yb.own()
        } else {
            loads.torque_on_other
        };
        let [u_d, u_t] = deed.velocity;
        let [w_d, w_c] = deed.spin;
        let mut force = (d * (of(rigid.xa) * u_d) + t * (of(rigid.ya) * u_t)) * (-6.0 * PI * a)
            + t * (4.0 * PI * a * a * of(rigid.yb) * w_c);
        let mut torque = c * (4.0 * PI * a * a * crossed * u_t)
            - (d * (of(rigid.xc) * w_d) + c * (of(rigid.yc) * w_c)) * (8.0 * PI * a * a * a);
        for n in 0..2 {
            let (mode, b) = (rigid.mode(n), PI * a * deed.modes[n]);
            force += (d * (along[n] * of(mode.xf)) + t * (across[n] * of(mode.yf))) * b;
            torque += c * (across[n] * of(mode.yt) * b * a);
            let (mode, b) = (loads.swirl.modes()[n], PI * a * deed.swirl[n]);
            force += c * (across[n] * of(mode.yfc) * b);
            torque += (d * (along[n] * of(mode.xtc)) + t * (across[n] * of(mode.ytc))) * (b * a);
        }
        Load { force, torque }
    })
}

/// The largest difference of a force or torque in the laboratory and by definition from the loads of a model, relative to drags of the larger sphere.
fn worst(level: usize, ratio: f64, eps: f64) -> f64 {
    let turn = UnitQuaternion::from_euler_angles(0.4, 1.0, -0.7);
    let (d, t) = (turn * Vector3::z(), turn * Vector3::x());
    let deeds = [
        Deed {
            velocity: [0.3, -0.5],
            spin: [0.8, 0.4],
            angle: 0.8,
            modes: [0.7, -1.3],
            swirl: [0.2, 0.9],
        },
        Deed {
            velocity: [-0.2, 0.6],
            spin: [-0.5, 0.3],
            angle: 2.1,
            modes: [-0.4, 1.1],
            swirl: [0.5, -0.6],
        },
    ];
    let (radii, frames) = ([1.0, ratio], [Frame::new(d, t), Frame::new(-d, t)]);
    let model = Bem::of_ratio(level, ratio).unwrap();
    let loads = model.interacting_loads_of_each(gap(eps), SET).unwrap();
    let [one, two] = [0, 1].map(|k| by_definition(&deeds[k], &loads[k], radii[k], frames[k]));
    let expected = [(one[0], two[1]), (one[1], two[0])];
    let start = Vector3::new(0.1, 0.2, 0.3);
    let bodies = [0, 1].map(|k| {
        let Deed {
            angle,
            modes,
            swirl,
            ..
        } = &deeds[k];
        let p = frames[k].d * angle.cos() + frames[k].t * angle.sin();
        let place = start + d * (k as f64 * (1.0 + ratio + eps));
        Body {
            swirl: swirl.to_vec(),
            // Meshes turned about the line of centres, so that nothing is symmetric.
            mesh_rotation: UnitQuaternion::from_scaled_axis(d * (0.3 + 0.5 * k as f64)),
            ..Body::squirmer(place, p, modes).with_radius(radii[k])
        }
    });
    let motions = [0, 1].map(|k| Motion {
        velocity: frames[k].d * deeds[k].velocity[0] + frames[k].t * deeds[k].velocity[1],
        angular_velocity: frames[k].d * deeds[k].spin[0] + frames[k].c * deeds[k].spin[1],
    });
    let found = Lab::new(level, &bodies).unwrap().loads(&motions).unwrap();
    let larger = ratio.max(1.0);
    let mut worst: f64 = 0.0;
    for (load, (a, b)) in found.iter().zip(expected) {
        let force = (load.force - a.force - b.force).norm() / (6.0 * PI * larger);
        let torque = (load.torque - a.torque - b.torque).norm() / (8.0 * PI * larger.powi(3));
        worst = worst.max(force).max(torque);
    }
    worst
}

#[test]
fn loads_of_the_pair_frame_are_those_of_the_laboratory_in_any_motion_and_slip() {
    for (level, ratio, eps, bound) in [
        (1, 0.5, 0.2, 5e-3),
        (1, 3.0, 0.3, 5e-3),
        (2, 0.5, 1.5, 5e-4),
    ] {
        let off = worst(level, ratio, eps);
        println!("level {level}, ratio {ratio}, gap {eps}: {off:e}");
        assert!(off < bound, "ratio {ratio}, gap {eps}: {off:e}");
    }
}

#[test]
fn a_larger_sphere_has_more_drag_and_swims_as_fast() {
    let (radius, p) = (2.5, Vector3::new(1.0, 2.0, -2.0) / 3.0);
    let body = Body::squirmer(Vector3::new(0.4, 0.0, 1.0), p, &[1.5, 3.0]).with_radius(radius);
    let lab = Lab::new(2, &[body]).unwrap();
    let swims = lab.free_motions().unwrap()[0];
    assert_relative_eq!(swims.velocity, p, epsilon = 1e-3);
    assert_relative_eq!(swims.angular_velocity, Vector3::zeros(), epsilon = 1e-4);
    let moved = |velocity, angular_velocity| {
        let motion = Motion {
            velocity,
            angular_velocity,
        };
        lab.loads(&[motion]).unwrap()[0]
    };
    let [still, drawn, turned] = [
        moved(Vector3::zeros(), Vector3::zeros()),
        moved(Vector3::x(), Vector3::zeros()),
        moved(Vector3::zeros(), Vector3::y()),
    ];
    let drag = drawn.force - still.force;
    assert_relative_eq!(drag.x, -6.0 * PI * radius, max_relative = 1e-4);
    let torque = turned.torque - still.torque;
    assert_relative_eq!(torque.y, -8.0 * PI * radius.powi(3), max_relative = 1e-3);
}

#[test]
fn a_pair_of_twice_the_size_moves_as_fast_and_turns_half_as_fast() {
    let motions = |size: f64| {
        let [one, two] = [0.0, 1.0].map(|side| Vector3::new(0.0, 2.9, 1.0) * (side * size));
        let bodies = [
            Body::squirmer(one, Vector3::new(0.3, 0.9, 0.1), &[1.0, 2.0]).with_radius(size),
            Body::squirmer(two, Vector3::new(0.8, -0.2, 0.5), &[1.0, -2.0]).with_radius(1.5 * size),
        ];
        Lab::new(1, &bodies).unwrap().free_motions().unwrap()
    };
    for (small, large) in motions(1.0).into_iter().zip(motions(2.0)) {
        assert_relative_eq!(small.velocity, large.velocity, epsilon = 1e-9);
        let twice = large.angular_velocity * 2.0;
        assert_relative_eq!(small.angular_velocity, twice, epsilon = 1e-9);
    }
}

#[test]
fn spheres_that_overlap_and_radii_that_are_none_are_refused() {
    let at = |x: f64, radius: f64| Body::rigid(Vector3::new(x, 0.0, 0.0)).with_radius(radius);
    // Spheres of radius 1 would be apart.
    let refused = Lab::new(1, &[at(0.0, 1.0), at(2.9, 2.0)]).unwrap_err();
    assert!(matches!(refused, BemError::Overlap { .. }), "{refused}");
    assert!(
        refused.to_string().contains("more than 3 is needed"),
        "{refused}"
    );
    // And these would overlap.
    assert!(Lab::new(1, &[at(0.0, 0.5), at(1.5, 0.5)]).is_ok());
    for radius in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = Lab::new(1, &[at(0.0, 1.0), at(9.0, radius)]).unwrap_err();
        assert!(
            matches!(refused, BemError::Radius { sphere: 1, .. }),
            "{refused}"
        );
    }
}

/// The smallest gap that the laboratory accepts between spheres of radii 1 and `ratio`, the mesh of sphere 1 turned away by `angle`, and the
/// error of the axial loads there.
fn smallest_accepted(ratio: f64, angle: f64) -> (f64, f64) {
    let mut eps = 1e-5;
    let lab = loop {
        let mut bodies = [0.0, 1.0 + ratio + eps].map(|z| Body::rigid(Vector3::z() * z));
        bodies[0].mesh_rotation = UnitQuaternion::from_scaled_axis(Vector3::y() * angle);
        bodies[1].radius = ratio;
        match Lab::new(1, &bodies) {
            Ok(lab) => break lab,
            Err(BemError::GapUnresolved { resolved, .. }) => {
                assert!(resolved > eps, "{resolved} at {eps}");
                eps = resolved * 1.0001;
            }
            Err(error) => panic!("{error}"),
        }
    };
    let truth = Exact::of_ratio(ratio).unwrap();
    let truth = (truth.interacting_loads_of_each(gap(eps), LoadSet::axial(0))).unwrap()[0];
    let motion = |velocity| Motion {
        velocity,
        angular_velocity: Vector3::zeros(),
    };
    let found = lab
        .loads(&[motion(Vector3::z()), motion(Vector3::zeros())])
        .unwrap();
    let (own, other) = (truth.pair.xa.own(), truth.pair.xa.other());
    let off = [(0, own), (1, other)]
        .map(|(k, scalar)| (found[k].force.z / (-6.0 * PI) - scalar).abs() / scalar.abs().max(1.0));
    (eps, off[0].max(off[1]))
}

#[test]
fn val_the_smallest_gap_accepted_between_unlike_spheres_is_resolved_to_a_hundredth() {
    for (ratio, angle) in [(0.3, 0.0), (4.0, 0.0), (3.0, 1.0)] {
        let (eps, error) = smallest_accepted(ratio, angle);
        println!("ratio {ratio}, angle {angle}: {error:e} at {eps}");
        assert!(
            error < 0.01,
            "{error:e} at gap {eps}, ratio {ratio}, angle {angle}"
        );
    }
}
