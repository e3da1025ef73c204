//! What each effect costs: the time of a right-hand side for every set of effects that a scene of the paper, or a
//! scene with swirl, can need.

use std::f64::consts::PI;

use scene::{Gravity, Orientation, Plan, Pose, Repulsion, Scene, SceneError, Squirmer, State};
use serde::{Deserialize, Serialize};

use crate::{CompareError, Method, Model};

/// A right-hand side: its variables, effects, highest squirming mode and model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EffectCase {
    /// Variables of the motion.
    pub state: State,
    /// Whether there is repulsion.
    pub repulsion: bool,
    /// Whether there is gravity that turns the squirmers.
    pub gravity: bool,
    /// Whether there is swirl (two modes).
    pub swirl: bool,
    /// Highest squirming mode.
    pub modes: usize,
    /// Hydrodynamic model.
    pub method: Method,
}

const fn case(state: State, effects: (bool, bool, bool)) -> EffectCase {
    let (repulsion, gravity, swirl) = effects;
    EffectCase {
        state,
        repulsion,
        gravity,
        swirl,
        modes: 2,
        method: Method::Lt,
    }
}

/// Every set of effects that a scene of the paper, or a scene with swirl, can need.
pub const EFFECT_CASES: [EffectCase; 22] = [
    case(State::Axisymmetric, (false, false, false)),
    case(State::Axisymmetric, (true, false, false)),
    case(State::PointSymmetric, (false, false, false)),
    case(State::PointSymmetric, (true, false, false)),
    case(State::MirrorSymmetric, (false, false, false)),
    case(State::MirrorSymmetric, (true, false, false)),
    case(State::MirrorSymmetric, (true, true, false)),
    case(State::Planar, (false, false, false)),
    case(State::Planar, (true, false, false)),
    case(State::Planar, (false, true, false)),
    case(State::Planar, (true, true, false)),
    case(State::Spatial, (false, false, false)),
    case(State::Spatial, (true, false, false)),
    case(State::Spatial, (false, true, false)),
    case(State::Spatial, (true, true, false)),
    case(State::Spatial, (true, false, true)),
    EffectCase {
        modes: 1,
        ..case(State::Planar, (true, false, false))
    },
    EffectCase {
        modes: 8,
        ..case(State::Planar, (true, false, false))
    },
    EffectCase {
        method: Method::Exact,
        ..case(State::PointSymmetric, (true, false, false))
    },
    EffectCase {
        method: Method::Exact,
        ..case(State::Planar, (true, false, false))
    },
    EffectCase {
        method: Method::Exact,
        ..case(State::Planar, (true, true, false))
    },
    EffectCase {
        method: Method::Exact,
        ..case(State::Spatial, (true, false, false))
    },
];

impl EffectCase {
    /// A scene close to contact that needs exactly this right-hand side.
    ///
    /// # Errors
    /// [`SceneError`] if the scene is not valid; the numbers used here are valid.
    pub fn scene(&self) -> Result<Scene, SceneError> {
        let angles = match self.state {
            State::Axisymmetric => [0.0, PI],
            State::PointSymmetric => [0.7, 0.7 + PI],
            State::MirrorSymmetric => [0.7, PI - 0.7],
            State::Planar | State::Spatial => [0.7, 1.9],
        };
        let modes: Vec<f64> = (0..self.modes).map(|n| 1.5 / (1.0 + n as f64)).collect();
        let mut squirmer = Squirmer::new(&modes)?;
        if self.gravity {
            squirmer = squirmer.bottom_heavy(10.0)?;
        }
        if self.swirl {
            squirmer = squirmer.with_swirl(&[0.3, 0.2])?;
        }
        let lift = if self.state == State::Spatial {
            0.1
        } else {
            0.0
        };
        let pose = |side: f64, angle: f64| Pose {
            position: [1.05 * side, 0.0, lift * side].into(),
            orientation: Orientation::Radians(angle),
        };
        let start = [pose(-1.0, angles[0]), pose(1.0, angles[1])];
        let repulsion = self.repulsion.then_some(Repulsion::PAPER);
        let gravity = self.gravity.then_some(Gravity::DOWN);
        Scene::new([squirmer; 2], start, repulsion, gravity)
    }

    /// Seconds of one right-hand side of the scene's plan: the smallest of a few repeats.
    ///
    /// # Errors
    /// [`SceneError`] if the model cannot give the loads.
    pub fn seconds(&self, model: &Model) -> Result<f64, SceneError> {
        let plan = Plan::new(&self.scene()?)?;
        model.seconds_of_rates(&plan, plan.start())
    }
}

/// One line of `fixtures/instructions.csv`: the instructions of a right-hand side, as counted by
/// `cargo bench -p squirmers-compare --bench instructions`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct InstructionRow {
    /// Variables of the motion.
    pub state: String,
    /// Hydrodynamic model.
    pub model: String,
    /// Highest squirming mode.
    pub squirming_modes: usize,
    /// Whether there is repulsion.
    pub repulsion: bool,
    /// Whether there is gravity.
    pub gravity: bool,
    /// Whether there is swirl.
    pub swirl: bool,
    /// Instructions of a right-hand side.
    pub instructions: f64,
    /// Instructions of the same arithmetic, written by hand without the absent effects; NaN if not counted.
    pub without_absent_effects: f64,
}

/// The latest counts.
///
/// # Errors
/// [`CompareError::Rows`] if the embedded file is not a table of counts.
pub fn counted_instructions() -> Result<Vec<InstructionRow>, CompareError> {
    read_instructions(fixtures::INSTRUCTIONS)
}

/// The counts in a table that `cargo bench -p squirmers-compare --bench instructions` prints.
///
/// # Errors
/// [`CompareError::Rows`] if the text is not a table of counts.
pub fn read_instructions(table: &str) -> Result<Vec<InstructionRow>, CompareError> {
    let mut reader = (csv::ReaderBuilder::new().comment(Some(b'#'))).from_reader(table.as_bytes());
    let rows = reader.deserialize().collect::<Result<_, _>>()?;
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_case_has_the_state_it_claims_and_its_count() {
        let rows = counted_instructions().unwrap();
        assert_eq!(rows.len(), EFFECT_CASES.len());
        for (case, row) in EFFECT_CASES.iter().zip(&rows) {
            let plan = Plan::new(&case.scene().unwrap()).unwrap();
            assert_eq!(plan.state(), case.state);
            assert_eq!(plan.repulsion().is_some(), case.repulsion);
            assert_eq!(plan.gravity().is_some(), case.gravity);
            assert_eq!(plan.swirl() > 0, case.swirl);
            assert_eq!(row.state, case.state.name());
            assert_eq!(row.model, case.method.name());
            let effects = (row.repulsion, row.gravity, row.swirl);
            assert_eq!(effects, (case.repulsion, case.gravity, case.swirl));
        }
    }
}
