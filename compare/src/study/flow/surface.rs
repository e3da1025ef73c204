//! The flow on the surface of a sphere, at the corners of triangles.

use bem::mesh::{Grading, Mesh, rings};
use scene::nalgebra::Vector3;
use scene::stress::Axes;
use scene::{Flow, MovingPair};

use super::FlowFrame;

/// Edges of the triangles, in radii, finer towards the other sphere if it is near.
const EDGES: Grading = Grading {
    scale: 1.0,
    far: 0.12,
    slope: 0.25,
    core: 0.5,
    width: f64::INFINITY,
    gap: f64::INFINITY,
};

/// Triangles over a sphere, with quantities at their corners.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceField {
    /// Corners, in the laboratory.
    pub points: Vec<Vector3<f64>>,
    /// Triangles as indices of their corners, anticlockwise seen from outside.
    pub triangles: Vec<[usize; 3]>,
    /// Slip velocity.
    pub slip: Vec<Vector3<f64>>,
    /// Velocity of the surface: that of the sphere and the slip, in the frame of the field.
    pub surface_velocity: Vec<Vector3<f64>>,
    /// Velocity of the fluid at the surface, in the same frame: the same but for the error of the flow.
    pub velocity: Vec<Vector3<f64>>,
    /// The fluid's traction on the sphere.
    pub traction: Vec<Vector3<f64>>,
    /// Density of the single layer, if the flow is made of one.
    pub density: Option<Vec<Vector3<f64>>>,
}

impl SurfaceField {
    /// The flow on the sphere of index 0 or 1, in a frame.
    #[must_use]
    pub fn new(flow: &dyn Flow, sphere: usize, frame: FlowFrame) -> Self {
        let pair = flow.pair();
        let configuration = &pair.configuration;
        let radius = configuration.radii[sphere];
        let centre = configuration.positions()[sphere];
        let moving = frame.velocity(pair);
        let gap = configuration.gap.eps() / radius;
        let mesh = rings(&Grading {
            gap: if gap < 1.0 { gap } else { f64::INFINITY },
            ..EDGES
        });
        let normals: Vec<_> = (mesh.vertices.iter())
            .map(|vertex| facing_other(pair, sphere, vertex))
            .collect();
        let points: Vec<_> = normals.iter().map(|n| centre + n * radius).collect();
        let of =
            |value: &dyn Fn(&Vector3<f64>) -> Vector3<f64>| normals.iter().map(value).collect();
        Self {
            slip: of(&|n| pair.slip(sphere, n)),
            surface_velocity: of(&|n| pair.surface_velocity(sphere, n) - moving),
            velocity: (points.iter())
                .map(|at| flow.at(at).velocity - moving)
                .collect(),
            traction: of(&|n| flow.traction(sphere, n)),
            density: normals.iter().map(|n| flow.density(sphere, n)).collect(),
            points,
            triangles: mesh.triangles,
        }
    }
}

/// A vector of a mesh whose axis points to the other sphere, in the laboratory.
fn facing_other(pair: &MovingPair, sphere: usize, vector: &Vector3<f64>) -> Vector3<f64> {
    let axes = Axes::of(pair);
    let second = if sphere == 0 { axes.e2 } else { -axes.e2 };
    axes.e1 * vector.x + second * vector.y + axes.towards_other(sphere) * vector.z
}

/// The largest speed of the surfaces of some pairs in a frame, or that of the fluid far away if it is larger: the end of a colour scale.
#[must_use]
pub fn fastest(pairs: &[MovingPair], frame: FlowFrame) -> f64 {
    let mesh = rings(&Grading { far: 0.2, ..EDGES });
    let each = pairs.iter().map(|pair| fastest_of(pair, frame, &mesh));
    each.fold(0.0, f64::max)
}

fn fastest_of(pair: &MovingPair, frame: FlowFrame, mesh: &Mesh) -> f64 {
    let moving = frame.velocity(pair);
    let speeds = [0, 1].into_iter().flat_map(|sphere| {
        let velocity = move |normal: &Vector3<f64>| pair.surface_velocity(sphere, normal) - moving;
        mesh.vertices
            .iter()
            .map(move |normal| velocity(&facing_other(pair, sphere, normal)).norm())
    });
    speeds.fold(moving.norm(), f64::max)
}
