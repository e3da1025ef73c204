//! Collisions: coordinates, symmetries, far-field laws.

use scene::nalgebra::{Rotation3, Vector3};

use super::*;

fn collide(collider: &Collider<'_>, incoming: &Incoming) -> Outgoing {
    collider.collide(incoming, Begins::Infinity, true).unwrap()
}

/// The largest difference of headings, displacements and times, and whether the outcomes are the same.
fn apart(a: &Outgoing, b: &Outgoing) -> f64 {
    assert_eq!(a.outcome, b.outcome);
    let of = |k: usize| {
        let headings = (a.headings[k] - b.headings[k]).norm();
        headings.max((a.carried[k] - b.carried[k]).norm())
    };
    of(0).max(of(1)).max((a.tau - b.tau).abs())
}

#[test]
fn collisions_are_symmetric_under_exchange_mirror_and_rotation() {
    let turn = Rotation3::from_euler_angles(0.3, -1.1, 2.0);
    let mirror = |v: Vector3<f64>| Vector3::new(v.x, v.y, -v.z);
    for (method, betas) in [(Method::Lt, [1.0, 5.0]), (Method::Exact, [-5.0, 5.0])] {
        let model = model(method);
        for beta in betas {
            let collider = Collider::new(&model, beta, &options()).unwrap();
            for pair in pairs() {
                let out = collide(&collider, &pair);
                if !out.parts() {
                    continue;
                }
                let with = |of: &dyn Fn(Vector3<f64>) -> Vector3<f64>| Outgoing {
                    headings: out.headings.map(of),
                    carried: out.carried.map(of),
                    ..out
                };
                let swapped = Outgoing {
                    headings: [out.headings[1], out.headings[0]],
                    carried: [out.carried[1], out.carried[0]],
                    ..out
                };
                let images = [
                    (pair.exchanged(), swapped),
                    (pair.mirrored(), with(&mirror)),
                    (pair.turned(turn), with(&|v| turn * v)),
                ];
                for (image, expected) in images {
                    let off = apart(&collide(&collider, &image), &expected);
                    assert!(off < 1e-5, "{method} {beta} {pair:?}: {off}");
                }
            }
        }
    }
}

#[test]
fn impact_and_contact_coordinates_name_the_same_pair() {
    for index in 0..50 {
        let contact = Contact::of_point(point(index, 1));
        let pair = contact.incoming();
        let back = pair.contact_coordinates().unwrap();
        for k in [0, 1] {
            assert!(
                (back.polar[k] - contact.polar[k]).abs() < 1e-6,
                "{contact:?}"
            );
        }
        let turned = (back.azimuth - contact.azimuth).sin().abs();
        assert!(turned < 1e-6, "{contact:?} {back:?}");
        let again = pair.impact_coordinates().incoming();
        assert!((again.impact - pair.impact).norm() < 1e-6);
        assert!((again.headings[0] - pair.headings[0]).norm() < 1e-9);
        // Exchange swaps the polar angles, a mirror turns the azimuth round.
        let other = pair.exchanged().contact_coordinates().unwrap();
        assert!((other.polar[0] - contact.polar[1]).abs() < 1e-6);
        assert!((other.azimuth - contact.azimuth).sin().abs() < 1e-6);
        let mirrored = pair.mirrored().contact_coordinates().unwrap();
        assert!((mirrored.azimuth + contact.azimuth).sin().abs() < 1e-6);
    }
    let wide = Impact {
        between: 1.0,
        b: 3.1,
        roll: 0.0,
    };
    assert_eq!(wide.incoming().contact_coordinates(), None);
}

#[test]
fn val_points_stand_for_pairs_as_often_as_they_come() {
    let count = 4096;
    let mean = |of: &dyn Fn([f64; 3]) -> f64| {
        (0..count).map(|k| of(point(k, 2))).sum::<f64>() / f64::from(count as u32)
    };
    // Weighted by the speed the mean of its reciprocal is 3/4, that of the cosine -1/5.
    let speed = |at| {
        1.0 / Impact::of_point(at, (0.0, 3.0))
            .incoming()
            .velocity()
            .norm()
    };
    assert!((mean(&speed) - 0.75).abs() < 1e-3);
    let cosine = |at| Impact::of_point(at, (0.0, 3.0)).between.cos();
    assert!((mean(&cosine) + 0.2).abs() < 1e-3);
    // Weighted by the speed of closing in its mean is 1.
    let closing = |at| {
        Contact::of_point(at)
            .polar
            .map(f64::cos)
            .iter()
            .sum::<f64>()
    };
    assert!((mean(&closing) - 1.0).abs() < 1e-3);
    // Both kinds of points have the same impact parameters: two thirds of the largest on average.
    let b = |at| Contact::of_point(at).incoming().impact.norm();
    assert!((mean(&b) - 2.0).abs() < 2e-3);
}

#[test]
fn val_neutral_squirmers_keep_the_angle_between_them() {
    // Reversed in time a neutral squirmer is one that swims backward, unless repulsion acts: Alexander, Pooley & Yeomans, Phys. Rev. E 78, 045302 (2008).
    let model = model(Method::Exact);
    let collider = Collider::new(&model, 0.0, &options())
        .unwrap()
        .without_repulsion();
    for pair in pairs() {
        let out = collide(&collider, &pair);
        let change =
            out.headings[0].dot(&out.headings[1]) - pair.headings[0].dot(&pair.headings[1]);
        let turned = (out.headings[0] - pair.headings[0]).norm();
        assert!(!out.parts() || change.abs() < 1e-6, "{pair:?}: {change}");
        assert!(!out.parts() || turned > 1e-3, "{pair:?}: {turned}");
    }
}

#[test]
fn val_far_apart_turns_fall_as_the_square_of_the_impact_parameter_and_displacements_as_it() {
    let model = model(Method::Exact);
    let collider = Collider::new(&model, 1.0, &options()).unwrap();
    let at = |b: f64| {
        let pair = Impact {
            between: 1.9,
            b,
            roll: 0.4,
        };
        let pair = pair.incoming();
        let out = collide(&collider, &pair);
        let turned = (out.headings[0] - pair.headings[0]).norm();
        (turned, out.carried[0].norm(), out.tau)
    };
    let ((near_turn, near_way, time), (far_turn, far_way, _)) = (at(60.0), at(120.0));
    assert!(
        (near_turn / far_turn - 4.0).abs() < 0.1,
        "{near_turn} {far_turn}"
    );
    assert!(
        (near_way / far_way - 2.0).abs() < 0.05,
        "{near_way} {far_way}"
    );
    assert!(time.abs() < f64::MIN_POSITIVE, "{time}");
}

#[test]
fn pairs_from_infinity_do_not_depend_on_where_their_run_begins() {
    let model = model(Method::Exact);
    for beta in [-5.0, 0.0, 5.0] {
        let near = Collider::new(&model, beta, &options()).unwrap();
        let far = near.from_farther(4.0);
        for pair in pairs() {
            let (a, b) = (collide(&near, &pair), collide(&far, &pair));
            if a.parts() {
                let off = apart(&a, &b);
                assert!(off < 0.02, "{beta} {:?}: {off}", pair.impact_coordinates());
            }
        }
    }
}

#[test]
fn val_under_a_cut_a_pair_from_infinity_is_one_that_begins_at_the_cut() {
    let model = model(Method::Lt);
    let collider = Collider::new(&model, 5.0, &options()).unwrap();
    for pair in pairs() {
        let far = collide(&collider, &pair);
        let near = collider.collide(&pair, Begins::Contact, true).unwrap();
        for k in [0, 1] {
            let off = (far.headings[k] - near.headings[k]).norm();
            assert!(off < 1e-6, "{pair:?}: {off}");
            // The way by swimming is summed from samples, which the cut falls between.
            let off = (far.carried[k] - near.carried[k]).norm();
            assert!(off < 2e-3, "{pair:?}: {off}");
        }
        assert!((far.tau - near.tau).abs() < 1e-6, "{pair:?}");
    }
}

#[test]
fn headings_that_are_parallel_are_refused_and_do_not_panic() {
    let model = model(Method::Exact);
    let collider = Collider::new(&model, 1.0, &options()).unwrap();
    let pair = Incoming {
        headings: [Vector3::y(); 2],
        impact: Vector3::z(),
    };
    assert!(collider.collide(&pair, Begins::Infinity, true).is_err());
}
