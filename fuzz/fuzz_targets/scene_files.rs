//! A text is a family or a list of mistakes, each one line; so is each scene of it. What is read is finite, and the same when read again.

#![no_main]

use compare::{Family, FamilyScene, Mistakes, SceneFile};
use fuzz::{finite, one_line};
use libfuzzer_sys::fuzz_target;

/// Values that parameters are given.
const VALUES: [f64; 8] = [0.0, -0.0, 1.0, -2.5, 1e-300, 1e300, f64::INFINITY, f64::NAN];

fn refused(mistakes: &Mistakes) {
    assert!(!mistakes.0.is_empty());
    mistakes.0.iter().for_each(one_line);
}

fn check(point: &FamilyScene) {
    for pose in &point.scene.start {
        pose.position.iter().for_each(|x| finite("position", *x));
        finite("angle", pose.orientation.angle_rad());
    }
    for squirmer in &point.scene.squirmers {
        let modes = squirmer.modes().iter().chain(squirmer.swirl());
        modes.for_each(|mode| finite("mode", *mode));
        finite("radius", squirmer.radius());
        finite("bottom-heaviness", squirmer.bottom_heaviness());
    }
    if let Some(repulsion) = &point.scene.repulsion {
        finite("kappa1", repulsion.kappa1());
        finite("kappa2", repulsion.kappa2());
    }
    if let Err(error) = point.scene.gap() {
        panic!("a scene without a gap: {error}");
    }
}

fuzz_target!(|text: &str| {
    if let Err(mistakes) = SceneFile::parse(text) {
        refused(&mistakes);
    }
    let family = match Family::parse(text) {
        Ok(family) => family,
        Err(mistakes) => return refused(&mistakes),
    };
    let parameters: Vec<(&str, f64)> = family.parameters().collect();
    for (name, value) in &parameters {
        finite(name, *value);
    }
    match (family.scene(&[]), family.scene(&parameters)) {
        (Ok(one), Ok(other)) => {
            check(&one);
            // A default that is an expression has its own value.
            assert_eq!(one, other);
        }
        other => panic!("the defaults are no scene: {other:?}"),
    }
    for (name, _) in parameters.iter().take(3) {
        for value in VALUES {
            match family.scene(&[(name, value)]) {
                Ok(point) => check(&point),
                Err(mistakes) => refused(&mistakes),
            }
        }
    }
});
