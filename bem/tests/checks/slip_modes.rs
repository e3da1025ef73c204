//! Every slip mode, squirming and swirl: against `exact`, and solved for in the laboratory frame.

use std::f64::consts::PI;

use approx::assert_relative_eq;
use bem::{Bem, Body, Lab, Motion};
use exact::Exact;
use nalgebra::{UnitQuaternion, Vector3};
use scene::{Gap, Hydrodynamics, LoadSet, SelfOther, legendre};

const STILL: Motion = Motion {
    velocity: Vector3::new(0.0, 0.0, 0.0),
    angular_velocity: Vector3::new(0.0, 0.0, 0.0),
};

#[test]
fn val_all_eight_squirming_and_swirl_modes_are_the_exact_ones() {
    let (model, exact) = (Bem::new(Bem::DEFAULT_LEVEL).unwrap(), Exact::new());
    let set = LoadSet::all(8).with_swirl(8);
    for (eps, bound) in [(1.0, 2e-4), (0.1, 2e-4), (0.01, 5e-4)] {
        let gap = Gap::new(eps).unwrap();
        let (pair, swirl) = model.loads_with_swirl(gap, set).unwrap();
        let (exact_pair, exact_swirl) = exact.loads_with_swirl(gap, set).unwrap();
        let found = pair.named().into_iter().chain(swirl.named());
        let truth = exact_pair.named().into_iter().chain(exact_swirl.named());
        let mut worst = (0.0, String::new());
        for ((name, a), (_, b)) in found.zip(truth) {
            let error = (a - b).abs() / b.abs().max(1.0);
            if error > worst.0 {
                worst = (error, name);
            }
        }
        println!("gap {eps}: {worst:?}");
        assert!(worst.0 < bound, "{worst:?} at gap {eps}");
    }
}

#[test]
fn swirl_needs_the_systems_of_its_symmetry_and_no_others() {
    let gap = Gap::new(0.5).unwrap();
    let solves = |set| {
        let model = Bem::new(1).unwrap();
        let _ = model.loads_with_swirl(gap, set).unwrap();
        model.solves()
    };
    assert_eq!(solves(LoadSet::all(1).with_swirl(2)), 6);
    assert_eq!(solves(LoadSet::axial(1)), 2);
}

#[test]
fn val_a_lone_squirmer_with_swirl_spins_at_minus_its_first_mode() {
    let p = Vector3::new(1.0, 2.0, -2.0) / 3.0;
    let mut body = Body::squirmer(Vector3::zeros(), p, &[1.5]);
    body.swirl = vec![0.7, -1.0, 0.4];
    let motion = Lab::new(2, &[body]).unwrap().free_motions().unwrap()[0];
    assert_relative_eq!(motion.velocity, p, epsilon = 1e-3);
    assert_relative_eq!(motion.angular_velocity, p * -0.7, epsilon = 1e-3);
}

/// A squirmer held still beside a sphere held still along a skew line: its loads on both, solved for in
/// the laboratory frame, against the angular factors of the pair frame.
fn check_angular_factors(modes: &[f64], swirl: &[f64], tolerance: f64) {
    let eps = 0.5;
    let set = LoadSet::all(modes.len()).with_swirl(swirl.len());
    let gap = Gap::new(eps).unwrap();
    let (pair, by_swirl) = Exact::new().loads_with_swirl(gap, set).unwrap();
    let turn = UnitQuaternion::from_euler_angles(0.4, 1.0, -0.7);
    let (d, t) = (turn * Vector3::z(), turn * Vector3::x());
    let angle = 0.8f64;
    let p = d * angle.cos() + t * angle.sin();
    let mut first = Body::squirmer(Vector3::new(0.1, 0.2, 0.3), p, modes);
    first.swirl = swirl.to_vec();
    let second = Body::rigid(first.position + d * (2.0 + eps));
    let lab = Lab::new(3, &[first, second]).unwrap();
    let found = lab.loads(&[STILL, STILL]).unwrap();
    let cross = d.cross(&t);
    for (k, load) in found.iter().enumerate() {
        let of = |s: SelfOther| PI * if k == 0 { s.own() } else { s.other() };
        let (mut force, mut torque) = (Vector3::zeros(), Vector3::zeros());
        let orders = || legendre(angle.cos()).map(|l| (l.p, l.w * angle.sin()));
        for ((b, mode), (along, across)) in modes.iter().zip(pair.modes()).zip(orders()) {
            force += (d * (along * of(mode.xf)) + t * (across * of(mode.yf))) * *b;
            torque += cross * (across * of(mode.yt) * b);
        }
        for ((c, mode), (along, across)) in swirl.iter().zip(by_swirl.modes()).zip(orders()) {
            force += cross * (across * of(mode.yfc) * c);
            torque += (d * (along * of(mode.xtc)) + t * (across * of(mode.ytc))) * *c;
        }
        assert_relative_eq!(load.force, force, epsilon = tolerance);
        assert_relative_eq!(load.torque, torque, epsilon = tolerance);
    }
}

#[test]
fn val_swirl_solved_for_in_the_laboratory_has_the_angular_factors_of_the_pair_frame() {
    check_angular_factors(&[], &[0.9, -1.1, 0.6], 5e-4);
}

#[test]
fn val_high_modes_solved_for_in_the_laboratory_have_the_angular_factors_of_the_pair_frame() {
    let high = [0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -1.5];
    check_angular_factors(&high, &high, 5e-3);
}
