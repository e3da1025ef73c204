//! The plane of initial directions that the paper maps (its Sec. III).
//!
//! The family `incoming-angles` has the starts: two squirmers at a gap of 1 with the angles
//! `phi1 = pi (Sigma - Delta)/2` and `phi2 = pi (Sigma + Delta)/2`. For `Delta` and `Sigma` from 0 to 2 they do not swim
//! directly apart.

use scene::Scene;

use crate::CompareError;
use crate::scene_file::paper_scene;

/// Distance of the first and the last point from the edge of the plane. On the edge squirmers are parallel and never
/// part.
const MARGIN: f64 = 0.01;

/// Largest number of points a side.
const MOST: usize = 2000;

/// A square grid of points in the plane. An even number of points a side avoids the singular lines `Delta = 1` and
/// `Sigma = 1`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Grid(usize);

impl Grid {
    /// A grid of `points` a side, evenly spaced from 0.01 to 1.99.
    ///
    /// # Errors
    /// [`CompareError::Input`] unless `points` is from 2 to 2000.
    pub fn new(points: usize) -> Result<Self, CompareError> {
        if (2..=MOST).contains(&points) {
            Ok(Self(points))
        } else {
            let allowed = format!("give a number of points a side from 2 to {MOST}");
            Err(CompareError::input("--grid", points, allowed))
        }
    }

    /// Number of points a side.
    #[must_use]
    pub fn points(self) -> usize {
        self.0
    }

    /// The values of `Delta`, which are also those of `Sigma`.
    #[must_use]
    pub fn values(self) -> Vec<f64> {
        let step = (2.0 - 2.0 * MARGIN) / (self.0 - 1) as f64;
        (0..self.0)
            // Removes digits that are only rounding errors.
            .map(|i| ((MARGIN + step * i as f64) * 1e12).round() / 1e12)
            .collect()
    }
}

/// The two equal squirmers of a map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// Squirmer parameter `B_2/B_1`.
    pub beta: f64,
    /// Bottom-heaviness `G_bh`; gravity acts along `-y`.
    pub g: f64,
    /// Offset out of the plane, in radii: squirmer 1 starts at `z = dz/2`, squirmer 2 at `z = -dz/2`.
    pub dz: f64,
}

impl Pair {
    /// The scene that starts at a point of the plane, from the family `incoming-angles`.
    ///
    /// # Errors
    /// [`CompareError::FamilyPoint`] for numbers that are not finite.
    pub fn scene(&self, delta: f64, sigma: f64) -> Result<Scene, CompareError> {
        let Self { beta, g, dz } = *self;
        let values = [
            ("beta", beta),
            ("g", g),
            ("dz", dz),
            ("delta", delta),
            ("sigma", sigma),
        ];
        paper_scene("incoming-angles", &values)
    }
}

/// One start without symmetry for each of `pairs`. It reads all loads that any other start reads.
pub fn unsymmetric_starts(
    pairs: &[Pair],
) -> impl Iterator<Item = Result<Scene, CompareError>> + '_ {
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
