//! A plan in words: each effect with the reason why it runs or not, and the loads that are asked for.

use std::fmt;

use super::{Plan, State};
use crate::{ActiveLoads, Hydrodynamics, LoadSet, Parities};

/// The loads that the equation of motion of a plan uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NeededLoads {
    /// Along the line of centres: `X11A, X12A`, `XF1_n, XF2_n`.
    pub axial: Parities,
    /// Across it: `Y11A, ..., Y12C` but for `X11C, X12C`, `YF1_n, ..., YT2_n`. The sum is that of the
    /// forces; with it goes the difference of the spins.
    pub transverse: Parities,
    /// About it: `X11C, X12C`.
    pub twist: Parities,
    /// Highest squirming mode.
    pub modes: usize,
    /// Highest swirl mode: all three loads of each.
    pub swirl: usize,
    /// Whether the radii are unlike, so that each squirmer has loads of its own.
    pub of_each: bool,
}

/// A symmetry class of the boundary-element system: what the pair's mirrors split it into.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SymmetryClass {
    /// `axial`, `transverse` or `twist`.
    pub motion: &'static str,
    /// Whether the second sphere does the mirror image of what the first does, or its opposite; none where radii are unlike, so that no
    /// mirror makes one of the other.
    pub mirrored: Option<bool>,
}

impl fmt::Display for SymmetryClass {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let swap = match self.mirrored {
            Some(true) => " mirrored",
            Some(false) => " opposite",
            None => "",
        };
        write!(f, "{}{swap}", self.motion)
    }
}

impl NeededLoads {
    /// Names of the loads: both of a kind, or the one combination of them that is needed.
    #[must_use]
    pub fn names(&self) -> Vec<String> {
        // Opposed spins go with like translations: loads of torques have the other parity.
        let crossed = self.transverse.crossed();
        if self.of_each {
            return self.names_of_each();
        }
        let marked = |own: String, other: String, of: Parities| match (of.sum, of.difference) {
            (true, true) => Some(format!("{own}, {other}")),
            (true, false) => Some(format!("{own} + {other}")),
            (false, true) => Some(format!("{own} - {other}")),
            (false, false) => None,
        };
        let scalars = [
            ('X', 'A', self.axial),
            ('Y', 'A', self.transverse),
            ('Y', 'B', self.transverse),
            ('Y', 'C', crossed),
            ('X', 'C', self.twist),
        ];
        let mut names: Vec<_> = (scalars.into_iter())
            .filter_map(|(axis, kind, of)| {
                marked(format!("{axis}11{kind}"), format!("{axis}12{kind}"), of)
            })
            .collect();
        for n in 1..=self.modes {
            let by_mode = [("XF", self.axial), ("YF", self.transverse), ("YT", crossed)];
            names.extend((by_mode.into_iter()).filter_map(|(name, of)| {
                marked(format!("{name}1_{n}"), format!("{name}2_{n}"), of)
            }));
        }
        for n in 1..=self.swirl {
            let loads = ["XTC", "YFC", "YTC"];
            names.extend(loads.map(|name| format!("{name}1_{n}, {name}2_{n}")));
        }
        names
    }

    /// The same where each squirmer has loads of its own, with the number of the loaded sphere and that of the active one.
    fn names_of_each(&self) -> Vec<String> {
        let set = LoadSet {
            modes: self.modes,
            axial: self.axial,
            transverse: self.transverse,
            twist: self.twist.any(),
            swirl: self.swirl,
        };
        let of = |active: usize| ActiveLoads::isolated(set).named(active);
        (of(1).into_iter().chain(of(2)))
            .map(|(name, _)| name)
            .collect()
    }

    /// The symmetry classes of the boundary-element system in which these loads lie.
    #[must_use]
    pub fn symmetry_classes(&self) -> Vec<SymmetryClass> {
        // The mirror image of a motion along the line of centres, or of a spin across it, is opposed.
        let of = [
            ("axial", self.axial.difference, self.axial.sum),
            (
                "transverse",
                self.transverse.sum,
                self.transverse.difference,
            ),
            ("twist", self.twist.sum, self.twist.difference),
        ];
        let mut classes = Vec::new();
        for (motion, mirrored, opposite) in of {
            for (needed, mirrored) in [(mirrored, true), (opposite, false)] {
                if needed {
                    let mirrored = (!self.of_each).then_some(mirrored);
                    classes.push(SymmetryClass { motion, mirrored });
                }
            }
        }
        classes.dedup();
        classes
    }
}

/// One line of a plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlanRow {
    /// The effect.
    pub effect: &'static str,
    /// Whether it is computed.
    pub runs: bool,
    /// Why, or why not.
    pub reason: String,
}

impl Plan {
    /// The loads that the equation of motion uses.
    #[must_use]
    pub fn needed_loads(&self) -> NeededLoads {
        let set = self.load_set();
        NeededLoads {
            axial: set.axial,
            transverse: set.transverse,
            twist: if set.twist {
                Parities::BOTH
            } else {
                Parities::NONE
            },
            modes: set.modes,
            swirl: set.swirl,
            of_each: self.has_unlike_radii(),
        }
    }

    /// Every effect in words, for the hydrodynamics of `model`.
    #[must_use]
    pub fn rows<H: Hydrodynamics + ?Sized>(&self, model: &H) -> Vec<PlanRow> {
        let mut rows = vec![hydrodynamics_row(model)];
        rows.extend(self.mode_rows());
        rows.push(self.swirl_row());
        rows.push(self.repulsion_row());
        rows.push(self.gravity_row());
        rows.extend(self.state_rows());
        rows
    }

    fn mode_rows(&self) -> Vec<PlanRow> {
        let [one, two] = &self.scene.squirmers;
        if self.scene.modes() == 0 {
            return vec![PlanRow {
                effect: "squirming",
                runs: false,
                reason: "neither sphere squirms".to_owned(),
            }];
        }
        let of = |k: usize| {
            let modes = [one, two][k].modes();
            let listed: Vec<_> = (1..)
                .zip(modes)
                .map(|(n, &b)| format!("B{n} = {}", typed(b)))
                .collect();
            PlanRow {
                effect: ["squirming of 1", "squirming of 2"][k],
                runs: !modes.is_empty(),
                reason: if modes.is_empty() {
                    "a passive sphere".to_owned()
                } else {
                    listed.join(", ")
                },
            }
        };
        vec![of(0), of(1)]
    }

    fn swirl_row(&self) -> PlanRow {
        let none = (self.scene.squirmers.iter()).all(|s| s.swirl().is_empty());
        let reason = match (self.swirl, self.state) {
            (1.., _) => "pushes and turns squirmers out of their plane",
            (0, _) if none => "the squirmers have none",
            (0, State::Axisymmetric) => "only turns squirmers about their own axes",
            (0, _) => "C1 alone turns a squirmer about its own axis",
        };
        PlanRow {
            effect: "swirl",
            runs: self.swirl > 0,
            reason: reason.to_owned(),
        }
    }

    fn repulsion_row(&self) -> PlanRow {
        PlanRow {
            effect: "repulsion",
            runs: self.repulsion.is_some(),
            reason: match self.repulsion {
                Some(_) => "the scene has it",
                None => "the scene has none",
            }
            .to_owned(),
        }
    }

    fn gravity_row(&self) -> PlanRow {
        let reason = match (self.gravity, self.scene.gravity) {
            (Some(_), _) => "a bottom-heavy squirmer swims",
            (None, Some(_)) => "no squirmer that swims is bottom-heavy",
            (None, None) => "the scene has none",
        };
        PlanRow {
            effect: "gravity",
            runs: self.gravity.is_some(),
            reason: reason.to_owned(),
        }
    }

    fn state_rows(&self) -> [PlanRow; 2] {
        let third = match (self.state, self.plane()) {
            (State::Spatial, _) => (
                true,
                "start and gravity are in no one plane, or there is swirl".to_owned(),
            ),
            (State::Axisymmetric, _) => (false, "nothing leaves the line of centres".to_owned()),
            (_, None) => (
                false,
                "start and gravity are in a plane of constant z".to_owned(),
            ),
            (_, Some(plane)) => {
                let [x, y, z] = plane.normal().map(|n| (1e3 * n).round() / 1e3 + 0.0).into();
                let reason = format!(
                    "start and gravity are in the plane with the normal ({x:.3}, {y:.3}, {z:.3}), in whose frame \
                     the motion is run"
                );
                (false, reason)
            }
        };
        let symmetry = match self.state {
            State::Planar | State::Spatial if self.has_unlike_radii() => (
                false,
                "radii are unlike: each squirmer has loads of its own",
            ),
            State::Axisymmetric => (true, "both orientations are along the line of centres"),
            State::PointSymmetric => (true, "identical squirmers with opposed orientations"),
            State::MirrorSymmetric => (true, "identical squirmers, images in a mirror between"),
            State::Planar | State::Spatial => (false, "the start has none, or gravity breaks it"),
        };
        let symmetry = (symmetry.0, symmetry.1.to_owned());
        [("third dimension", third), ("symmetry", symmetry)].map(|(effect, (runs, reason))| {
            PlanRow {
                effect,
                runs,
                reason,
            }
        })
    }
}

/// A number without the digits that rounding has left: 1.5 times 0.1 is 0.15 to people.
fn typed(number: f64) -> String {
    let scientific = format!("{number:.11e}");
    let number = scientific.parse::<f64>().unwrap_or(number);
    if number == 0.0 || (1e-4..1e6).contains(&number.abs()) {
        format!("{number}")
    } else {
        format!("{number:e}")
    }
}

fn hydrodynamics_row<H: Hydrodynamics + ?Sized>(model: &H) -> PlanRow {
    let (runs, reason) = match model.cutoff() {
        Some(cut) if cut > 0.0 => (
            true,
            format!("acts at gaps up to {cut}; free flight beyond"),
        ),
        Some(_) => (false, "the spheres do not feel each other".to_owned()),
        None => (true, "acts at every gap".to_owned()),
    };
    PlanRow {
        effect: "hydrodynamics",
        runs,
        reason,
    }
}
