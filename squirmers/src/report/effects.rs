//! The section on what each effect costs.

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

/// The section, with the models that are there.
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
    let caption = "One right-hand side: state and how many numbers it has, effects, time measured with this page, \
                   instructions as counted by callgrind, and those of the same arithmetic written by hand \
                   without what is absent.";
    Ok(Section {
        id: "effects".to_owned(),
        title: "What each effect costs".to_owned(),
        prose: vec![
            "A plan made from the scene settles what runs: the smallest state that its symmetry allows, and the \
             effects that it names. What a scene does not call for is not there when the equation of motion is \
             compiled: no multiplication by zero, no branch, no column of a table, no solve."
                .to_owned(),
        ],
        tables: vec![Table::from_rows(caption, "effects.csv", &rows)?],
        ..Section::default()
    })
}
