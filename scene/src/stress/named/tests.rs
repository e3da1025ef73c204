//! The numbers by their names add up to what a pair has.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use super::super::tests::pair;
use super::*;
use crate::{Gap, MovingPair};

/// Any symmetric rates of work and any stresslets.
fn any() -> Stresses {
    let (modes, swirl) = (3, 3);
    let number = |k: usize| ((k * 7919 + 13) % 101) as f64 / 37.0 - 1.0;
    let of = |(at, block): (usize, Block)| {
        let causes = block.causes(modes, swirl);
        let count = 2 * causes.len();
        let work = DMatrix::from_fn(count, count, |i, j| number(at + i.min(j) + 31 * i.max(j)));
        let has_stresslets = matches!(block, Block::Order(0..=2));
        let stresslets = [0, 1].map(|on| {
            let length = if has_stresslets { count } else { 0 };
            DVector::from_fn(length, |i, _| number(at + 5 * on + 3 * i))
        });
        BlockStresses {
            block,
            causes,
            work,
            stresslets,
        }
    };
    Stresses {
        gap: Gap::new(0.3).unwrap(),
        modes,
        swirl,
        blocks: Block::all(modes, swirl).enumerate().map(of).collect(),
    }
}

const RADII: [f64; 2] = [1.0, 1.7];

/// A pair that is held.
fn held() -> MovingPair {
    let mut pair = pair();
    pair.configuration.radii = RADII;
    pair.velocities = Default::default();
    pair.angular_velocities = Default::default();
    pair
}

/// What the documentation says of a squirmer: `d`, `c` and `p_t`.
fn seen(pair: &MovingPair, k: usize) -> (Vector3<f64>, f64, Vector3<f64>) {
    let line = pair.configuration.line;
    let d = if k == 0 { line } else { -line };
    let p = pair.configuration.orientations[k];
    let c = p.dot(&d);
    (d, c, p - d * c)
}

/// `P_n`, `W_n`, `V_n` and the factor of order 3.
fn factor(order: usize, n: usize, c: f64) -> f64 {
    let derivative = super::super::legendre_derivative(n, order, c);
    let n = n as f64;
    match order {
        0 => derivative,
        1 => 2.0 * derivative / (n * (n + 1.0)),
        2 => 8.0 * derivative / ((n - 1.0) * n * (n + 1.0) * (n + 2.0)),
        _ => {
            let among: f64 = (0..6).map(|k| n - 2.0 + f64::from(k)).product();
            2.0 * derivative / among
        }
    }
}

fn order_of(name: &str) -> usize {
    ["X", "Y", "Z", "M3"]
        .iter()
        .position(|letter| name.starts_with(letter))
        .unwrap()
}

fn digits(text: &str) -> Vec<usize> {
    text.chars()
        .map(|c| c.to_digit(10).unwrap() as usize)
        .collect()
}

#[test]
fn stresslets_by_slip_are_sums_of_what_the_names_say() {
    let (all, pair) = (any(), held());
    let both = |a: Vector3<f64>, b: Vector3<f64>| a * b.transpose() + b * a.transpose();
    let mut found = [Matrix3::zeros(); 2];
    for (name, value) in all.named(RADII[1]) {
        let Some((head, n)) = name.split_once('_').filter(|_| name.contains('S')) else {
            continue;
        };
        let (is_swirl, n) = (head.contains('C'), n.parse::<usize>().unwrap());
        let numbers = digits(&head[head.len() - 2..]);
        let (on, by) = (numbers[0] - 1, numbers[1] - 1);
        let (d, c, p) = seen(&pair, by);
        let q = d.cross(&p);
        let of = &pair.squirmers[by];
        let strength = if is_swirl {
            of.swirl()[n - 1]
        } else {
            of.mode(n - 1)
        };
        let across = Matrix3::identity() - d * d.transpose();
        let shape = match (order_of(head), is_swirl) {
            (0, _) => d * d.transpose() - Matrix3::identity() / 3.0,
            (1, false) => both(d, p),
            (1, true) => both(d, q),
            (_, false) => p * p.transpose() - across * (0.5 * p.norm_squared()),
            (_, true) => both(p, q) * 0.5,
        };
        let scale = PI * RADII[by].powi(2) * strength * factor(order_of(head), n, c);
        found[on] += shape * (scale * value);
    }
    let expected = all.of(&pair).stresslets;
    for k in [0, 1] {
        let error = (found[k] - expected[k]).amax();
        assert!(error < 1e-12 * expected[k].amax(), "{k}: {error:e}");
    }
}

#[test]
fn the_power_of_held_squirmers_is_the_sum_of_what_the_names_say() {
    let (all, pair) = (any(), held());
    let complex = |v: Vector3<f64>| super::super::Axes::of(&pair).across(&v);
    let mut found = 0.0;
    for (name, value) in all.named(RADII[1]) {
        let order = order_of(&name);
        let Some((_, rest)) = name.split_once('P') else {
            continue;
        };
        let parts: Vec<_> = rest.split('_').collect();
        let kind = parts[0].trim_end_matches(|c: char| c.is_ascii_digit());
        let numbers = digits(&parts[0][kind.len()..]);
        let spheres = [numbers[0] - 1, numbers[1] - 1];
        let modes = [1, 2].map(|k| parts[k].parse::<usize>().unwrap());
        let swirls = [kind == "C", !kind.is_empty()];
        let side = |k: usize| {
            let (d, c, p) = seen(&pair, spheres[k]);
            let of = &pair.squirmers[spheres[k]];
            let n = modes[k];
            let strength = if swirls[k] {
                of.swirl()[n - 1]
            } else {
                of.mode(n - 1)
            };
            let turned = if swirls[k] && order > 0 {
                // A quarter turn about `d`.
                complex(d.cross(&p)) / complex(p)
            } else {
                1.0.into()
            };
            (
                strength * factor(order, n, c),
                complex(p).powu(order as u32) * turned,
            )
        };
        let ((f, p), (g, q)) = (side(0), side(1));
        let shape = (p.conj() * q).re;
        // Different pairs of causes count twice.
        let twice = spheres[0] != spheres[1] || modes[0] != modes[1];
        let count = if twice { 2.0 } else { 1.0 };
        found += count * PI * RADII[spheres[0]] * f * g * shape * value;
    }
    let expected = all.of(&pair).dissipation;
    assert!(
        (found - expected).abs() < 1e-12 * expected.abs(),
        "{found} {expected}"
    );
}

#[test]
fn names_are_short_and_each_stands_once() {
    let all = any();
    let names = |ratio: f64| -> Vec<String> {
        let named = all.named(ratio).into_iter();
        named.map(|(name, _)| name).collect()
    };
    let (equal, unlike) = (names(1.0), names(0.5));
    assert_eq!(
        equal[..12].join(" "),
        "XG11 XG12 YG11 YG12 YH11 YH12 XS1_1 XS2_1 YS1_1 YS2_1 XS1_2 XS2_2"
    );
    for (named, name) in [
        (&equal, "ZS2_2"),
        (&equal, "YSC1_3"),
        (&equal, "XP1_1_2"),
        (&equal, "YPBC2_3_1"),
        (&equal, "M3P2_3_3"),
        (&unlike, "XG22"),
        (&unlike, "XS21_2"),
        (&unlike, "ZP12_3_2"),
        (&unlike, "XPC22_1_1"),
    ] {
        assert!(named.iter().any(|n| n == name), "{name} in {named:?}");
    }
    for mut named in [equal, unlike] {
        named.sort();
        assert!(named.windows(2).all(|two| two[0] != two[1]), "{named:?}");
    }
}
