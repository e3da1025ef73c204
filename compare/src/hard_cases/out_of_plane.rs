//! Nearly planar motion: displacements of 1e-15 to 0.1 out of the plane, planes turned in space, and orientations along the
//! line of centres.

use nalgebra::{Rotation3, Vector3};
use scene::{Orientation, Plan, Pose, Repulsion, Run, Scene, Squirmer};

use super::rows::larger;
use super::{Bench, Rows, stepping_error, until};
use crate::{Approach, Case, CompareError, Method, Model};

const TOLERANCE: f64 = 1e-12;
const METHODS: [Method; 3] = [Method::Lt, Method::Exact, Method::Bem];

/// Relative deviation from linear growth that is small enough to be of second order.
const NEARLY_LINEAR: f64 = 0.02;

/// The encounters: one without a symmetry, one with.
const CASES: [Case; 2] = [
    Case {
        approach: Approach::Orthogonal,
        beta: 1.0,
        dx: 1.0,
        dz: 0.0,
    },
    Case {
        approach: Approach::HeadOn,
        beta: 5.0,
        dx: 1.0,
        dz: 0.0,
    },
];

pub(super) fn cases(bench: &Bench, rows: &mut Rows) {
    for model in bench.only(&METHODS) {
        let name = model.method().name();
        for case in CASES {
            rows.attempt(name, "nearly planar", |rows| {
                nearly_planar(model, case, rows)
            });
        }
        rows.attempt(name, "along the line", |rows| along_the_line(model, rows));
    }
}

fn spatial(model: &Model, scene: &Scene) -> Result<Run, CompareError> {
    let plan = Plan::new(scene)?.in_three_dimensions();
    Ok(model.run_observed(&plan, &until(200.0, TOLERANCE), &mut |_| {})?)
}

/// The scene with `map` applied to all positions and orientations.
fn mapped(
    scene: &Scene,
    map: impl Fn(Vector3<f64>) -> Vector3<f64>,
) -> Result<Scene, CompareError> {
    let mut start = scene.start;
    for pose in &mut start {
        pose.position = map(pose.position);
        pose.orientation = Orientation::Vector(map(pose.orientation.vector()?));
    }
    Ok(Scene::new(scene.squirmers, start, scene.repulsion, None)?)
}

/// Largest distance of the final orientations from those of another run, turned by `turned`.
fn apart(run: &Run, other: &Run, turned: &Rotation3<f64>) -> f64 {
    let pairs = run.end.orientations.iter().zip(&other.end.orientations);
    pairs
        .map(|(p, q)| (p - turned * q).norm())
        .fold(0.0, larger)
}

fn nearly_planar(model: &Model, case: Case, rows: &mut Rows) -> Result<(), CompareError> {
    let name = model.method().name();
    let what = format!("{}, beta {}", case.approach, case.beta);
    let scene = case.scene()?;
    let plan = Plan::new(&scene)?.without_symmetry();
    let planar = model.run_observed(&plan, &until(200.0, TOLERANCE), &mut |_| {})?;
    // Sensitivity: change of the final orientations, divided by the displacement of the start.
    let aside = Case {
        dx: case.dx + 1e-5,
        ..case
    }
    .scene()?;
    let aside = spatial(model, &aside)?;
    let answer = 1.0 + apart(&aside, &planar, &Rotation3::identity()) / 1e-5;
    let in_space = spatial(model, &scene)?;
    let error =
        (stepping_error(&planar, TOLERANCE) + stepping_error(&in_space, TOLERANCE)) * answer;
    let why = "steps x tolerance x (1 + |y|) of both runs, times the sensitivity to a displacement of the start";
    rows.add(
        name,
        format!("{what}: orientations, difference of motion in space from motion in the plane"),
        (error, why),
        apart(&in_space, &planar, &Rotation3::identity()),
    );
    // An upright plane holds the axis on which the azimuth of a vector has no value.
    let upright = Rotation3::from_axis_angle(&Vector3::x_axis(), std::f64::consts::FRAC_PI_2);
    let askew = Rotation3::from_euler_angles(0.7, -1.1, 2.3);
    for (how, rotation) in [("upright", upright), ("askew", askew)] {
        let turned = spatial(model, &mapped(&scene, |v| rotation * v)?)?;
        // Rounding of the rotated numbers is far below the tolerance.
        rows.add(
            name,
            format!(
                "{what}, plane turned {how}: orientations, difference from motion in the plane"
            ),
            (error, why),
            apart(&turned, &planar, &rotation),
        );
    }
    for (kind, tilted) in [("raised", false), ("tilted", true)] {
        let shares = |by: f64| -> Result<[f64; 2], CompareError> {
            let scene = if tilted {
                let mut start = scene.start;
                let p = start[0].orientation.vector()?;
                start[0].orientation = Orientation::Vector(p + Vector3::z() * by);
                Scene::new(scene.squirmers, start, scene.repulsion, None)?
            } else {
                Case { dz: by, ..case }.scene()?
            };
            Ok(spatial(model, &scene)?.end.orientations.map(|p| p.z / by))
        };
        let reference = shares(1e-9)?;
        let size = reference[0].hypot(reference[1]);
        let departure = |by: f64| -> Result<f64, CompareError> {
            let found = shares(by)?;
            Ok((found[0] - reference[0]).hypot(found[1] - reference[1]) / size)
        };
        let noise = error * (1.0 + 1.0 / size);
        for by in [1e-15, 1e-12, 1e-6] {
            let why = "linear in z, with the relative error of the motion in the plane; terms of second order are smaller up to z = 1e-6";
            rows.add(
                name,
                format!("{what}, {kind} by {by:e}: growth, relative difference from that of 1e-9"),
                (noise, why),
                departure(by)?,
            );
        }
        // The motion is odd in z: the relative deviation from linear growth is of order z^2, the next term of order z^4.
        let (mut by, mut far) = (0.1, departure(0.1)?);
        while far > NEARLY_LINEAR {
            by *= 0.1;
            far = departure(by)?;
        }
        let near = departure(0.1 * by)?;
        let why =
            "odd in z: a factor of 100, plus the next term (at most 10 deviations) and both errors";
        rows.add(
            name,
            format!(
                "{what}, {kind}: ratio of the deviations from linear growth at {by:.0e} and {:.0e}, relative difference from 100",
                0.1 * by
            ),
            (10.0 * far + 2.0 * noise / near, why),
            (far / near / 100.0 - 1.0).abs(),
        );
    }
    Ok(())
}

/// Orientations along the line of centres, exactly and with a tilt of 1e-16.
fn along_the_line(model: &Model, rows: &mut Rows) -> Result<(), CompareError> {
    let name = model.method().name();
    let squirmer = Squirmer::with_beta(1.0, 1.0)?;
    for (what, [one, two]) in [
        ("facing", [1.0, -1.0]),
        ("following", [1.0, 1.0]),
        ("back to back", [-1.0, 1.0]),
    ] {
        let end = |tilt: f64| -> Result<Run, CompareError> {
            let pose = |x: f64, along: f64, tilt: f64| Pose {
                position: [x, 0.0, 0.0].into(),
                orientation: Orientation::Vector([along, tilt, -tilt].into()),
            };
            let start = [pose(-1.05, one, tilt), pose(1.05, two, 0.5 * tilt)];
            let scene = Scene::new([squirmer; 2], start, Some(Repulsion::PAPER), None)?;
            let plan = Plan::new(&scene)?.in_three_dimensions();
            Ok(model.run_observed(&plan, &until(5.0, TOLERANCE), &mut |_| {})?)
        };
        let (exactly, nearly) = (end(0.0)?, end(1e-16)?);
        let off = (exactly.end.gap.ln() - nearly.end.gap.ln()).abs()
            + (exactly.end.midpoint - nearly.end.midpoint).norm();
        let why =
            "steps x tolerance x (1 + |y|) of both runs; the effect of the tilt is of second order";
        let bound = stepping_error(&exactly, TOLERANCE) + stepping_error(&nearly, TOLERANCE);
        rows.add(
            name,
            format!("{what}: change of ln(gap) and midpoint by a tilt of 1e-16"),
            (bound, why),
            off,
        );
        let tilt = exactly
            .end
            .orientations
            .iter()
            .map(|p| p.y.abs() + p.z.abs())
            .sum::<f64>();
        rows.add(
            name,
            format!("{what}: tilt at the end without a tilt at the start"),
            (0.0, "every term is a product with zero"),
            tilt,
        );
    }
    Ok(())
}
