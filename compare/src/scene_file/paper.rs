//! The families that ship: the encounters of the paper, and cargo.

use std::sync::LazyLock;

use scene::Scene;

use super::{Family, FamilyScene};
use crate::CompareError;

/// The families that ship, read once. All of them can be read: a test holds it.
static PAPER: LazyLock<Vec<(&str, Family)>> = LazyLock::new(|| {
    (Family::PAPER.iter())
        .filter_map(|(name, text)| Some((*name, Family::parse(text).ok()?)))
        .collect()
});

impl Family {
    /// The names and the texts of the paper's families, which are part of the program.
    pub const PAPER: [(&str, &str); 4] = fixtures::FAMILIES;

    /// The family of the paper with this name; `None` if there is none.
    #[must_use]
    pub fn named(name: &str) -> Option<&'static Self> {
        let (_, family) = PAPER.iter().find(|(known, _)| *known == name)?;
        Some(family)
    }
}

/// The scene of one of the paper's families at some values of its parameters.
///
/// # Errors
/// [`CompareError::FamilyPoint`] for numbers that are not finite, and for spheres that overlap.
pub(crate) fn paper_scene(name: &str, values: &[(&str, f64)]) -> Result<Scene, CompareError> {
    paper_point(name, values).map(|point| point.scene)
}

/// The same with how it is run.
///
/// # Errors
/// As [`paper_scene`].
pub(crate) fn paper_point(name: &str, values: &[(&str, f64)]) -> Result<FamilyScene, CompareError> {
    let family = Family::named(name).ok_or_else(|| {
        CompareError::input("a family", name, "give the name of a family that ships")
    })?;
    family.scene(values).map_err(CompareError::FamilyPoint)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]
    use std::f64::consts::{FRAC_PI_2, PI};

    use scene::{Gravity, Orientation, Plan, Pose, Repulsion, RunOptions, Squirmer};

    use super::super::SAMPLE_INTERVAL;
    use super::*;
    use crate::study::maps::{Grid, Pair};
    use crate::{Approach, Case, Defaults};

    /// The numbers of a scene, so that zeros of either sign differ too.
    fn bits(scene: &Scene) -> Vec<u64> {
        let angle = |k: usize| match scene.start[k].orientation {
            Orientation::Radians(angle) => angle,
            Orientation::Vector(_) => f64::NAN,
        };
        let position = scene.start.iter().flat_map(|pose| pose.position.iter());
        (position.copied())
            .chain([angle(0), angle(1)])
            .map(f64::to_bits)
            .collect()
    }

    fn assert_same(found: &Scene, expected: &Scene, what: &str) {
        assert_eq!(found, expected, "{what}");
        assert_eq!(bits(found), bits(expected), "{what}");
    }

    fn pose(position: [f64; 3], angle: f64) -> Pose {
        Pose {
            position: position.into(),
            orientation: Orientation::Radians(angle),
        }
    }

    /// The starts of Figs 6 and 7, as the paper states them.
    fn start_in_the_paper(case: &Case) -> [Pose; 2] {
        let Case { dx, dz, .. } = *case;
        match case.approach {
            Approach::HeadOn => [
                pose([-0.5 * dx, 5.0, 0.5 * dz], -FRAC_PI_2),
                pose([0.5 * dx, -5.0, -0.5 * dz], FRAC_PI_2),
            ],
            Approach::Orthogonal => [
                pose([0.0, 10.0, 0.5 * dz], 0.0),
                pose([10.0 - dx, 0.0, -0.5 * dz], FRAC_PI_2),
            ],
        }
    }

    #[test]
    fn every_family_of_the_paper_parses_and_leaves_the_model_open() {
        for (name, _) in Family::PAPER {
            assert!(Family::named(name).unwrap().hydrodynamics().is_none());
        }
        assert!(Family::named("opposite").is_none());
    }

    #[test]
    fn val_encounters_start_where_the_paper_says_to_the_last_bit() {
        let defaults = Defaults::paper().unwrap();
        for approach in [Approach::HeadOn, Approach::Orthogonal] {
            let lists = defaults.encounters(approach);
            let others = [-0.3, 0.1, 1.0 / 3.0, 7.25];
            let mut count = 0;
            for &beta in lists.beta.iter().chain(&others) {
                for &dx in lists.dx.iter().chain(&others) {
                    for &dz in lists.dz.iter().chain(&defaults.offset.dz).chain(&others) {
                        let case = Case {
                            approach,
                            beta,
                            dx,
                            dz,
                        };
                        let squirmer = Squirmer::with_beta(1.0, beta).unwrap();
                        let start = start_in_the_paper(&case);
                        let repulsion = Some(Repulsion::PAPER);
                        let expected = Scene::new([squirmer; 2], start, repulsion, None).unwrap();
                        assert_same(&case.scene().unwrap(), &expected, &format!("{case:?}"));
                        count += 1;
                    }
                }
            }
            assert!(count > 400, "{count}");
            let run = RunOptions {
                sample_interval: Some(SAMPLE_INTERVAL),
                ..RunOptions::default()
            };
            let family = Family::named(approach.family()).unwrap();
            assert_eq!(family.scene(&[]).unwrap().run, run);
        }
    }

    #[test]
    fn val_pairs_start_at_the_incoming_angles_of_the_paper_to_the_last_bit() {
        let values = Grid::new(100).unwrap().values();
        for (beta, g, dz) in [(1.0, 5.0, 0.0), (-5.0, 50.0, 0.3), (0.0, 0.0, 0.1)] {
            let pair = Pair { beta, g, dz };
            let squirmer = Squirmer::with_beta(1.0, beta).unwrap();
            let squirmer = squirmer.bottom_heavy(g).unwrap();
            for &delta in values.iter().chain(&[1.0]) {
                for &sigma in values.iter().chain(&[1.0]) {
                    let second = FRAC_PI_2 * (sigma + delta);
                    // Mirror images of each other to the last bit where sigma is 1.
                    let first = PI * (sigma - 1.0) - (second - PI);
                    let start = [
                        pose([-1.5, 0.0, 0.5 * dz], first),
                        pose([1.5, 0.0, -0.5 * dz], second),
                    ];
                    let (repulsion, down) = (Some(Repulsion::PAPER), Some(Gravity::DOWN));
                    let expected = Scene::new([squirmer; 2], start, repulsion, down).unwrap();
                    let found = pair.scene(delta, sigma).unwrap();
                    assert_same(&found, &expected, &format!("{pair:?} {delta} {sigma}"));
                    // Gravity that turns nothing has no part in the motion.
                    let plan = Plan::new(&found).unwrap();
                    assert_eq!(plan.gravity().is_some(), g != 0.0);
                }
            }
        }
    }
}
