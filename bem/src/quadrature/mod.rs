//! Quadrature over spherical triangles, for a kernel that is singular at the target.
//!
//! A panel is the image `x = X/|X|` of a flat triangle; the barycentric coordinates of `X` are its
//! parameters and the linear hat functions, and `dS = (X.N)/|X|³ dA`, N the flat triangle's normal.
//! Far targets get a product rule of few points, near ones the same rules on panels divided until
//! each part is far enough, and targets at a corner a rule whose Jacobian cancels the singularity.

mod accuracy;
mod rules;

pub use accuracy::{ORDERS, TOLERANCE, order_for, order_limits};
pub use rules::{Point, corner_rule, product_rule};
