//! Stresslets of two rigid spheres by their motion, against what others computed: the scalars XG, YG and YH of Kim & Karrila,
//! *Microhydrodynamics* (2005), chapters 7 and 11.
//!
//! With `d` from sphere 1 to sphere 2, `S(a) = -Σ_b G(ab).U(b) + H(ab).omega(b)` where
//! `G_ijk = XG (d_i d_j - I_ij/3) d_k + YG (d_i I_jk + d_j I_ik - 2 d_i d_j d_k)`, `H_ijk = YH (e_ikl d_l d_j + e_jkl d_l d_i)`.

use exact::Exact;
use scene::stress::Stresses;
use scene::{Fluid, Gap};

/// The scalar of that name in units of sphere 1: `XG12` is the stresslet of sphere 1 by the velocity of sphere 2.
fn scalar(of: &Stresses, lambda: f64, name: &str) -> f64 {
    let named = of.named(lambda);
    let found = |name: &str| {
        named
            .iter()
            .find(|(n, _)| n == name)
            .map(|(_, value)| *value)
    };
    // Equal spheres have names of sphere 1 alone; what sphere 2 has is the mirror image.
    let mirrored = || {
        let swapped: String = name
            .chars()
            .map(|c| match c {
                '1' => '2',
                '2' => '1',
                c => c,
            })
            .collect();
        let sign = if name.starts_with("YH") { 1.0 } else { -1.0 };
        sign * found(&swapped).unwrap()
    };
    found(name).unwrap_or_else(mirrored)
}

fn numbers(csv: &str) -> impl Iterator<Item = Vec<&str>> {
    let rows = csv.lines().filter(|line| !line.starts_with('#'));
    rows.map(|line| line.split(',').collect())
}

fn stresses(lambda: f64, s: f64) -> Stresses {
    let gap = Gap::new((0.5 * s - 1.0) * (1.0 + lambda)).unwrap();
    Exact::of_ratio(lambda)
        .unwrap()
        .stresses(gap, 0, 0)
        .unwrap()
}

#[test]
fn val_stresslets_by_motion_are_those_of_the_series_of_jeffrey() {
    let mut worst = 0.0_f64;
    let mut solved: Option<(f64, f64, Stresses)> = None;
    for row in numbers(fixtures::STRESSLETS).skip(1) {
        let [lambda, s, value] = [0, 1, 3].map(|k| row[k].parse::<f64>().unwrap());
        let digits: i32 = row[4].parse().unwrap();
        let of = match solved.take() {
            Some((l, at, of)) if (l, at) == (lambda, s) => of,
            _ => stresses(lambda, s),
        };
        let found = scalar(&of, lambda, row[2]);
        let error = (found - value).abs();
        let allowed = 2.0 * value.abs() * 10.0_f64.powi(-digits) + 1e-11 * lambda.max(1.0).powi(3);
        assert!(error < allowed, "{row:?}: {found} ({error:e})");
        worst = worst.max(error);
        solved = Some((lambda, s, of));
    }
    println!("largest difference {worst:.1e}");
}

#[test]
fn val_stresslets_by_motion_are_those_that_townsend_published() {
    let mut rows = numbers(fixtures::STRESSLETS_TOWNSEND);
    let names: Vec<&str> = rows.next().unwrap();
    for row in rows {
        let [lambda, s] = [0, 1].map(|k| row[k].parse::<f64>().unwrap());
        let of = stresses(lambda, s);
        // What his table is good for; see the fixtures' README.
        let tolerance = match lambda {
            l if l > 1.0 => 3e-4,
            l if l < 1.0 => 4e-5,
            _ => 1e-5,
        };
        for (name, value) in names.iter().zip(&row).skip(2) {
            let value: f64 = value.parse().unwrap();
            let error = (scalar(&of, lambda, name) / value - 1.0).abs();
            assert!(error < tolerance, "{name} at {lambda}, {s}: {error:e}");
        }
    }
}

#[test]
fn val_near_contact_stresslets_grow_as_lubrication_has_them() {
    for xi in [3e-3, 1e-3, 3e-4_f64] {
        for row in numbers(fixtures::STRESSLETS_NEAR_CONTACT).skip(1) {
            let [lambda, g1, g2, constant, g3] =
                [0, 2, 3, 4, 5].map(|k| row[k].parse::<f64>().unwrap());
            let log = -xi.ln();
            let expected = g1 / xi + g2 * log + constant + g3 * xi * log;
            let found = scalar(&stresses(lambda, 2.0 + xi), lambda, row[1]);
            // The next term is of the order of xi.
            let error = (found - expected).abs();
            assert!(
                error < 2.0 * xi + 1e-5,
                "{row:?} at {xi}: {found} {expected}"
            );
        }
    }
}
