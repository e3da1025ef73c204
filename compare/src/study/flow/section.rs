//! The plane of a picture of the flow, and the window in it.
//!
//! Where the motion keeps to a plane of constant z the picture is in that plane, with the axes x and y. Otherwise the plane contains the line of
//! centres `d` and the sum of the orientations' parts across it; the first axis is along `d`, and the origin is between the centres.

use scene::nalgebra::Vector3;
use scene::{Configuration, Plan};

/// Parts of orientations across the line of centres that count as none.
const NEARLY_ALONG: f64 = 1e-9;

/// Room about the spheres, in radii of the larger one.
const MARGIN: f64 = 2.0;

/// A plane through both centres, with its axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section {
    /// Where both coordinates are zero.
    pub origin: Vector3<f64>,
    /// Unit vectors of the two axes.
    pub axes: [Vector3<f64>; 2],
    /// Whether the axes are x and y of the laboratory.
    pub is_level: bool,
}

impl Section {
    /// The plane of a pair.
    pub(super) fn of(plan: &Plan, configuration: &Configuration) -> Self {
        let midpoint = configuration.midpoint;
        if plan.is_level() {
            return Self {
                origin: Vector3::new(0.0, 0.0, midpoint.z),
                axes: [Vector3::x(), Vector3::y()],
                is_level: true,
            };
        }
        let d = configuration.line;
        let [one, two] = configuration.orientations.map(|p| p - d * d.dot(&p));
        let aside = Vector3::ith(d.iamin(), 1.0);
        // Opposite parts have no sum, but lie in a plane.
        let across = [one + two, one - two, aside - d * d.dot(&aside)];
        let found = across.iter().find(|across| across.norm() > NEARLY_ALONG);
        let second = found.copied().unwrap_or(aside).normalize();
        Self {
            origin: midpoint,
            axes: [d, second],
            is_level: false,
        }
    }

    /// The unit normal.
    #[must_use]
    pub fn normal(&self) -> Vector3<f64> {
        self.axes[0].cross(&self.axes[1])
    }

    /// The components of a vector along the axes.
    #[must_use]
    pub fn along(&self, vector: &Vector3<f64>) -> (f64, f64) {
        (vector.dot(&self.axes[0]), vector.dot(&self.axes[1]))
    }

    /// The coordinates of a point.
    #[must_use]
    pub fn coordinates(&self, point: &Vector3<f64>) -> (f64, f64) {
        self.along(&(point - self.origin))
    }

    /// The point with these coordinates.
    #[must_use]
    pub fn point(&self, (x, y): (f64, f64)) -> Vector3<f64> {
        self.origin + self.axes[0] * x + self.axes[1] * y
    }

    /// The smallest and the largest coordinates of the spheres along either axis.
    fn extent(&self, configuration: &Configuration) -> [(f64, f64); 2] {
        let [one, two] = configuration.positions().map(|at| self.coordinates(&at));
        let [a, b] = configuration.radii;
        [(one.0, two.0), (one.1, two.1)]
            .map(|(one, two)| ((one - a).min(two - b), (one + a).max(two + b)))
    }

    /// Half the side of a square about both spheres with a margin.
    pub(super) fn half_width(&self, configuration: &Configuration) -> f64 {
        let [x, y] = self.extent(configuration).map(|(low, high)| high - low);
        let [a, b] = configuration.radii;
        0.5 * x.max(y) + MARGIN * a.max(b)
    }
}

/// A square window in a plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// The plane.
    pub section: Section,
    /// Coordinates of the middle.
    pub middle: (f64, f64),
    /// Half the side, in radii.
    pub half_width: f64,
}

impl Window {
    /// The window about both spheres.
    pub(super) fn about(section: Section, configuration: &Configuration, half_width: f64) -> Self {
        let [x, y] = section.extent(configuration);
        Self {
            section,
            middle: (0.5 * (x.0 + x.1), 0.5 * (y.0 + y.1)),
            half_width,
        }
    }

    /// Coordinates of a place given as shares of the sides, from the lower left corner.
    #[must_use]
    pub fn at(&self, (x, y): (f64, f64)) -> (f64, f64) {
        let along = |middle: f64, share: f64| middle + self.half_width * (2.0 * share - 1.0);
        (along(self.middle.0, x), along(self.middle.1, y))
    }
}
