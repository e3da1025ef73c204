//! Independent quadratures of the same integrals in other coordinates.

use std::f64::consts::TAU;

use super::*;

/// Checks that all coefficients agree with those of sampled pairs within three sampling errors, and that these are small.
fn agree(sampled: &[Coefficients], others: &Coefficients, most: f64) {
    for (name, of) in Coefficients::ALL {
        let values: Vec<f64> = sampled.iter().map(of).collect();
        let (mean, error) = mean_and_error(&values);
        let scale = mean.abs().max(1.0);
        assert!(error < most * scale, "{name}: {mean} +- {error}");
        let off = (mean - of(others)).abs();
        assert!(
            off < 3.0 * error,
            "{name}: {mean} +- {error}, {}",
            of(others)
        );
    }
}

/// Midpoints of equal parts of a stretch.
fn midpoints(count: u32, (from, to): (f64, f64)) -> impl Iterator<Item = f64> + Clone {
    (0..count).map(move |k| from + (to - from) * (f64::from(k) + 0.5) / f64::from(count))
}

#[test]
fn val_lubrication_theory_gives_the_same_integrals_over_the_contact_sphere() {
    let model = model(Method::Lt);
    for beta in [1.0, 5.0] {
        let collider = Collider::new(&model, beta, &options()).unwrap();
        let kernel = |incoming: &Incoming| collider.collide(incoming, Begins::Infinity, true);
        let sampled = sampled(&kernel, 3.0, 256);
        // Cosines of both polar angles and the azimuth, weighed by the speed of closing in; a mirror halves the azimuth.
        let mut sums = Sums::default();
        for index in 0..1 << 15 {
            let [u, v, w] = point(index, 77);
            let (one, two) = (2.0 * u - 1.0, 2.0 * v - 1.0);
            if one + two < 1e-9 {
                continue;
            }
            let contact = Contact {
                polar: [one.acos(), two.acos()],
                azimuth: 0.5 * TAU * w,
            };
            let incoming = contact.incoming();
            let outgoing = collider.collide(&incoming, Begins::Contact, true).unwrap();
            sums.add(one + two, &incoming, Some(&outgoing));
        }
        let others = Coefficients::of(&[((0.0, 3.0), sums.means())]);
        agree(&sampled, &others, 0.05);
    }
}

#[test]
fn val_exact_hydrodynamics_gives_the_same_integrals_on_a_grid() {
    let model = model(Method::Exact);
    let collider = Collider::new(&model, 1.0, &options()).unwrap();
    let kernel = |incoming: &Incoming| collider.collide(incoming, Begins::Infinity, true);
    let sampled = sampled(&kernel, 3.0, 256);
    // Half the angle between the headings, and the angle at which a straight path enters the sphere of radius 3, weighed by speed, solid angle and
    // area.
    let mut sums = Sums::default();
    for half in midpoints(48, (0.0, 0.25 * TAU)) {
        for enters in midpoints(24, (0.0, 0.25 * TAU)) {
            for roll in midpoints(8, (0.0, 0.25 * TAU)) {
                let impact = Impact {
                    between: 2.0 * half,
                    b: 3.0 * enters.sin(),
                    roll,
                };
                let incoming = impact.incoming();
                let outgoing = kernel(&incoming).unwrap();
                let weight = half.sin() * (2.0 * half).sin() * (2.0 * enters).sin();
                sums.add(weight, &incoming, Some(&outgoing));
            }
        }
    }
    let by_grid = Coefficients::of(&[((0.0, 3.0), sums.means())]);
    agree(&sampled, &by_grid, 0.1);
}

#[test]
fn runs_that_begin_twice_as_far_away_change_less_than_sampling_does() {
    let model = model(Method::Exact);
    for beta in [-5.0, 5.0] {
        let near = Collider::new(&model, beta, &options()).unwrap();
        let far = near.from_farther(2.0);
        let of = |collider: Collider<'_>| {
            let kernel =
                move |incoming: &Incoming| collider.collide(incoming, Begins::Infinity, true);
            sampled(&kernel, 3.0, 256)
        };
        let (near, far) = (of(near), of(far));
        for (name, of) in Coefficients::ALL {
            let [near, far] = [&near, &far].map(|all| {
                let values: Vec<f64> = all.iter().map(of).collect();
                mean_and_error(&values)
            });
            let off = (near.0 - far.0).abs();
            assert!(off < near.1, "{beta} {name}: {near:?} {far:?}");
        }
    }
}
