//! The directions in which a scene is changed, and the derivatives of the outgoing headings along them.

use nalgebra::{DMatrix, Vector3};
use scene::{
    Hydrodynamics, Perturbation, RATIOS, RunOptions, Scene, SceneError, TangentRun, are_unlike,
    run_with_tangents_by_ratio,
};

use super::DerivativeRow;
use crate::study::maps::{apart, raised};
use crate::{CompareError, Family, Method, Model};

/// The ratios of the radii beside one, whose models say how the motion changes with it.
pub(super) fn beside(ratio: f64) -> Option<[f64; 4]> {
    let beside = [-0.02, -0.01, 0.01, 0.02].map(|part| ratio * (1.0 + part));
    let allowed = |ratio: &f64| RATIOS.contains(ratio);
    beside.iter().all(allowed).then_some(beside)
}

/// Steps of the differences by which a scene changes with a parameter of its family, over the larger of its value and 1. Where two do not agree the scene
/// has a kink.
const STEPS: [f64; 2] = [1e-2, 1e-3];

/// Largest difference of the two, relative to the larger of them and 1.
const SMOOTH: f64 = 1e-6;

/// One direction.
struct Direction {
    name: String,
    /// Its unit.
    unit: &'static str,
    /// None where the scene has a kink.
    change: Option<Perturbation>,
    /// Whether it is a coordinate of the start, all of which make up the condition number, and how long it is there.
    of_start: Option<f64>,
}

/// All directions of a scene.
pub(super) struct Directions {
    all: Vec<Direction>,
    offset: usize,
}

/// A derivative, as it stands in a row.
pub(super) struct Derivative {
    pub by: String,
    pub of: &'static str,
    pub value: f64,
    unit: String,
}

impl Derivative {
    pub fn row(&self, method: Method) -> DerivativeRow {
        DerivativeRow {
            method,
            by: self.by.clone(),
            of: self.of.to_owned(),
            value: self.value,
            unit: self.unit.clone(),
        }
    }
}

/// The horizontal and the upward unit vector across a heading; none for one that stands on the x-y plane.
fn across(p: &Vector3<f64>) -> Option<[Vector3<f64>; 2]> {
    let aside = Vector3::z().cross(p);
    let level = aside.norm();
    (level > 1e-9).then(|| {
        let aside = aside / level;
        [aside, p.cross(&aside)]
    })
}

impl Directions {
    /// Those of the start, of the scene's own numbers and of the parameters of its family.
    pub fn of(
        scene: &Scene,
        family: &Family,
        values: &[(&str, f64)],
    ) -> Result<Self, CompareError> {
        let mut all = of_start(scene)?;
        let offset = all.len();
        all.push(Direction {
            name: "offset dz".to_owned(),
            unit: "a",
            change: Some(raised()),
            of_start: None,
        });
        all.extend(of_numbers(scene));
        for (name, default) in family.parameters() {
            let given = values.iter().find(|(given, _)| *given == name);
            let value = given.map_or(default, |(_, value)| *value);
            all.push(Direction {
                name: format!("family {name}"),
                unit: "unit",
                change: of_parameter(family, values, (name, value)),
                of_start: None,
            });
        }
        Ok(Self { all, offset })
    }

    /// The place of the offset out of the plane.
    pub fn offset(&self) -> usize {
        self.offset
    }

    /// The run with its tangents; NaN along directions without a derivative: where the scene has a kink, and where the radii change under
    /// a model of one ratio or with a cut at the smaller of two equal radii.
    pub fn tangents(
        &self,
        model: &Model,
        scene: &Scene,
        options: &RunOptions,
    ) -> Result<TangentRun, SceneError> {
        let ratio = scene.ratio();
        let others: Option<Vec<&dyn Hydrodynamics>> = beside(ratio)
            .filter(|_| are_unlike(ratio) || model.cutoff().is_none())
            .and_then(|ratios| {
                ratios
                    .into_iter()
                    .map(|ratio| model.of_ratio(ratio))
                    .collect()
            });
        let has_others = others.is_some();
        let known = |of: &Direction| of.change.filter(|of| of.ratio == 0.0 || has_others);
        let changes: Vec<Option<Perturbation>> = self.all.iter().map(known).collect();
        let known: Vec<Perturbation> = (changes.iter())
            .map(|of| of.unwrap_or(Perturbation::NONE))
            .collect();
        let own = model.of_ratio_or_first(ratio);
        let others = others.unwrap_or_default();
        let mut tangents = run_with_tangents_by_ratio(scene, (own, &others), options, &known)?;
        for (of, outgoing) in changes.iter().zip(&mut tangents.outgoing) {
            if of.is_none() {
                *outgoing = [Vector3::repeat(f64::NAN); 2];
            }
        }
        Ok(tangents)
    }

    /// Largest singular value of the derivative of the outgoing headings by the start, in radians over radii and radians.
    pub fn condition(&self, tangents: &TangentRun) -> f64 {
        let columns: Vec<Vec<f64>> = (self.all.iter().zip(&tangents.outgoing))
            .filter_map(|(of, [one, two])| {
                let length = of.of_start?;
                let vectors = [*one / length, *two / length];
                Some(vectors.iter().flat_map(|v| [v.x, v.y, v.z]).collect())
            })
            .collect();
        if columns.iter().flatten().any(|x| !x.is_finite()) {
            return f64::NAN;
        }
        let matrix = DMatrix::from_fn(6, columns.len(), |i, j| columns[j][i]);
        matrix.singular_values().max()
    }

    /// By how much both outgoing headings rise out of the x-y plane along a direction, in degrees.
    pub fn tilts(&self, tangents: &TangentRun, direction: usize) -> [f64; 2] {
        [0, 1].map(|k| angles(tangents, direction, k)[1].to_degrees())
    }

    /// All derivatives.
    pub fn derivatives(&self, tangents: &TangentRun) -> Vec<Derivative> {
        let mut all = Vec::with_capacity(4 * self.all.len());
        for (i, direction) in self.all.iter().enumerate() {
            let [[angle1, tilt1], [angle2, tilt2]] = [0, 1].map(|k| angles(tangents, i, k));
            let named = [
                ("angle1", angle1),
                ("tilt1", tilt1),
                ("angle2", angle2),
                ("tilt2", tilt2),
            ];
            let per = direction.unit;
            for (of, value) in named {
                // Along an angle the derivative is a pure number.
                let (value, unit) = if per == "rad" {
                    (value, "-".to_owned())
                } else {
                    (value.to_degrees(), format!("deg/{per}"))
                };
                all.push(Derivative {
                    by: direction.name.clone(),
                    of,
                    value,
                    unit,
                });
            }
        }
        all
    }
}

/// By how much the outgoing heading of squirmer `k` turns in the x-y plane and rises out of it along a direction, in radians.
fn angles(tangents: &TangentRun, direction: usize, k: usize) -> [f64; 2] {
    let p = &tangents.run.outgoing.orientations[k];
    let change = &tangents.outgoing[direction][k];
    across(p).map_or([f64::NAN; 2], |[aside, up]| {
        let level = p.x.hypot(p.y);
        [change.dot(&aside) / level, change.dot(&up)]
    })
}

/// By how much both outgoing headings turn in the x-y plane with an offset out of it, in degrees per radius.
pub(super) fn turns_by_offset(
    model: &Model,
    scene: &Scene,
    options: &RunOptions,
) -> Result<[f64; 2], SceneError> {
    let own = model.of_ratio_or_first(scene.ratio());
    let tangents = run_with_tangents_by_ratio(scene, (own, &[]), options, &[raised()])?;
    Ok([0, 1].map(|k| angles(&tangents, 0, k)[0].to_degrees()))
}

/// Position of squirmer 2 from squirmer 1, and the headings.
fn of_start(scene: &Scene) -> Result<Vec<Direction>, CompareError> {
    let axes = [
        ("x", Vector3::x()),
        ("y", Vector3::y()),
        ("z", Vector3::z()),
    ];
    let mut all: Vec<Direction> = (axes.into_iter())
        .map(|(name, axis)| Direction {
            name: format!("start {name}"),
            unit: "a",
            change: Some(apart(axis)),
            of_start: Some(1.0),
        })
        .collect();
    for (k, pose) in scene.start.iter().enumerate() {
        let p = pose.orientation.vector()?;
        let level = p.x.hypot(p.y);
        let across = across(&p).unwrap_or([Vector3::x(), Vector3::y()]);
        // By the angle itself, which is longer than the turn where a heading is steep.
        for ((name, unit), length) in [("angle", across[0]), ("tilt", across[1])]
            .into_iter()
            .zip([if level > 1e-9 { level } else { 1.0 }, 1.0])
        {
            let mut change = Perturbation::NONE;
            change.orientations[k] = unit * length;
            all.push(Direction {
                name: format!("start {name}{}", k + 1),
                unit: "rad",
                change: Some(change),
                of_start: Some(length),
            });
        }
    }
    Ok(all)
}

/// The numbers of the scene: `beta` of each squirmer, repulsion, bottom-heaviness and the ratio of the radii.
fn of_numbers(scene: &Scene) -> Vec<Direction> {
    let mut all = Vec::new();
    let mut push = |name: String, change: Perturbation| {
        all.push(Direction {
            name,
            unit: "unit",
            change: Some(change),
            of_start: None,
        });
    };
    for (k, squirmer) in scene.squirmers.iter().enumerate() {
        if squirmer.mode(0) != 0.0 {
            let mut change = Perturbation::NONE;
            change.modes[k][1] = squirmer.mode(0);
            push(format!("beta{}", k + 1), change);
        }
    }
    if scene.repulsion.is_some() {
        for i in [0, 1] {
            let mut change = Perturbation::NONE;
            change.repulsion[i] = 1.0;
            push(format!("kappa{}", i + 1), change);
        }
    }
    if scene.gravity.is_some() {
        for (k, squirmer) in scene.squirmers.iter().enumerate() {
            if squirmer.gravity_torque() != 0.0 {
                let mut change = Perturbation::NONE;
                change.gravity_torques[k] = squirmer.gravity_torque() / squirmer.bottom_heaviness();
                push(format!("G{}", k + 1), change);
            }
        }
    }
    if are_unlike(scene.ratio()) {
        let change = Perturbation {
            ratio: 1.0,
            ..Perturbation::NONE
        };
        push("lambda".to_owned(), change);
    }
    all
}

/// How a scene changes with a parameter of its family; none where it has a kink or no neighbours.
fn of_parameter(
    family: &Family,
    values: &[(&str, f64)],
    (name, value): (&str, f64),
) -> Option<Perturbation> {
    let scene = |h: f64| {
        let others = values.iter().filter(|(other, _)| *other != name);
        let values: Vec<(&str, f64)> = others.copied().chain([(name, value + h)]).collect();
        let point = family.scene(&values).map_err(CompareError::FamilyPoint)?;
        Ok::<_, CompareError>(point.scene)
    };
    let scale = value.abs().max(1.0);
    let [coarse, fine] = STEPS.map(|step| Perturbation::along(scene, step * scale));
    let (coarse, fine) = (coarse.ok()?, fine.ok()?);
    (fine.distance(&coarse) <= SMOOTH).then_some(fine)
}
