//! The plane of initial conditions that the paper maps (its Sec. III).
//!
//! Two squirmers start on the x axis at `x = -3/2` and `3/2`, where lubrication begins to act, with the
//! angles `phi1 = pi (Sigma - Delta)/2` and `phi2 = pi (Sigma + Delta)/2`. With `Delta` and `Sigma` from 0
//! to 2 the two do not swim directly apart.

use std::f64::consts::{FRAC_PI_2, PI};

use scene::{Gravity, Orientation, Pose, Repulsion, Scene, SceneError, Squirmer};

use crate::CompareError;

/// Distance of the first and the last point from the edge of the plane: on the edge itself parallel
/// squirmers never part.
const MARGIN: f64 = 0.01;

/// Most points a side.
const MOST: usize = 2000;

/// Half the distance of the centres at the start.
const HALF_DISTANCE: f64 = 1.5;

/// Points of the plane, the same along both sides. An even number of them avoids the singular
/// lines `Delta = 1` and `Sigma = 1`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Grid(usize);

impl Grid {
    /// `points` a side, evenly from 0.01 to 1.99.
    ///
    /// # Errors
    /// [`CompareError::Input`] unless there are from 2 to 2000.
    pub fn new(points: usize) -> Result<Self, CompareError> {
        if (2..=MOST).contains(&points) {
            Ok(Self(points))
        } else {
            let allowed = format!("give a number of points a side from 2 to {MOST}");
            Err(CompareError::input("--grid", points, allowed))
        }
    }

    /// Points a side.
    #[must_use]
    pub fn points(self) -> usize {
        self.0
    }

    /// The values of `Delta`, and of `Sigma`.
    #[must_use]
    pub fn values(self) -> Vec<f64> {
        let step = (2.0 - 2.0 * MARGIN) / (self.0 - 1) as f64;
        (0..self.0)
            // Without the digits that only rounding has put there.
            .map(|i| ((MARGIN + step * i as f64) * 1e12).round() / 1e12)
            .collect()
    }
}

/// Two equal squirmers of a map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// Squirmer parameter `B_2/B_1`.
    pub beta: f64,
    /// Bottom-heaviness `G_bh`; gravity acts along `-y`.
    pub g: f64,
    /// Offset out of the plane, in radii: the first starts raised by half of it, the second lowered.
    pub dz: f64,
}

impl Pair {
    /// The scene that starts at a point of the plane.
    ///
    /// # Errors
    /// [`SceneError`] for numbers that are not finite.
    pub fn scene(&self, delta: f64, sigma: f64) -> Result<Scene, SceneError> {
        let squirmer = Squirmer::with_beta(1.0, self.beta)?.bottom_heavy(self.g)?;
        let pose = |side: f64, angle: f64| Pose {
            position: [side * HALF_DISTANCE, 0.0, -side * 0.5 * self.dz].into(),
            orientation: Orientation::Radians(angle),
        };
        let second = FRAC_PI_2 * (sigma + delta);
        // The mirror image of the second, to the last bit where Sigma = 1.
        let first = PI * (sigma - 1.0) - (second - PI);
        let start = [pose(-1.0, first), pose(1.0, second)];
        let gravity = (self.g != 0.0).then_some(Gravity::DOWN);
        Scene::new([squirmer; 2], start, Some(Repulsion::PAPER), gravity)
    }
}

/// A start of each of `pairs` without a symmetry: what it reads holds what any other start reads.
pub fn unsymmetric_starts(pairs: &[Pair]) -> impl Iterator<Item = Result<Scene, SceneError>> + '_ {
    pairs.iter().map(|pair| pair.scene(MARGIN, MARGIN))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grid_runs_from_edge_to_edge_and_an_even_one_avoids_the_singular_lines() {
        let values = Grid::new(100).unwrap().values();
        assert_eq!(values.first(), Some(&0.01));
        assert_eq!(values.last(), Some(&1.99));
        assert!((values[1] - 0.03).abs() < 1e-15);
        assert!(values.iter().all(|v| (v - 1.0).abs() > 0.005));
        assert!(Grid::new(1).is_err());
        assert!(Grid::new(2001).is_err());
    }
}
