//! What can fail in the boundary element method.

/// Everything that this crate can refuse or fail at, with the offending numbers. Later versions may add variants.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BemError {
    /// A refinement level that does not exist.
    #[error("mesh level {level} is not allowed: levels are {lowest} to {highest}")]
    Level {
        /// The level asked for.
        level: usize,
        /// Lowest level.
        lowest: usize,
        /// Highest level.
        highest: usize,
    },
    /// Radii that are too unlike.
    #[error(
        "radii in the ratio {ratio:?} are not allowed: radius 2 over radius 1 is {lowest} to {highest}"
    )]
    Ratio {
        /// The ratio asked for.
        ratio: f64,
        /// Smallest ratio.
        lowest: f64,
        /// Largest ratio.
        highest: f64,
    },
    /// A sphere whose radius is none.
    #[error("sphere {sphere} has the radius {radius:?}: it must be positive and finite")]
    Radius {
        /// Index of the sphere.
        sphere: usize,
        /// Its radius.
        radius: f64,
    },
    /// A gap too small for the meshes of a level.
    #[error(
        "gap {eps:e}{} is not resolved by mesh level {level}{}: {}",
        whose(*spheres),
        limit(*spheres, *resolved),
        advice(*needed, *smallest)
    )]
    GapUnresolved {
        /// Between which spheres, by their indices, if there may be more than the pair.
        spheres: Option<(usize, usize)>,
        /// The gap, in radii of sphere 1 of a pair, in the unit of length of the laboratory.
        eps: f64,
        /// The level asked for.
        level: usize,
        /// Smallest gap that the level resolves there, in the same unit.
        resolved: f64,
        /// The lowest level that would do, if there is one.
        needed: Option<usize>,
        /// Smallest gap of the highest level.
        smallest: f64,
    },
    /// A mesh that should be its own mirror image is not.
    #[error("the mesh is not mirror-symmetric: vertex {vertex} has no image")]
    AsymmetricMesh {
        /// Index of the vertex without an image.
        vertex: usize,
    },
    /// The solution of a dense system does not satisfy it.
    #[error(
        "dense system of {unknowns} unknowns: relative residual {residual:e} above {allowed:e}"
    )]
    Residual {
        /// Number of unknowns.
        unknowns: usize,
        /// Residual, relative to the right-hand side and the solution.
        residual: f64,
        /// Largest residual allowed.
        allowed: f64,
    },
    /// Singular values of a dense system were not found.
    #[error("dense system of {unknowns} unknowns: its singular values were not found")]
    SingularValues {
        /// Number of unknowns.
        unknowns: usize,
    },
    /// Two spheres overlap or touch.
    #[error(
        "spheres {first} and {second} overlap: their centres are {distance} apart, more than {touching} is needed"
    )]
    Overlap {
        /// Index of the first sphere.
        first: usize,
        /// Index of the second sphere.
        second: usize,
        /// Distance of their centres.
        distance: f64,
        /// The sum of their radii.
        touching: f64,
    },
    /// A list with an entry for each sphere has the wrong length.
    #[error("{found} motions for {expected} spheres")]
    Count {
        /// Number of spheres.
        expected: usize,
        /// Number of entries found.
        found: usize,
    },
}

fn whose(spheres: Option<(usize, usize)>) -> String {
    spheres.map_or_else(String::new, |(first, second)| {
        format!(" between spheres {first} and {second}")
    })
}

fn limit(spheres: Option<(usize, usize)>, resolved: f64) -> String {
    spheres.map_or_else(String::new, |_| {
        format!(", which resolves gaps from {resolved:.2e} there")
    })
}

fn advice(needed: Option<usize>, smallest: f64) -> String {
    needed.map_or_else(
        || format!("the finest mesh resolves gaps from {smallest:e}"),
        |level| format!("level {level} would do"),
    )
}
