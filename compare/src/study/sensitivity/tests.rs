use super::case::Measured;
use super::offsets::raised;
use super::*;
use crate::made::model;

const CHOICES: RunChoices = RunChoices {
    tolerance: Some(1e-12),
    angles_at: f64::INFINITY,
};

fn part(family: &str, vary: &[(&str, f64)]) -> Part {
    let vary: Vec<_> = (vary.iter())
        .map(|(name, value)| ((*name).to_owned(), Numbers(vec![*value])))
        .collect();
    Part {
        case: family.to_owned(),
        points: Points::new(Family::named(family).unwrap().clone(), &vary, CHOICES).unwrap(),
    }
}

fn measured(model: &Model, part: &Part) -> Measured {
    let values = part.points.values(0);
    Unit {
        model,
        part,
        values,
    }
    .measured()
    .unwrap()
}

fn lt() -> Model {
    model(Method::Lt)
}

fn value(measured: &Measured, by: &str, of: &str) -> f64 {
    let mut found = measured.derivatives.iter();
    let found = found.find(|derivative| derivative.by == by && derivative.of == of);
    found.unwrap_or_else(|| panic!("no {of} by {by}")).value
}

/// The paper's case that is known best: by lubrication theory, at right angles with `beta` 1 and `dx` 1, an offset turns the headings out of the plane by 129
/// degrees a radius.
#[test]
fn val_the_known_case_turns_by_129_degrees_a_radius() {
    let Measured { row, .. } = measured(&lt(), &part("right-angles", &[]));
    let tilt = row.tilt1_per_a.abs().max(row.tilt2_per_a.abs());
    assert!((tilt - 129.2).abs() < 0.5, "{tilt}");
    // In the plane it acts at second order only: the turn in space is that out of it.
    let by_tilt = 6.0 / tilt;
    assert!((row.linear_6deg / by_tilt - 1.0).abs() < 1e-12);
    assert!((row.offset_6deg / row.linear_6deg - 1.0).abs() < 0.02);
    assert!((row.linear_15deg / row.linear_1deg - 15.0).abs() < 1e-9);
}

/// Derivatives by parameters of the family are differences of runs; those by what the parameters are made of add up to them.
#[test]
fn val_derivatives_by_parameters_are_differences_of_runs() {
    let (model, part) = (lt(), part("right-angles", &[("dz", 0.05), ("beta", 1.0)]));
    let found = measured(&model, &part);
    let family = part.points.family();
    let angles = |name: &str, h: f64| {
        let at = [("dz", 0.05), ("beta", 1.0), ("dx", 1.0)];
        let values = at.map(|(n, v)| (n, if n == name { v + h } else { v }));
        let point = family.scene(&values).unwrap();
        let options = part.points.options(point.run);
        let run = model.run(&point.scene, &options).unwrap();
        run.outgoing.orientations.map(|p| {
            let angle = p.y.atan2(p.x).to_degrees();
            [angle, p.z.asin().to_degrees()]
        })
    };
    for name in ["dx", "dz", "beta"] {
        let difference = |h: f64| {
            let (above, below) = (angles(name, h), angles(name, -h));
            [0, 1].map(|k| [0, 1].map(|i| (above[k][i] - below[k][i]) / (2.0 * h)))
        };
        let (coarse, fine) = (difference(2e-4), difference(1e-4));
        for (k, i, of) in [
            (0, 0, "angle1"),
            (0, 1, "tilt1"),
            (1, 0, "angle2"),
            (1, 1, "tilt2"),
        ] {
            let expected = (4.0 * fine[k][i] - coarse[k][i]) / 3.0;
            let derivative = value(&found, &format!("family {name}"), of);
            let error = (derivative - expected).abs() / expected.abs().max(1.0);
            assert!(
                error < 1e-6,
                "{of} by {name}: {derivative}, differences {expected}"
            );
        }
    }
    for of in ["angle1", "tilt1", "angle2", "tilt2"] {
        let by = |name: &str| value(&found, name, of);
        let same = |a: f64, b: f64| (a - b).abs() < 1e-7 * a.abs().max(1.0);
        assert!(same(by("family dz"), by("offset dz")), "{of}");
        // The second is what is lowered.
        assert!(same(by("family dz"), -by("start z")), "{of}");
        assert!(same(by("family dx"), -by("start x")), "{of}");
        assert!(same(by("family beta"), by("beta1") + by("beta2")), "{of}");
    }
}

/// What turns or moves a whole pair in the plane turns its headings with it.
#[test]
fn a_turn_of_the_start_turns_what_goes_out() {
    let part = part("right-angles", &[]);
    let found = measured(&lt(), &part);
    let point = part.points.family().scene(&[]).unwrap();
    let [one, two] = point.scene.start;
    let separation = two.position - one.position;
    for (of, expected) in [
        ("angle1", 1.0),
        ("angle2", 1.0),
        ("tilt1", 0.0),
        ("tilt2", 0.0),
    ] {
        let by = |name: &str| value(&found, name, of);
        // The derivatives by positions are in degrees a radius.
        let moved = (separation.x * by("start y") - separation.y * by("start x")).to_radians();
        let turned = by("start angle1") + by("start angle2") + moved;
        assert!((turned - expected).abs() < 1e-7, "{of}: {turned}");
    }
    assert!(found.row.condition >= 1.0);
}

#[test]
fn val_in_the_plane_an_offset_acts_at_second_order() {
    let (model, part) = (lt(), part("right-angles", &[]));
    let found = measured(&model, &part);
    let scene = part.points.family().scene(&[]).unwrap().scene;
    let options = part.points.options(RunOptions::default());
    let angle = |dz: f64| {
        let run = model.run(&raised(&scene, dz).unwrap(), &options).unwrap();
        run.deflections_rad().map(f64::to_degrees)
    };
    let (dz, flat) = (2e-3, angle(0.0));
    let turned = angle(dz);
    for (k, expected) in [found.row.turn1_per_a2, found.row.turn2_per_a2]
        .into_iter()
        .enumerate()
    {
        let second = (turned[k] - flat[k]) / (dz * dz);
        assert!(
            (second / expected - 1.0).abs() < 1e-3,
            "{second}, {expected}"
        );
        assert!(expected.abs() > 1.0);
    }
}

/// Repulsion of that family scales with the smaller radius: at equal radii it has a kink.
#[test]
fn where_a_scene_has_a_kink_there_is_no_derivative() {
    let found = measured(&lt(), &part("incoming-angles", &[]));
    assert!(value(&found, "family lambda", "angle1").is_nan());
    assert!(value(&found, "family delta", "angle1").is_finite());
}
