//! Loads of two squirming spheres, equal or of unlike radii, and the flow about them, by the boundary element method.
//!
//! The Stokes flow about the spheres is written as a single layer over their surfaces,
//!
//! ```text
//! u(x) = 1/(8 pi) Σ_spheres ∫ (I/r + r r/r³) f dS(y),   r = x - y, r = |r|,   viscosity 1, radius 1,
//! ```
//!
//! after Pozrikidis, *Boundary Integral and Singularity Methods* (1992), chapters 4 and 5. `f` is the
//! density of force on the fluid, so that the fluid's force on a sphere is `-∫ f dS` and its torque
//! about the centre `-∫ (y - centre) x f dS`. The density is quadratic over each panel, the panels
//! are exact spherical triangles, and the velocity is matched at the nodes. Over a sphere of radius a it is a times that over the unit sphere,
//! so that every mesh is one of the unit sphere.
//!
//! | module | what |
//! |---|---|
//! | [`mesh`] | triangulated spheres, finer towards the contact point, mirror-symmetric to the last bit |
//! | [`quadrature`] | rules for far, near and touching panels |
//! | [`surface`] | one meshed sphere: the velocity that its hat functions induce at a point |
//! | [`pair`] | two spheres in the pair frame, split by symmetry into at most six small dense systems, three if they are unlike |
//! | [`lab`] | any spheres anywhere, one dense system: squirmers that are free, or held |
//! | [`Layers`] | densities on both spheres by any velocities of their surfaces, and their flow anywhere |
//! | [`model`] | [`Bem`], the model `gap -> loads` that scenes use |
//!
//! ```
//! use bem::Bem;
//! use scene::{Gap, Hydrodynamics, LoadSet};
//! let loads = Bem::new(1)?.loads(Gap::new(1.0)?, LoadSet::all(1))?;
//! assert!((loads.xa.own() - 1.3685).abs() < 0.01);
//! // Beside a sphere of twice the radius it is harder to move.
//! let [small, _] = Bem::of_ratio(1, 2.0)?.interacting_loads_of_each(Gap::new(1.0)?, LoadSet::all(1))?;
//! assert!(small.pair.xa.own() > loads.xa.own());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`Bem`] knows the flow too ([`scene::Fluid`]):
//!
//! ```
//! use bem::Bem;
//! use scene::{Fluid, MovingPair, Plan, Pose, Scene, Squirmer};
//! let squirmer = Squirmer::with_beta(1.0, 3.0)?;
//! let start = [Pose::planar(-1.5, 0.0, 90.0), Pose::planar(1.5, 0.0, 0.0)];
//! let plan = Plan::new(&Scene::new([squirmer; 2], start, None, None)?)?;
//! let bem = Bem::new(1)?;
//! let flow = bem.flow(&MovingPair::free(&plan, &bem, plan.start())?)?;
//! // On a surface the fluid moves with it.
//! let normal = scene::nalgebra::Vector3::y();
//! let point = plan.start().positions()[0] + normal;
//! let moved = flow.at(&point).velocity - flow.pair().surface_velocity(0, &normal);
//! assert!(moved.norm() < flow.error_estimate());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod dense;
mod error;
mod estimates;
mod fluid;
mod interior;
pub mod lab;
mod layers;
mod lone;
pub mod mesh;
mod missing;
pub mod model;
pub mod pair;
mod pieces;
pub mod quadrature;
mod refinement;
pub mod slip;
mod stresses;
pub mod surface;

pub use error::BemError;
pub use estimates::Estimates;
pub use lab::{Body, Lab, Load, Motion};
pub use layers::Layers;

pub use model::Bem;
