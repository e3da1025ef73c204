//! Inputs at the ends of the number range.

use scene::{
    Gap, Gravity, Hydrodynamics, LoadSet, Orientation, Pose, Repulsion, RunOptions, Scene,
    SceneError, Squirmer,
};

use super::machine::ALL;
use super::{Rows, until};
use crate::{CompareError, Model};

/// A pair in contact, nothing symmetric about it.
fn pair(
    squirmer: Squirmer,
    repulsion: Option<Repulsion>,
    gravity: Option<Gravity>,
    half: f64,
) -> Result<Scene, SceneError> {
    let pose = |x: f64, y: f64, angle: f64| Pose {
        position: [x, y, 0.0].into(),
        orientation: Orientation::Radians(angle),
    };
    Scene::new(
        [squirmer; 2],
        [pose(-half, 0.0, 0.4), pose(half, 0.1, 2.0)],
        repulsion,
        gravity,
    )
}

pub(super) fn refused(rows: &mut Rows) -> Result<(), CompareError> {
    let plain = Squirmer::with_beta(1.0, 1.0)?;
    let mut accepted = Vec::new();
    let mut tell = |what: String, taken: bool| {
        if taken {
            accepted.push(what);
        }
    };
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        tell(format!("gap {bad}"), Gap::new(bad).is_ok());
        tell(format!("mode {bad}"), Squirmer::new(&[1.0, bad]).is_ok());
        tell(format!("swirl {bad}"), plain.with_swirl(&[bad]).is_ok());
        tell(format!("beta {bad}"), Squirmer::with_beta(1.0, bad).is_ok());
        tell(
            format!("speed {bad}"),
            Squirmer::with_beta(bad, 1.0).is_ok(),
        );
        tell(
            format!("bottom-heaviness {bad}"),
            plain.bottom_heavy(bad).is_ok(),
        );
        tell(format!("kappa1 {bad}"), Repulsion::new(bad, 1.0).is_ok());
        tell(format!("kappa2 {bad}"), Repulsion::new(1.0, bad).is_ok());
        tell(
            format!("gravity {bad}"),
            Gravity::new([bad, 0.0, 1.0].into()).is_ok(),
        );
        tell(
            format!("position {bad}"),
            pair(plain, None, None, bad).is_ok(),
        );
        for angle in [
            Orientation::Radians(bad),
            Orientation::Vector([bad, 0.0, 1.0].into()),
        ] {
            let mut start = pair(plain, None, None, 2.0)?.start;
            start[0].orientation = angle;
            tell(
                format!("orientation {bad}"),
                Scene::new([plain; 2], start, None, None).is_ok(),
            );
        }
    }
    for bad in [0.0, -0.0, -1.0] {
        tell(format!("gap {bad}"), Gap::new(bad).is_ok());
        tell(format!("kappa2 {bad}"), Repulsion::new(1.0, bad).is_ok());
    }
    tell(
        "gravity of no direction".to_owned(),
        Gravity::new([0.0; 3].into()).is_ok(),
    );
    rows.add(
        ALL,
        named(
            "NaN, infinite and negative inputs that are accepted",
            &accepted,
        ),
        (0.0, "each is refused by a typed error"),
        accepted.len() as f64,
    );
    Ok(())
}

/// Numbers at the ends of their range: a typed error, or a run whose numbers are finite.
pub(super) fn extremes(model: &Model, rows: &mut Rows) -> Result<(), CompareError> {
    let name = model.method().name();
    let mut wrong = Vec::new();
    for eps in [
        f64::from_bits(1),
        1e-310,
        f64::MIN_POSITIVE,
        1e-200,
        1e200,
        f64::MAX,
    ] {
        if let Ok(loads) = model.loads(Gap::new(eps)?, LoadSet::all(2))
            && !loads.columns().all(f64::is_finite)
        {
            wrong.push(format!("loads at gap {eps:e}"));
        }
    }
    let options = RunOptions {
        max_steps: 20_000,
        ..until(10.0, 1e-8)
    };
    let plain = Squirmer::with_beta(1.0, 1.0)?;
    let paper = Some(Repulsion::PAPER);
    let tiny = f64::from_bits(1);
    let scenes = [
        (
            "speed 1e150",
            pair(Squirmer::with_beta(1e150, 1.0)?, paper, None, 1.1),
        ),
        (
            "speed 1e300",
            pair(Squirmer::with_beta(1e300, 1.0)?, paper, None, 1.1),
        ),
        (
            "speed 5e-324",
            pair(Squirmer::with_beta(tiny, 1.0)?, paper, None, 1.1),
        ),
        (
            "beta 1e300",
            pair(Squirmer::with_beta(1.0, 1e300)?, paper, None, 1.1),
        ),
        (
            "kappa1 1e300",
            pair(plain, Some(Repulsion::new(1e300, 100.0)?), None, 1.1),
        ),
        (
            "kappa2 1e300",
            pair(plain, Some(Repulsion::new(10.0, 1e300)?), None, 1.1),
        ),
        (
            "kappa2 1e-300",
            pair(plain, Some(Repulsion::new(10.0, 1e-300)?), None, 1.1),
        ),
        (
            "kappa1 5e-324",
            pair(plain, Some(Repulsion::new(tiny, 100.0)?), None, 1.1),
        ),
        (
            "G 1e300",
            pair(plain.bottom_heavy(1e300)?, paper, Some(Gravity::DOWN), 1.1),
        ),
        (
            "G 5e-324",
            pair(plain.bottom_heavy(tiny)?, paper, Some(Gravity::DOWN), 1.1),
        ),
        ("distance 1e150", pair(plain, paper, None, 5e149)),
        ("distance 1e300", pair(plain, paper, None, 5e299)),
        ("distance 3e308", pair(plain, paper, None, 1.5e308)),
    ];
    for (what, scene) in scenes {
        let Ok(scene) = scene else { continue };
        if let Ok(run) = model.run(&scene, &options) {
            let positions = run.end.positions();
            let finite = positions
                .iter()
                .flat_map(|p| p.iter())
                .chain(&run.end.angles_rad)
                .all(|v| v.is_finite());
            if !finite || run.end_time.is_nan() {
                wrong.push(what.to_owned());
            }
        }
    }
    for bad in [f64::NAN, f64::INFINITY, 0.0, -1.0] {
        let scene = pair(plain, paper, None, 1.1)?;
        if model.run(&scene, &until(bad, 1e-8)).is_ok()
            || model.run(&scene, &until(1.0, bad)).is_ok()
        {
            wrong.push(format!("end time or tolerance {bad}"));
        }
    }
    let measure = "extreme inputs that are neither refused nor answered by finite numbers";
    rows.add(
        name,
        named(measure, &wrong),
        (0.0, "a typed error or finite numbers"),
        wrong.len() as f64,
    );
    Ok(())
}

/// A measure with the names of those that it counts, if there are any.
fn named(measure: &str, found: &[String]) -> String {
    if found.is_empty() {
        measure.to_owned()
    } else {
        format!("{measure}: {}", found.join(", "))
    }
}
