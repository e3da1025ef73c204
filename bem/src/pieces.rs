//! The meshes of each level: their size laws, and the ranges of gaps between which their topology changes.
//!
//! Near contact the gap between two unlike spheres has the shape of that between equal ones of the radius `2 a_1 a_2/(a_1 + a_2)`, the harmonic mean:
//! smallest gaps and [`SEAMS`] are in units of that. Far apart the larger sphere sets the scale: one mesh serves for all gaps from 1.024 of its
//! radii on. Between the last two of the seams there are as many more as it takes.

use std::f64::consts::PI;

use scene::{Gap, RATIOS, are_unlike};

use crate::BemError;
use crate::mesh::{Grading, MeshFamily};
use crate::pair::UnlikeMeshes;

/// Gaps at which the topology of the mesh of equal spheres changes; beyond the last one the mesh is uniform and fixed.
const SEAMS: [f64; 6] = [0.00098, 0.004, 0.016, 0.064, 0.256, 1.024];

/// Smallest gap at levels 1, 2, ...: the smallest end of a piece at which every load was found within
/// 0.5 % of `exact` (`tests/accuracy.rs`).
const SMALLEST: [f64; 5] = [0.004, 0.001, 0.00025, 0.00025, 0.00025];

/// Lowest and highest level.
pub(crate) const LEVELS: (usize, usize) = (1, 5);

/// The level to which size laws are stated.
pub(crate) const DEFAULT_LEVEL: usize = 3;

/// Panels a quarter turn about the line of centres, in the middle of the sphere near contact, at the
/// default level. (Where the size law is `slope θ`, a whole number keeps rings regular.)
const PANELS: f64 = 6.0;

/// Panels shrink by this factor a level.
const SHRINK: f64 = 0.75;

/// The size law at the default level; see [`Grading`].
const LAW: Grading = Grading {
    scale: PI / PANELS,
    far: 2.5,
    slope: 0.5,
    core: 0.5,
    width: f64::INFINITY,
    gap: f64::INFINITY,
};

/// Edge length per width of the gap in the [pieces](WIDTH_PIECES) where it matters; see [`Grading`]. Without it
/// X11A at gap 0.001 is off by 5.8e-4, 4.5e-4, 9.1e-5 at levels 3, 4, 5; with it by 3.1e-5 and 7e-7 at levels 4
/// and 5, for a fifth more nodes.
const WIDTH: f64 = 30.0;

/// Levels from which panels are tied to the gap's width, and the largest gap of the pieces where they are.
const WIDTH_PIECES: (i32, f64) = (4, SEAMS[1]);

/// The same beyond the last seam, where the mesh is uniform.
const FAR_LAW: Grading = Grading {
    scale: 1.0 / PANELS,
    far: 2.0,
    ..LAW
};

/// Gap beside the mirror image from which on the mesh of a sphere is uniform and fixed although that of the other, larger one is not: about the
/// last seam, where the piece begins that this gap is in.
const FAR: f64 = 0.7;

/// The size law of a level in a piece that ends at the gap `largest`, in units of the harmonic mean. Levels 0 and -1 serve only as the
/// coarser ones of levels 1 and 2.
fn law(level: i32, largest: f64) -> Grading {
    let law = if largest.is_finite() { LAW } else { FAR_LAW };
    let tied = level >= WIDTH_PIECES.0 && largest <= WIDTH_PIECES.1;
    Grading {
        scale: law.scale * SHRINK.powi(level - DEFAULT_LEVEL as i32),
        width: if tied { WIDTH } else { f64::INFINITY },
        ..law
    }
}

/// Ranges of gaps, in radii of sphere 1, each with meshes of one topology.
#[derive(Clone, Debug)]
pub(crate) struct Pieces {
    /// Radius of sphere 2 over that of sphere 1.
    ratio: f64,
    /// Harmonic mean of the radii.
    mean: f64,
    /// In units of the harmonic mean.
    in_means: Vec<f64>,
    /// In radii of sphere 1.
    seams: Vec<f64>,
}

impl Pieces {
    /// Of spheres whose radii are in the given `ratio`.
    pub fn new(ratio: f64) -> Self {
        let mean = 2.0 * ratio / (1.0 + ratio);
        let in_means = seams(ratio.max(1.0) / mean);
        Self {
            ratio,
            mean,
            seams: in_means.iter().map(|seam| seam * mean).collect(),
            in_means,
        }
    }

    /// Radius of sphere 2 over that of sphere 1.
    pub fn ratio(&self) -> f64 {
        self.ratio
    }

    /// Whether the radii are equal.
    pub fn are_equal(&self) -> bool {
        !are_unlike(self.ratio)
    }

    /// All seams, in radii of sphere 1.
    pub fn seams(&self) -> &[f64] {
        &self.seams
    }

    /// The piece of a gap. A seam belongs to the smaller gaps.
    pub fn of(&self, eps: f64) -> usize {
        self.seams.iter().filter(|&&seam| seam < eps).count()
    }

    /// Smallest gap that a level resolves.
    pub fn smallest(&self, level: usize) -> f64 {
        smallest(level) * self.mean
    }

    /// Ends of each piece, in units of the harmonic mean. Gaps smaller than the first seam have the mesh of the smallest piece.
    fn ends(&self) -> impl Iterator<Item = (f64, f64)> {
        let least = SMALLEST.into_iter().fold(f64::INFINITY, f64::min);
        let starts = std::iter::once(least).chain(self.in_means.iter().copied());
        starts.zip((self.in_means.iter().copied()).chain([f64::INFINITY]))
    }

    /// Meshes of equal spheres at a level, piece by piece.
    pub fn families(&self, level: i32) -> Result<Vec<MeshFamily>, BemError> {
        self.ends().map(|ends| family(level, ends)).collect()
    }

    /// Meshes of unlike spheres at a level, piece by piece.
    pub fn unlike(&self, level: i32) -> Result<Vec<UnlikeMeshes>, BemError> {
        self.ends().map(|ends| self.meshes(level, ends)).collect()
    }

    /// Meshes of unlike spheres at a level in the piece with these ends.
    fn meshes(
        &self,
        level: i32,
        (smallest, largest): (f64, f64),
    ) -> Result<UnlikeMeshes, BemError> {
        let of_sphere = |[least, most]: [f64; 2]| {
            let most = if least < FAR { most } else { f64::INFINITY };
            let tied = if most.is_finite() { largest } else { most };
            (law(level, tied), most)
        };
        let gaps = [smallest, largest].map(|gap| gap * self.mean);
        UnlikeMeshes::new(self.ratio, of_sphere, gaps)
    }

    /// Refuses a gap that a level does not resolve.
    ///
    /// # Errors
    /// [`BemError::GapUnresolved`] with the level that would do.
    pub fn check(&self, level: usize, gap: Gap) -> Result<(), BemError> {
        // Rounding of exp(ln(eps)) must not refuse the end of the range itself.
        let resolves = |level: &usize| gap.eps() * (1.0 + 1e-12) >= self.smallest(*level);
        if resolves(&level) {
            return Ok(());
        }
        let (lowest, highest) = LEVELS;
        Err(BemError::GapUnresolved {
            spheres: None,
            eps: gap.eps(),
            level,
            resolved: self.smallest(level),
            needed: (lowest..=highest).find(resolves),
            smallest: self.smallest(highest),
        })
    }
}

/// Seams, in units of the harmonic mean, if the larger radius is `larger` of these.
///
/// The last one is at 1.024 of the larger radius. Between it and the one before pieces are shorter than the others: where gaps are
/// large beside the smaller sphere, the cap on the larger one grows with the gap, not with its square root.
fn seams(larger: f64) -> Vec<f64> {
    let [inner @ .., before, last] = SEAMS;
    let last = last * larger;
    let pieces = 1 + (larger.log2() + 0.75) as i32;
    let factor = last / before;
    let between = (1..pieces).map(|k| before * factor.powf(f64::from(k) / f64::from(pieces)));
    inner
        .into_iter()
        .chain([before])
        .chain(between)
        .chain([last])
        .collect()
}

fn family(level: i32, (smallest, largest): (f64, f64)) -> Result<MeshFamily, BemError> {
    MeshFamily::new(law(level, largest), smallest, largest)
}

/// The family of meshes at a level for a sphere at the gap `eps` from another one, which has `ratio` times its radius; the gap is in its own.
pub(crate) fn mesh_family(level: usize, eps: f64, ratio: f64) -> Result<MeshFamily, BemError> {
    check_level(level)?;
    let pieces = Pieces::new(ratio);
    let ends = pieces
        .ends()
        .nth(pieces.of(eps))
        .unwrap_or((eps, f64::INFINITY));
    if pieces.are_equal() {
        family(level as i32, ends)
    } else {
        let [own, _] = pieces.meshes(level as i32, ends)?.into_families();
        Ok(own)
    }
}

/// Smallest gap that a level resolves, in units of the harmonic mean of the radii.
pub(crate) fn smallest(level: usize) -> f64 {
    let (lowest, highest) = LEVELS;
    SMALLEST[level.clamp(lowest, highest) - lowest]
}

pub(crate) fn check_level(level: usize) -> Result<(), BemError> {
    let (lowest, highest) = LEVELS;
    if (lowest..=highest).contains(&level) {
        Ok(())
    } else {
        Err(BemError::Level {
            level,
            lowest,
            highest,
        })
    }
}

/// Refuses radii that are too unlike, or that are none.
pub(crate) fn check_ratio(ratio: f64) -> Result<(), BemError> {
    if RATIOS.contains(&ratio) {
        Ok(())
    } else {
        Err(BemError::Ratio {
            ratio,
            lowest: *RATIOS.start(),
            highest: *RATIOS.end(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seams_of_equal_spheres_are_exactly_those_stated_and_nearly_equal_ones_have_as_many() {
        assert_eq!(Pieces::new(1.0).seams(), SEAMS);
        for ratio in [1.0 + 1e-9, 1.0 - 1e-9, 1.1, 1.3] {
            assert_eq!(Pieces::new(ratio).seams().len(), SEAMS.len());
        }
    }

    #[test]
    fn seams_go_from_the_mean_radius_to_the_larger_and_are_nowhere_far_apart() {
        for ratio in [0.01, 0.3, 0.8, 1.2, 1.5, 3.0, 100.0] {
            let pieces = Pieces::new(ratio);
            let seams = pieces.seams();
            let mean = 2.0 / (1.0 + 1.0 / ratio);
            approx::assert_relative_eq!(seams[0], SEAMS[0] * mean, max_relative = 1e-14);
            approx::assert_relative_eq!(
                seams[seams.len() - 1],
                SEAMS[5] * ratio.max(1.0),
                max_relative = 1e-14
            );
            for ends in seams.windows(2) {
                let factor = ends[1] / ends[0];
                assert!(factor > 1.5 && factor < 5.0, "{factor} at {ratio}");
            }
        }
    }
}
