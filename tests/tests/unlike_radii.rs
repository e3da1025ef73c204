//! Laws of pairs of unlike radii, over random ratios; `PROPTEST_CASES` sets the number of pairs of each law.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::f64::consts::TAU;

use exact::Exact;
use lt::{Form, UnlikeLubrication};
use nalgebra::{Rotation3, Unit, Vector3};
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use scene::mobility::MobilitySet;
use scene::{
    ActiveLoads, Gap, Gravity, Hydrodynamics, LoadSet, Orientation, Plan, Pose, Rates, Repulsion,
    Scene, SelfOther, Squirmer, rates,
};

const SET: LoadSet = LoadSet::all(3).with_swirl(2);

fn config() -> Config {
    Config {
        cases: std::env::var("PROPTEST_CASES").map_or(12, |cases| cases.parse().unwrap()),
        failure_persistence: None,
        ..Config::default()
    }
}

/// Fewer pairs, where each takes a fit near contact.
fn config_near_contact() -> Config {
    let cases = config().cases.div_ceil(4);
    Config { cases, ..config() }
}

/// Radius of the second sphere over that of the first, from 1/8 to 8, and the gap in radii of the smaller one.
fn pair() -> impl Strategy<Value = (f64, f64)> {
    (-8_f64.ln()..8_f64.ln(), -4.0..1.5)
        .prop_map(|(ratio, eps): (f64, f64)| (ratio.exp(), eps.exp()))
}

/// The models with a closed form or a series, for a ratio.
fn models(ratio: f64) -> [Box<dyn Hydrodynamics>; 2] {
    [
        Box::new(UnlikeLubrication::new(Form::Corrected, ratio).unwrap()),
        Box::new(Exact::of_ratio(ratio).unwrap()),
    ]
}

fn assert_close(a: f64, b: f64, bound: f64, what: &str) {
    let error = (a - b).abs() / a.abs().max(b.abs()).max(1.0);
    assert!(error <= bound, "{what}: {a} and {b}, off by {error:e}");
}

/// All scalars of one active sphere.
fn scalars(loads: &ActiveLoads) -> Vec<(String, f64)> {
    loads.named(1)
}

#[test]
fn val_a_pair_named_the_other_way_round_has_the_same_loads() {
    let law = |(ratio, eps): (f64, f64)| {
        let gap = eps * ratio.min(1.0);
        for (model, turned) in models(ratio).into_iter().zip(models(1.0 / ratio)) {
            let one = model.loads_of_each(Gap::new(gap).unwrap(), SET).unwrap();
            let two = turned
                .loads_of_each(Gap::new(gap / ratio).unwrap(), SET)
                .unwrap();
            for k in [0, 1] {
                let both = scalars(&one[k]).into_iter().zip(scalars(&two[1 - k]));
                for ((name, a), (_, b)) in both {
                    assert_close(
                        a,
                        b,
                        1e-10,
                        &format!("{name} of {k}, ratio {ratio}, gap {gap}"),
                    );
                }
            }
        }
        Ok(())
    };
    TestRunner::new(config()).run(&pair(), law).unwrap();
}

#[test]
fn val_what_one_sphere_does_to_the_other_is_what_that_does_to_it() {
    let law = |(ratio, eps): (f64, f64)| {
        let gap = Gap::new(eps * ratio.min(1.0)).unwrap();
        let (area, volume) = (ratio * ratio, ratio.powi(3));
        for model in models(ratio) {
            let [one, two] = model.loads_of_each(gap, SET).unwrap();
            let [p, q] = [&one.pair, &two.pair];
            let other = |s: SelfOther| s.other();
            for (name, by_one, by_two) in [
                ("XA", other(p.xa), ratio * other(q.xa)),
                ("YA", other(p.ya), ratio * other(q.ya)),
                ("XC", other(p.xc), volume * other(q.xc)),
                ("YC", other(p.yc), volume * other(q.yc)),
                // The force by a spin is the torque by a translation.
                (
                    "F2 by w1, T1 by U2",
                    other(p.yb),
                    -area * two.torque_on_other,
                ),
                (
                    "F1 by w2, T2 by U1",
                    area * other(q.yb),
                    -one.torque_on_other,
                ),
            ] {
                assert_close(
                    by_one,
                    by_two,
                    1e-10,
                    &format!("{name}, ratio {ratio}, gap {}", gap.eps()),
                );
            }
        }
        Ok(())
    };
    TestRunner::new(config()).run(&pair(), law).unwrap();
}

#[test]
fn val_forces_on_spheres_that_are_pressed_together_are_opposed() {
    // Newton's third law of what happens in the gap: the sum of the forces stays finite as each grows as one over the gap.
    let law = |(ratio, _): (f64, f64)| {
        for model in models(ratio) {
            let smaller = ratio.min(1.0);
            let sums = |eps: f64| {
                let gap = Gap::new(eps * smaller).unwrap();
                model
                    .loads_of_each(gap, SET)
                    .unwrap()
                    .map(|of| (of.pair.xa, of.pair.ya))
            };
            let (near, nearer) = (sums(1e-3), sums(1e-6));
            for ((xa, ya), (xa_nearer, ya_nearer)) in near.into_iter().zip(nearer) {
                assert!(xa_nearer.difference > 500.0 * xa.difference.abs());
                for (a, b) in [(xa.sum, xa_nearer.sum), (ya.sum, ya_nearer.sum)] {
                    assert!(
                        (a - b).abs() < 0.05 * (1.0 + a.abs()),
                        "ratio {ratio}: {a}, {b}"
                    );
                }
            }
        }
        Ok(())
    };
    TestRunner::new(config_near_contact())
        .run(&pair(), law)
        .unwrap();
}

#[test]
fn val_far_apart_each_sphere_is_alone() {
    let law = |(ratio, _): (f64, f64)| {
        let gap = Gap::new(1e7 * ratio.max(1.0)).unwrap();
        let alone = ActiveLoads::isolated(SET);
        for model in models(ratio) {
            for of in model.loads_of_each(gap, SET).unwrap() {
                for ((name, a), (_, b)) in scalars(&of).into_iter().zip(scalars(&alone)) {
                    assert_close(a, b, 3e-6, &format!("{name}, ratio {ratio}"));
                }
            }
            // Beyond its cut lubrication theory moves nothing by these.
            if model.is_cut(gap) {
                continue;
            }
            let set = MobilitySet {
                loads: SET,
                torque: true,
            };
            let mobility = model.interacting_mobility_of_each(gap, set).unwrap();
            let swims = mobility.by[1].modes[0].across.mean_transverse;
            // A lone squirmer swims at 2 B_1/3 whatever its size; the mean of the two is half of that.
            assert_close(swims, 1.0 / 3.0, 1e-6, "swimming");
            let spins =
                mobility.by[1].pair.torque.mean_spin - mobility.by[1].pair.torque.counter_spin;
            let lone = 1.0 / (8.0 * ratio.powi(3));
            assert!((spins / lone - 1.0).abs() < 1e-6, "{spins} {lone}");
        }
        Ok(())
    };
    TestRunner::new(config()).run(&pair(), law).unwrap();
}

/// Two squirmers with swirl and gravity in three dimensions.
#[derive(Clone, Debug)]
struct Met {
    ratio: f64,
    eps: f64,
    line: Vector3<f64>,
    headings: [Vector3<f64>; 2],
    down: Vector3<f64>,
}

fn direction() -> impl Strategy<Value = Vector3<f64>> {
    (-0.999..0.999, 0.0..TAU).prop_map(|(z, azimuth): (f64, f64)| {
        let across = (1.0 - z * z).sqrt();
        Vector3::new(across * azimuth.cos(), across * azimuth.sin(), z)
    })
}

fn met() -> impl Strategy<Value = Met> {
    (pair(), direction(), [direction(), direction()], direction()).prop_map(
        |((ratio, eps), line, headings, down)| Met {
            ratio,
            eps,
            line,
            headings,
            down,
        },
    )
}

impl Met {
    /// The scene, seen from a frame that `turn` leads to, with the squirmer `first` as the first one, whose radius is the unit.
    fn scene(&self, turn: &Rotation3<f64>, first: usize) -> Scene {
        let radii = [1.0, self.ratio];
        let unit = radii[first];
        let distance = 1.0 + self.ratio + self.eps * self.ratio.min(1.0);
        let order = [first, 1 - first];
        let squirmers = order.map(|k| {
            let of = |modes: [f64; 3], swirl: [f64; 2], g: f64| {
                (Squirmer::new(&modes).unwrap().with_swirl(&swirl))
                    .and_then(|s| s.bottom_heavy(g))
                    .and_then(|s| s.with_radius(radii[k] / unit))
                    .unwrap()
            };
            [
                of([1.5, -2.0, 0.7], [0.3, 1.0], 5.0),
                of([1.2, 3.0, -1.0], [0.0, -2.0], 9.0),
            ][k]
        });
        let start = order.map(|k| Pose {
            position: turn * self.line * (k as f64 * distance / unit),
            orientation: Orientation::Vector(turn * self.headings[k]),
        });
        // The same force in other units of length.
        let repulsion = Repulsion::new(10.0 / (unit * unit), 20.0 * unit).unwrap();
        let gravity = Gravity::new(turn * self.down).unwrap();
        Scene::new(squirmers, start, Some(repulsion), Some(gravity)).unwrap()
    }

    fn rates(&self, turn: &Rotation3<f64>, first: usize) -> [Rates; 2] {
        let scene = self.scene(turn, first);
        let plan = Plan::new(&scene).unwrap();
        models(scene.ratio()).map(|model| rates(&plan, model.as_ref(), plan.start(), 1).unwrap())
    }
}

#[test]
fn val_motion_does_not_depend_on_the_frame_nor_on_who_is_named_first() {
    let turn = Rotation3::from_axis_angle(&Unit::new_normalize(Vector3::new(2.0, 1.0, -0.4)), 1.9);
    let still = Rotation3::identity();
    let law = |met: Met| {
        let seen = met.rates(&still, 0).into_iter().zip(met.rates(&turn, 0));
        let renamed = met.rates(&still, 1);
        for ((one, turned), other) in seen.zip(renamed) {
            // Lengths and times of the other naming are in its own unit.
            let unit = met.ratio;
            let close = |a: Vector3<f64>, b: Vector3<f64>, what: &str| {
                let error = (a - b).norm() / a.norm().max(1.0);
                assert!(error < 1e-8, "{what}: {a} {b} {met:?}");
            };
            close(turn * one.midpoint, turned.midpoint, "midpoint, turned");
            close(turn * one.line, turned.line, "line, turned");
            close(one.midpoint, other.midpoint, "midpoint, renamed");
            close(one.line, -other.line / unit, "line, renamed");
            assert_close(one.ln_gap, turned.ln_gap, 1e-8, "gap, turned");
            assert_close(one.ln_gap, other.ln_gap / unit, 1e-8, "gap, renamed");
            for k in [0, 1] {
                close(turn * one.orientations[k], turned.orientations[k], "turned");
                close(
                    one.orientations[k],
                    other.orientations[1 - k] / unit,
                    "renamed",
                );
            }
        }
        Ok(())
    };
    TestRunner::new(config()).run(&met(), law).unwrap();
}

#[test]
fn val_passive_spheres_of_any_radii_rest() {
    let law = |met: Met| {
        let of = |scene: Scene| {
            let passive = scene
                .squirmers
                .map(|s| Squirmer::new(&[]).unwrap().with_radius(s.radius()).unwrap());
            Scene::new(passive, scene.start, None, None).unwrap()
        };
        let scene = of(met.scene(&Rotation3::identity(), 0));
        let plan = Plan::new(&scene).unwrap();
        for model in models(scene.ratio()) {
            let rates = rates(&plan, model.as_ref(), plan.start(), 1).unwrap();
            let all = [
                rates.midpoint,
                rates.line,
                rates.orientations[0],
                rates.orientations[1],
            ];
            assert!(
                all.iter().all(|v| v.norm() <= 0.0) && rates.ln_gap.abs() <= 0.0,
                "{rates:?}"
            );
        }
        Ok(())
    };
    TestRunner::new(config()).run(&met(), law).unwrap();
}
