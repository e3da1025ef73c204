//! The encounters of the paper as families.

use super::Family;

impl Family {
    /// The names and the texts of the paper's families, which are part of the program.
    pub const PAPER: [(&str, &str); 3] = fixtures::FAMILIES;
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]
    use scene::{Plan, RunOptions, Scene};

    use super::super::SAMPLE_INTERVAL;
    use super::*;
    use crate::maps::{Grid, Pair};
    use crate::{Approach, Case, Defaults};

    fn family(name: &str) -> Family {
        let (_, text) = Family::PAPER
            .iter()
            .find(|(known, _)| *known == name)
            .unwrap();
        Family::parse(text).unwrap()
    }

    /// The numbers of a scene, so that zeros of either sign differ too.
    fn bits(scene: &Scene) -> Vec<u64> {
        let angle = |k: usize| match scene.start[k].orientation {
            scene::Orientation::Radians(angle) => angle,
            scene::Orientation::Vector(_) => f64::NAN,
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

    #[test]
    fn encounters_of_the_families_are_the_papers_to_the_last_bit() {
        let defaults = Defaults::paper().unwrap();
        for (name, approach) in [
            ("opposed", Approach::HeadOn),
            ("right-angles", Approach::Orthogonal),
        ] {
            let family = family(name);
            assert!(family.hydrodynamics().is_none());
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
                        let point = family
                            .scene(&[("dz", dz), ("beta", beta), ("dx", dx)])
                            .unwrap();
                        let what = format!("{name} {beta} {dx} {dz}");
                        assert_same(&point.scene, &case.scene().unwrap(), &what);
                        let run = RunOptions {
                            sample_interval: Some(SAMPLE_INTERVAL),
                            ..RunOptions::default()
                        };
                        assert_eq!(point.run, run);
                        count += 1;
                    }
                }
            }
            assert!(count > 400, "{count}");
        }
    }

    #[test]
    fn incoming_angles_of_the_family_are_those_of_the_maps_to_the_last_bit() {
        let family = family("incoming-angles");
        let values = Grid::new(100).unwrap().values();
        for (beta, g, dz) in [(1.0, 5.0, 0.0), (-5.0, 50.0, 0.3), (0.0, 0.0, 0.1)] {
            let pair = Pair { beta, g, dz };
            for &delta in values.iter().chain(&[1.0]) {
                for &sigma in values.iter().chain(&[1.0]) {
                    let values = [
                        ("beta", beta),
                        ("g", g),
                        ("dz", dz),
                        ("delta", delta),
                        ("sigma", sigma),
                    ];
                    let found = family.scene(&values).unwrap().scene;
                    let expected = pair.scene(delta, sigma).unwrap();
                    let plan = Plan::new(&found).unwrap();
                    assert_eq!(plan.gravity().is_some(), g != 0.0);
                    // Gravity that turns nothing may be there.
                    let found = Scene {
                        gravity: plan.gravity(),
                        ..found
                    };
                    assert_same(&found, &expected, &format!("{pair:?} {delta} {sigma}"));
                }
            }
        }
    }

    #[test]
    fn panels_of_bottom_heavy_squirmers_are_points_of_the_family_of_incoming_angles() {
        let family = family("incoming-angles");
        let panels = Defaults::paper().unwrap().bottom_heavy;
        assert_eq!(panels.len(), 6);
        for panel in panels {
            let values = [
                ("beta", panel.beta),
                ("g", panel.g),
                ("delta", panel.delta),
                ("sigma", panel.sigma),
            ];
            let found = family.scene(&values).unwrap().scene;
            assert_same(&found, &panel.scene().unwrap(), &panel.panel);
        }
    }
}
