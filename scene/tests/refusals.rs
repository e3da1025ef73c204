//! Numbers that are none, and numbers that mean nothing: each is refused by a typed error where it comes in.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use scene::{
    Gap, Gravity, Isolated, Orientation, Pose, Repulsion, RunOptions, Scene, SceneError, Squirmer,
    run,
};

/// What no input may be.
const NOT_FINITE: [f64; 3] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

/// What no input may be that must be positive.
const NOT_POSITIVE: [f64; 6] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.0, -0.0, -1.0];

fn squirmer() -> Squirmer {
    Squirmer::with_beta(1.0, 1.0).unwrap()
}

fn pose(x: f64, orientation: Orientation) -> Pose {
    Pose {
        position: [x, 0.1, 0.0].into(),
        orientation,
    }
}

/// A pair whose first squirmer stands at `x` with this orientation; the second stands at 2.
fn pair(x: f64, orientation: Orientation) -> Result<Scene, SceneError> {
    let poses = [pose(x, orientation), pose(2.0, Orientation::Radians(2.0))];
    Scene::new([squirmer(); 2], poses, None, None)
}

#[test]
fn gaps_must_be_positive_and_finite() {
    for bad in NOT_POSITIVE {
        let refused = Gap::new(bad);
        assert!(
            matches!(refused, Err(SceneError::InvalidGap { .. })),
            "{bad}: {refused:?}"
        );
    }
}

#[test]
fn properties_of_squirmers_must_be_finite() {
    for bad in NOT_FINITE {
        for (what, refused) in [
            ("mode", Squirmer::new(&[1.0, bad])),
            ("swirl", squirmer().with_swirl(&[bad])),
            ("beta", Squirmer::with_beta(1.0, bad)),
            ("speed", Squirmer::with_beta(bad, 1.0)),
            ("bottom-heaviness", squirmer().bottom_heavy(bad)),
        ] {
            assert!(
                matches!(refused, Err(SceneError::NotFinite { .. })),
                "{what} {bad}: {refused:?}"
            );
        }
    }
}

#[test]
fn strength_and_decay_rate_of_the_repulsion_must_be_positive_and_finite() {
    for bad in NOT_POSITIVE {
        for refused in [Repulsion::new(bad, 1.0), Repulsion::new(1.0, bad)] {
            assert!(refused.is_err(), "{bad}: {refused:?}");
        }
    }
}

#[test]
fn gravity_must_have_a_direction() {
    for bad in NOT_FINITE {
        assert!(Gravity::new([bad, 0.0, 1.0].into()).is_err(), "{bad}");
    }
    assert!(Gravity::new([0.0; 3].into()).is_err());
}

#[test]
fn positions_and_orientations_must_be_finite() {
    assert!(pair(-2.0, Orientation::Radians(0.4)).is_ok());
    for bad in NOT_FINITE {
        let vector = Orientation::Vector([bad, 0.0, 1.0].into());
        for (what, refused) in [
            ("position", pair(bad, Orientation::Radians(0.4))),
            ("angle", pair(-2.0, Orientation::Radians(bad))),
            ("vector", pair(-2.0, vector)),
        ] {
            assert!(refused.is_err(), "{what} {bad}");
        }
    }
}

#[test]
fn runs_must_have_a_positive_end_time_and_tolerance() {
    let scene = pair(-2.0, Orientation::Radians(0.4)).unwrap();
    assert!(run(&scene, &Isolated::EQUAL, &RunOptions::default()).is_ok());
    for bad in NOT_POSITIVE {
        for options in [
            RunOptions {
                end_time: bad,
                ..RunOptions::default()
            },
            RunOptions {
                tolerance: bad,
                ..RunOptions::default()
            },
        ] {
            let refused = run(&scene, &Isolated::EQUAL, &options);
            assert!(
                matches!(refused, Err(SceneError::NotPositive { .. })),
                "{options:?}: {refused:?}"
            );
        }
    }
}
