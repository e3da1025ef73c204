//! Spheres anywhere, in the laboratory's frame: one dense system, no symmetry used.
//!
//! Each sphere has its own mesh, whose refined pole is turned towards its nearest neighbour. The
//! densities of the 6 rigid motions of each sphere and of the slip are solved for, which gives the
//! resistance matrix R and the loads by slip; free motion V then follows from
//! `R V + slip loads + external loads = 0`. This is the check on the pair frame: other equations, other
//! meshes, slip solved for rather than by reciprocity.
//!
//! Radii may be unlike. Over a sphere of radius a the single layer is a times that over the unit sphere, so that each mesh is one of the unit
//! sphere and the unknowns are `a f`, as in the [pair frame](crate::pair).
//!
//! A mesh is refined towards one neighbour alone. Every other neighbour meets panels that are larger, and a
//! gap that these do not resolve would give loads without a single right digit: such gaps are refused
//! ([`BemError::GapUnresolved`]). At the smallest gap that a level accepts, whatever the place of the
//! contact on the mesh, every load of a pair was found within 1 % of `exact` (`tests/lab.rs`).

mod poles;
mod resolution;

use nalgebra::{DMatrix, DVector, Unit, UnitQuaternion, Vector3};
use rayon::prelude::*;

use crate::dense::solve_all;
use crate::pieces::check_level;
use crate::surface::{Block, Profile, Surface, Target, Work};
use crate::{BemError, slip};
pub(crate) use poles::turned;
use poles::{Pole, poles};

/// Size of the rank-one term that fixes the multiple of the normal in each density.
const DEFLATION: f64 = 0.16;

/// A sphere: a squirmer, or a rigid sphere if it has no modes.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Centre.
    pub position: Vector3<f64>,
    /// Radius, 1 unless it is set.
    pub radius: f64,
    /// Unit orientation p.
    pub orientation: Unit<Vector3<f64>>,
    /// Squirming modes `B_1, B_2, ...`.
    pub modes: Vec<f64>,
    /// Swirl modes `C_1, C_2, ...`.
    pub swirl: Vec<f64>,
    /// External force.
    pub force: Vector3<f64>,
    /// External torque.
    pub torque: Vector3<f64>,
    /// Rotation of the mesh, after its pole was turned towards the nearest neighbour.
    pub mesh_rotation: UnitQuaternion<f64>,
}

impl Body {
    /// A force-free squirmer of radius 1.
    #[must_use]
    pub fn squirmer(position: Vector3<f64>, orientation: Vector3<f64>, modes: &[f64]) -> Self {
        Self {
            position,
            radius: 1.0,
            orientation: Unit::new_normalize(orientation),
            modes: modes.to_vec(),
            swirl: Vec::new(),
            force: Vector3::zeros(),
            torque: Vector3::zeros(),
            mesh_rotation: UnitQuaternion::identity(),
        }
    }

    /// A force-free rigid sphere of radius 1.
    #[must_use]
    pub fn rigid(position: Vector3<f64>) -> Self {
        Self::squirmer(position, Vector3::z(), &[])
    }

    /// The same with another radius.
    #[must_use]
    pub fn with_radius(self, radius: f64) -> Self {
        Self { radius, ..self }
    }

    fn slip(&self, normal: &Vector3<f64>) -> Vector3<f64> {
        let p = &self.orientation;
        let squirming = (1..)
            .zip(&self.modes)
            .map(|(n, b)| slip::axisymmetric(n, p, normal) * *b);
        let swirl = (1..)
            .zip(&self.swirl)
            .map(|(n, c)| slip::axisymmetric_swirl(n, p, normal) * *c);
        squirming.chain(swirl).sum()
    }
}

/// Velocity and angular velocity of a sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// Velocity of the centre.
    pub velocity: Vector3<f64>,
    /// Angular velocity.
    pub angular_velocity: Vector3<f64>,
}

/// The fluid's force and torque on a sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Load {
    /// Force.
    pub force: Vector3<f64>,
    /// Torque about the centre.
    pub torque: Vector3<f64>,
}

/// Spheres in a fluid, solved.
#[derive(Clone, Debug)]
pub struct Lab {
    /// Loads by unit motions, six columns a sphere: velocity, angular velocity.
    loads_by_motion: DMatrix<f64>,
    loads_by_slip: DVector<f64>,
    external: DVector<f64>,
}

impl Lab {
    /// Solves for the spheres `bodies` with meshes of refinement level `level`.
    ///
    /// # Errors
    /// [`BemError::Radius`] for a radius that is none, [`BemError::Overlap`] if two spheres overlap, [`BemError::GapUnresolved`] if the meshes do not resolve the
    /// gap between any two of them, [`BemError::Level`] for a level that does not exist, [`BemError::Residual`] if the dense system could not be solved.
    pub fn new(level: usize, bodies: &[Body]) -> Result<Self, BemError> {
        let spheres = meshed(level, bodies)?;
        let places: Vec<Place> = places(&spheres);
        let rows: Vec<f64> = places
            .par_iter()
            .flat_map_iter(|place| rows(&spheres, place, places.len()))
            .collect();
        let densities = solve_all(&rows, &right_hand_sides(&spheres, &places))?;
        let loads = |density: &Vec<f64>| loads(&spheres, &places, density);
        let (by_slip, by_motion) = densities
            .x
            .split_last()
            .map_or((None, &[][..]), |(s, m)| (Some(s), m));
        let columns: Vec<DVector<f64>> = by_motion.iter().map(loads).collect();
        let external = bodies
            .iter()
            .flat_map(|b| b.force.iter().chain(b.torque.iter()).copied());
        Ok(Self {
            loads_by_motion: DMatrix::from_fn(6 * bodies.len(), columns.len(), |i, j| {
                columns[j][i]
            }),
            loads_by_slip: by_slip.map_or_else(|| DVector::zeros(0), loads),
            external: DVector::from_iterator(6 * bodies.len(), external),
        })
    }

    /// How the spheres move, each free under its slip and its external force and torque.
    ///
    /// # Errors
    /// [`BemError::Residual`] if the resistance matrix is singular, which it is not for a good mesh.
    pub fn free_motions(&self) -> Result<Vec<Motion>, BemError> {
        let resistance = -self.loads_by_motion.clone();
        let unknowns = resistance.nrows();
        let motions = resistance
            .lu()
            .solve(&(&self.loads_by_slip + &self.external))
            .ok_or(BemError::Residual {
                unknowns,
                residual: f64::INFINITY,
                allowed: 0.0,
            })?;
        Ok(vector_pairs(&motions)
            .map(|(velocity, angular_velocity)| Motion {
                velocity,
                angular_velocity,
            })
            .collect())
    }

    /// The fluid's loads on the spheres, slip included, when they move as prescribed.
    ///
    /// # Errors
    /// [`BemError::Count`] unless there is a motion for each sphere.
    pub fn loads(&self, motions: &[Motion]) -> Result<Vec<Load>, BemError> {
        let expected = self.external.len() / 6;
        if motions.len() != expected {
            return Err(BemError::Count {
                expected,
                found: motions.len(),
            });
        }
        let values = motions
            .iter()
            .flat_map(|m| m.velocity.iter().chain(m.angular_velocity.iter()).copied());
        let motion = DVector::from_iterator(6 * expected, values);
        let loads = &self.loads_by_motion * motion + &self.loads_by_slip;
        Ok(vector_pairs(&loads)
            .map(|(force, torque)| Load { force, torque })
            .collect())
    }
}

fn vector_pairs(of: &DVector<f64>) -> impl Iterator<Item = (Vector3<f64>, Vector3<f64>)> + '_ {
    let (sixes, _) = of.as_slice().as_chunks::<6>();
    sixes
        .iter()
        .map(|&[a, b, c, d, e, f]| (Vector3::new(a, b, c), Vector3::new(d, e, f)))
}

/// A sphere with its mesh; `rotation` turns the mesh's frame into the laboratory's.
struct Sphere<'a> {
    body: &'a Body,
    surface: Surface,
    rotation: UnitQuaternion<f64>,
}

/// A vertex of a sphere, and its normal in the laboratory's frame.
struct Place {
    sphere: usize,
    vertex: usize,
    normal: Vector3<f64>,
}

fn meshed(level: usize, bodies: &[Body]) -> Result<Vec<Sphere<'_>>, BemError> {
    check_level(level)?;
    check_radii(bodies)?;
    let poles = poles(bodies)?;
    resolution::check(level, bodies, &poles)?;
    let sphere = |(body, pole): (_, Pole)| {
        let profile = if pole.gap.is_finite() {
            Profile::beside_mirror_image(pole.gap)
        } else {
            Profile::alone()
        };
        let mesh = pole.family(level)?.at(pole.gap);
        Ok(Sphere {
            body,
            surface: Surface::new((mesh.clone(), profile), (&mesh, profile)),
            rotation: pole.rotation,
        })
    };
    bodies.iter().zip(poles).map(sphere).collect()
}

fn check_radii(bodies: &[Body]) -> Result<(), BemError> {
    for (sphere, Body { radius, .. }) in bodies.iter().enumerate() {
        if !(*radius > 0.0 && radius.is_finite()) {
            return Err(BemError::Radius {
                sphere,
                radius: *radius,
            });
        }
    }
    Ok(())
}

fn places(spheres: &[Sphere<'_>]) -> Vec<Place> {
    let of = |(sphere, s): (usize, &Sphere<'_>)| -> Vec<Place> {
        let vertices = s.surface.nodes().iter();
        let place = |(vertex, v)| Place {
            sphere,
            vertex,
            normal: s.rotation * v,
        };
        vertices.enumerate().map(place).collect()
    };
    spheres.iter().enumerate().flat_map(of).collect()
}

/// The three rows of a target.
fn rows(spheres: &[Sphere<'_>], target: &Place, count: usize) -> Vec<f64> {
    let mut rows = vec![0.0; 9 * count];
    let mut offset = 0;
    for (k, sphere) in spheres.iter().enumerate() {
        let own = k == target.sphere;
        let apart = spheres[target.sphere].body.position - sphere.body.position;
        let point = if own {
            sphere.surface.nodes()[target.vertex]
        } else {
            let radius = spheres[target.sphere].body.radius;
            sphere.rotation.inverse() * (target.normal * radius + apart) / sphere.body.radius
        };
        let mut blocks = vec![Block::default(); sphere.surface.nodes().len()];
        let at = Target {
            point,
            reference: point,
            node: own.then_some(target.vertex),
        };
        sphere
            .surface
            .add_row(&at, &mut blocks, &mut Work::default());
        if own {
            deflate(&sphere.surface, &point, &mut blocks);
        }
        let rotation = sphere.rotation.to_rotation_matrix();
        for (v, block) in blocks.iter().enumerate() {
            let local = nalgebra::Matrix3::from_fn(|a, c| block[a][c]);
            let turned = rotation.matrix() * local * rotation.matrix().transpose();
            for a in 0..3 {
                for c in 0..3 {
                    rows[a * 3 * count + 3 * (offset + v) + c] = turned[(a, c)];
                }
            }
        }
        offset += blocks.len();
    }
    rows
}

fn deflate(surface: &Surface, normal: &Vector3<f64>, blocks: &mut [Block]) {
    for (v, block) in blocks.iter_mut().enumerate() {
        let weights = surface.deflation(v) * DEFLATION;
        for (a, row) in block.iter_mut().enumerate() {
            for (c, slot) in row.iter_mut().enumerate() {
                *slot += normal[a] * weights[c];
            }
        }
    }
}

/// Velocities of all vertices by each unit motion of each sphere, and last by slip.
fn right_hand_sides(spheres: &[Sphere<'_>], places: &[Place]) -> Vec<Vec<f64>> {
    let mut all = Vec::with_capacity(6 * spheres.len() + 1);
    for (sphere, Sphere { body, .. }) in spheres.iter().enumerate() {
        for k in 0..6 {
            let axis = Vector3::ith(k % 3, 1.0);
            let velocity = |p: &Place| match (p.sphere == sphere, k < 3) {
                (false, _) => Vector3::zeros(),
                (true, true) => axis,
                (true, false) => axis.cross(&p.normal) * body.radius,
            };
            all.push(flat(places, velocity));
        }
    }
    all.push(flat(places, |p| spheres[p.sphere].body.slip(&p.normal)));
    all
}

fn flat(places: &[Place], velocity: impl Fn(&Place) -> Vector3<f64>) -> Vec<f64> {
    places
        .iter()
        .flat_map(|p| <[f64; 3]>::from(velocity(p)))
        .collect()
}

/// Force and torque on each sphere, by the density times the sphere's radius.
fn loads(spheres: &[Sphere<'_>], places: &[Place], density: &[f64]) -> DVector<f64> {
    let mut loads = DVector::zeros(6 * spheres.len());
    let (threes, _) = density.as_chunks::<3>();
    for (place, &f) in places.iter().zip(threes) {
        let sphere = &spheres[place.sphere];
        let local = sphere.rotation.inverse() * Vector3::from(f);
        let (force, torque) = sphere.surface.force_and_torque(place.vertex, &local);
        let radius = sphere.body.radius;
        let force = sphere.rotation * force * radius;
        let torque = sphere.rotation * torque * (radius * radius);
        for a in 0..3 {
            loads[6 * place.sphere + a] -= force[a];
            loads[6 * place.sphere + 3 + a] -= torque[a];
        }
    }
    loads
}
