//! Kernels whose integrals are known in closed form.

use std::f64::consts::PI;

use scene::Outcome;
use scene::nalgebra::Vector3;

use super::*;
use crate::CompareError;

/// A number from 0 to 1 that depends on all bits of a pair (a mixer of Steele, Lea and Flood, 2014).
fn mixed(incoming: &Incoming, salt: u64) -> f64 {
    let mut z = salt.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    for number in incoming.headings[0].iter().chain(incoming.impact.iter()) {
        z = z
            .wrapping_add(number.to_bits())
            .wrapping_add(0x9e37_79b9_7f4a_7c15);
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
    }
    (z >> 11) as f64 / (1_u64 << 53) as f64
}

/// A unit vector, all directions alike.
fn direction(u: f64, v: f64) -> Vector3<f64> {
    let cosine = 2.0 * u - 1.0;
    let sine = (1.0 - cosine * cosine).sqrt();
    let (sin, cos) = (2.0 * PI * v).sin_cos();
    Vector3::new(sine * cos, sine * sin, cosine)
}

fn random(incoming: &Incoming) -> Result<Outgoing, CompareError> {
    let of = |salt| direction(mixed(incoming, salt), mixed(incoming, salt + 1));
    Ok(Outgoing {
        headings: [of(1), of(3)],
        carried: [of(5), of(7) * 2.0],
        ..Outgoing::untouched(incoming)
    })
}

#[test]
fn val_pairs_that_do_nothing_to_each_other_give_zero_and_the_time_of_straight_paths() {
    let of = sampled(&|incoming| Ok(Outgoing::untouched(incoming)), 3.0, 1024);
    for name in ["rotation", "displacement", "alignment", "growth"] {
        holds(&of, name, 0.0, 0.0);
    }
    // A share n 36 pi of the time there is somebody within the gap 1, the volume of the sphere of radius 3: nu tau = n 36 pi.
    holds(&of, "tau", 3.0, 0.01);
    let nu = of[0].encounters;
    assert!((nu - 12.0 * PI).abs() < 1e-12, "{nu}");
    assert!(of.iter().all(|of| (of.means.meeting - 1.0).abs() < 1e-12));
}

#[test]
fn val_random_outgoing_headings_have_the_closed_form() {
    let of = sampled(&random, 3.0, 4096);
    let nu = 12.0 * PI;
    holds(&of, "rotation", 0.5 * nu, 0.1);
    let (rotation, _) = mean_and_error(&of.iter().map(|of| of.rotation).collect::<Vec<_>>());
    let (translation, _) = mean_and_error(&of.iter().map(|of| of.translation).collect::<Vec<_>>());
    assert!((translation * 6.0 * rotation - 1.0).abs() < 1e-3);
    // Jumps of lengths 1 and 2.
    holds(&of, "displacement", nu * 2.5 / 6.0, 1e-12);
    // Pairs come with cosines of -1/5 on average, and with |s|^2 of 8/5.
    holds(&of, "alignment", 0.2, 0.01);
    holds(&of, "growth", -0.8 * nu, 0.3);
}

#[test]
fn val_squirmers_that_exchange_their_headings_keep_alignment_and_order() {
    let exchange = |incoming: &Incoming| {
        let [one, two] = incoming.headings;
        Ok(Outgoing {
            headings: [two, one],
            ..Outgoing::untouched(incoming)
        })
    };
    let of = sampled(&exchange, 3.0, 1024);
    holds(&of, "rotation", 0.6 * 12.0 * PI, 0.01);
    holds(&of, "alignment", 0.0, 1e-12);
    holds(&of, "growth", 0.0, 1e-12);
}

#[test]
fn pairs_that_do_not_part_are_counted_and_add_nothing() {
    // Those within a third of the disc's area stay, a third touch.
    let kernel = |incoming: &Incoming| {
        let share = (incoming.impact.norm() / 3.0).powi(2);
        let outcome = match share {
            share if share < 1.0 / 3.0 => Outcome::Pairwise,
            share if share < 2.0 / 3.0 => Outcome::Contact,
            _ => Outcome::Scattered,
        };
        Ok(Outgoing {
            outcome,
            ..random(incoming)?
        })
    };
    let of = sampled(&kernel, 3.0, 4096);
    for of in &of {
        let means = of.means;
        for share in [means.bound, means.contact, means.parting] {
            assert!((share - 1.0 / 3.0).abs() < 1e-3, "{means:?}");
        }
    }
    holds(&of, "rotation", 2.0 * PI, 0.1);
    holds(&of, "alignment", 0.2, 0.02);
}

#[test]
fn a_run_that_fails_is_counted_with_its_reason() {
    let kernel = |_: &Incoming| Err(CompareError::input("kernel", 1, "never"));
    let (means, failure) = Means::sampled(&kernel, (0.0, 3.0), 16, 0);
    assert_eq!((means.failures, means.failed), (16, 1.0));
    assert!(failure.unwrap().contains("never"));
}

#[test]
fn rings_add_up_to_the_disc() {
    let part = |ring: (f64, f64)| (ring, Means::sampled(&random, ring, 4096, 3).0);
    let rings = Coefficients::of(&[part((0.0, 3.0)), part((3.0, 6.0)), part((6.0, 9.0))]);
    assert!((rings.encounters - rate((0.0, 9.0))).abs() < 1e-9);
    let expected = 0.5 * rate((0.0, 9.0));
    assert!((rings.rotation / expected - 1.0).abs() < 0.02, "{rings:?}");
}
