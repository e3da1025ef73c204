//! The section on the cost of each effect.

use serde::Serialize;

use crate::error::CommandError;
use crate::page::{Section, Table};
use compare::Model;
use compare::effects::{EFFECT_CASES, counted_instructions};

/// A right-hand side and its cost.
#[derive(Serialize)]
struct EffectCost {
    state: String,
    numbers: usize,
    model: String,
    squirming_modes: usize,
    repulsion: &'static str,
    gravity: &'static str,
    swirl: &'static str,
    seconds: f64,
    instructions: f64,
    instructions_without_absent_effects: f64,
}

/// The section, with the given models.
pub(super) fn section(models: &[Model]) -> Result<Section, CommandError> {
    let word = |there: bool| if there { "yes" } else { "" };
    let mut rows = Vec::new();
    for (case, counted) in EFFECT_CASES.iter().zip(counted_instructions()?) {
        let Some(model) = models.iter().find(|m| m.method() == case.method) else {
            continue;
        };
        rows.push(EffectCost {
            state: case.state.name().to_owned(),
            numbers: case.state.numbers(),
            model: counted.model,
            squirming_modes: case.modes,
            repulsion: word(case.repulsion),
            gravity: word(case.gravity),
            swirl: word(case.swirl),
            seconds: case.seconds(model)?,
            instructions: counted.instructions,
            instructions_without_absent_effects: counted.without_absent_effects,
        });
    }
    let caption = "One right-hand side: kind of coordinates and number of variables, effects, time measured with this \
                   page, instructions counted by callgrind, and instructions of the same arithmetic written by hand \
                   without the absent effects.";
    Ok(Section {
        id: "effects".to_owned(),
        title: "What each effect costs".to_owned(),
        prose: vec![
            "The plan of a scene decides what is computed: the smallest set of variables that its symmetry allows, and \
             the effects that the scene names. The compiled equation of motion contains no other effects: no \
             multiplication by zero, no branch, no column of a table, no solve."
                .to_owned(),
        ],
        tables: vec![Table::from_rows(caption, "effects.csv", &rows)?],
        ..Section::default()
    })
}
