//! Worst breaches, eigenvalues and powers of made-up numbers.

use super::*;
use crate::judge::points::made::point;
use crate::submission::{MatrixLaws, Values};
use nalgebra::Matrix4;
use scene::Gap;

#[test]
fn the_worst_breach_of_each_law_is_kept_with_its_gap_and_entries() {
    let answer = |gap: f64, asymmetry: f64, images: f64, eigenvalue: f64| Answer {
        gap: Gap::new(gap).unwrap(),
        values: Values::default(),
        errors: Values::default(),
        laws: Some(MatrixLaws {
            asymmetry: (asymmetry, format!("a{gap}")),
            images: (images, format!("i{gap}")),
            smallest_eigenvalue: eigenvalue,
        }),
    };
    let without = Answer {
        laws: None,
        ..answer(9.0, 9.0, 9.0, -9.0)
    };
    let laws = matrix_laws(&[
        answer(0.1, 1e-5, 2e-4, 0.3),
        answer(0.2, 3e-4, 2e-4, 0.1),
        without,
        answer(0.4, 2e-4, 1e-4, 0.2),
    ]);
    let told: Vec<_> = (laws.iter())
        .map(|law| (law.name, law.value, law.gap, law.entries.as_str()))
        .collect();
    // Of two equal ones the first.
    assert_eq!(
        told,
        [
            ("reciprocity", 3e-4, 0.2, "a0.2"),
            ("equal spheres", 2e-4, 0.1, "i0.1"),
            ("smallest eigenvalue", 0.1, 0.2, ""),
        ]
    );
    assert_eq!(
        laws.iter().map(Law::is_broken).collect::<Vec<_>>(),
        [true, true, false]
    );
    let broken = |name: &'static str, value: f64| {
        Law {
            name,
            value,
            gap: 1.0,
            entries: String::new(),
        }
        .is_broken()
    };
    assert!(!broken("reciprocity", 1e-4) && broken("reciprocity", 1.001e-4));
    assert!(broken("smallest eigenvalue", 0.0) && !broken("smallest eigenvalue", 1e-9));
}

#[test]
fn val_the_smallest_eigenvalue_is_that_of_the_matrices_along_and_across() {
    let names = ["xa", "ya", "yb", "xc", "yc"];
    let mut state = 7_u64;
    let mut random = move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    for _ in 0..200 {
        let scalars: Vec<[f64; 2]> = (names.iter())
            .map(|name| match *name {
                "yb" => [0.4 * random(), 0.4 * random()],
                _ => [1.0 + 0.3 * random(), 0.9 * random()],
            })
            .collect();
        let [xa, ya, yb, xc, yc] = scalars[..] else {
            unreachable!()
        };
        let points: Vec<Point> = (names.iter().zip(&scalars))
            .flat_map(|(name, of)| {
                let (axis, letter) = name.split_at(1);
                ["11", "12"]
                    .iter()
                    .zip(of)
                    .map(|(k, value)| point(&format!("{axis}{k}{letter}"), 0.3, *value, 1.0))
                    .collect::<Vec<_>>()
            })
            .collect();
        // Across: both velocities and both spins, in units in which lone spheres have ones.
        let unit = 3f64.sqrt();
        let [own, other] = [0, 1].map(|k| unit * yb[k]);
        #[rustfmt::skip]
        let across = Matrix4::new(
            ya[0], ya[1], own, other,
            ya[1], ya[0], -other, -own,
            own, -other, yc[0], yc[1],
            other, -own, yc[1], yc[0],
        );
        let along = [xa, xc].map(|of| of[0] - of[1].abs());
        let least = across
            .symmetric_eigenvalues()
            .min()
            .min(along[0])
            .min(along[1]);
        let found = definite(&points);
        assert_eq!(found.len(), 1);
        assert!((found[0].1 - least).abs() < 1e-12, "{} {least}", found[0].1);
        // Without one of the scalars there is none.
        assert!(definite(&points[1..]).is_empty());
    }
}

#[test]
fn powers_are_those_of_the_distance_between_the_two_largest_gaps() {
    let power = |gap: f64, power: i32| (2.0 + gap).powi(power);
    let of = |name: &str, gaps: &[f64], value: i32, truth: i32| {
        let points: Vec<Point> = (gaps.iter())
            .map(|&gap| point(name, gap, power(gap, value), power(gap, truth)))
            .collect();
        decays(&[(points[0].item, points)])
    };
    let far = [0.1, 5.0, 10.0, 40.0];
    let found = of("x12a", &far, -2, -1);
    assert_eq!(found.len(), 1);
    let [theirs, truth] = found[0].powers;
    assert!(
        (theirs + 2.0).abs() < 1e-12 && (truth + 1.0).abs() < 1e-12,
        "{found:?}"
    );
    assert!(found[0].is_off);
    assert!(!of("x12a", &far, -1, -1)[0].is_off);
    // Two far gaps are needed, from 3 on.
    assert!(of("x12a", &[0.1, 2.9, 40.0], -1, -1).is_empty());
    assert_eq!(of("x12a", &[0.1, 3.0, 40.0], -1, -1).len(), 1);
    // What does not vanish has no power, nor has what has faded away.
    assert!(of("x11a", &far, -1, -1).is_empty());
    assert!(of("x12a", &far, -6, -6).is_empty());
    // What follows from others is not counted.
    let mut points: Vec<Point> = far
        .iter()
        .map(|&gap| point("x12a", gap, 1.0, 1.0))
        .collect();
    points[3].given = false;
    points[2].given = false;
    assert!(decays(&[(points[0].item, points)]).is_empty());
}
