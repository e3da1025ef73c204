//! Scene files and families mutated at random: read, and run for a while; `SQUIRMERS_FUZZ` sets their number.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::path::PathBuf;
use std::sync::OnceLock;

use compare::{Family, Method, Mistakes, Model, ModelOptions, SceneFile};
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use scene::{Plan, RunOptions};

/// The texts of the scene files.
fn corpus() -> &'static [String] {
    static CORPUS: OnceLock<Vec<String>> = OnceLock::new();
    CORPUS.get_or_init(|| {
        let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../fixtures/scenes");
        let mut paths: Vec<_> = std::fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().path())
            .collect();
        paths.sort();
        let mut texts: Vec<_> = (paths.iter())
            .map(|path| std::fs::read_to_string(path).unwrap())
            .collect();
        // All keys, which the paper's cases do not need.
        let page = include_str!("../../docs/SCENES.md");
        texts.extend(
            page.split("```toml\n")
                .skip(1)
                .map(|rest| rest.split("```").next().unwrap().to_owned()),
        );
        texts.extend(Family::PAPER.map(|(_, text)| text.to_owned()));
        texts
    })
}

/// Pieces that mutations put in.
const PIECES: [&str; 46] = [
    "0",
    "-1",
    "1e308",
    "-1e-308",
    "5e-324",
    "nan",
    "-inf",
    "1e400",
    "0x10",
    "\"",
    "'",
    "[",
    "]",
    "{",
    "}",
    "=",
    "#",
    "\n",
    ".",
    ",",
    "true",
    "\u{fffd}é",
    "[[squirmer]]\n",
    "[run]\n",
    "beta = ",
    "modes = [1, 2, 3]\n",
    "hydrodynamics = \"none\"\n",
    "hydrodynamics = \"exact\"\n",
    "repulsion = \"off\"\n",
    "[gravity]\n",
    "direction = [0, 0, -1]\n",
    "max_steps = 99999999\n",
    "sample_interval = 1e-9\n",
    "swimming_speed = 1e9\n",
    "[parameters]\n",
    "dx = \"1\"\n",
    "\"beta\"",
    "(",
    ")",
    "-",
    "^",
    "*",
    "sin(",
    "radians",
    "\\",
    "δ",
];

/// One change of a text: where, how much to take out, what to put in.
type Mutation = (
    prop::sample::Index,
    usize,
    Option<prop::sample::Index>,
    Option<f64>,
);

fn mutation() -> impl Strategy<Value = Mutation> {
    let piece = prop::option::of(any::<prop::sample::Index>());
    let value = prop::option::weighted(0.3, prop::num::f64::ANY);
    (any::<prop::sample::Index>(), 0usize..12, piece, value)
}

fn mutated(text: &str, mutations: &[Mutation]) -> String {
    let mut text: Vec<char> = text.chars().collect();
    for (at, remove, piece, value) in mutations {
        let at = at.index(text.len() + 1);
        let end = (at + remove).min(text.len());
        let mut new = piece
            .map_or("", |piece| PIECES[piece.index(PIECES.len())])
            .to_owned();
        if let Some(value) = value {
            new += &format!("{value:?}");
        }
        text.splice(at..end, new.chars());
    }
    text.into_iter().collect()
}

/// Holds mistakes to what is said of them: there are some, each on one line and in its place.
fn check(mistakes: &Mistakes) -> Result<(), TestCaseError> {
    prop_assert!(!mistakes.0.is_empty());
    for mistake in &mistakes.0 {
        prop_assert!(mistake.line >= 1 && mistake.column >= 1);
        prop_assert_eq!(mistake.to_string().lines().count(), 1, "{}", mistake);
    }
    Ok(())
}

/// Makes the scenes of a text for all kinds of values, if it is a family.
fn read_family(text: &str, value: f64) -> Result<(), TestCaseError> {
    let family = match Family::parse(text) {
        Ok(family) => family,
        Err(mistakes) => return check(&mistakes),
    };
    let defaults = family.scene(&[]);
    prop_assert!(defaults.is_ok(), "{:?}", defaults);
    for (name, _) in family.parameters() {
        match family.scene(&[(name, value)]) {
            Ok(point) => prop_assert!(point.scene.gap().is_ok()),
            Err(mistakes) => check(&mistakes)?,
        }
    }
    Ok(())
}

/// Reads a text and, if it is a scene, runs it for a while by a model that needs no table.
fn read_and_run(text: &str, models: &[Model]) -> Result<(), TestCaseError> {
    let file = match SceneFile::parse(text) {
        Ok(file) => file,
        Err(mistakes) => return check(&mistakes),
    };
    let model = (models.iter()).find(|model| model.method() == file.method);
    let model = model.unwrap_or(&models[0]);
    let options = RunOptions {
        max_steps: file.run.max_steps.min(300),
        sample_interval: None,
        ..file.run
    };
    let plan = Plan::new(&file.scene).unwrap();
    // It may fail, with a reason; steps are bounded.
    match model.run(&file.scene, &options) {
        Ok(run) => {
            prop_assert!(run.counters.steps <= 300);
            prop_assert!(run.end_time <= options.end_time);
        }
        Err(error) => prop_assert!(!error.to_string().is_empty()),
    }
    prop_assert!(!model.explain(&plan).is_empty());
    Ok(())
}

#[test]
fn mutated_scene_files_neither_panic_nor_run_on() {
    let cases = std::env::var("SQUIRMERS_FUZZ").map_or(3000, |cases| cases.parse().unwrap());
    let models = [Method::Lt, Method::LtCorrected, Method::Isolated]
        .map(|method| Model::set_up(method, &ModelOptions::default()).unwrap());
    let mut runner = TestRunner::new(Config {
        cases,
        failure_persistence: None,
        ..Config::default()
    });
    let files = prop::sample::select(corpus());
    let mutations = prop::collection::vec(mutation(), 0..6);
    runner
        .run(
            &(files, mutations, prop::num::f64::ANY),
            |(text, mutations, value)| {
                let text = mutated(&text, &mutations);
                read_family(&text, value)?;
                read_and_run(&text, &models)
            },
        )
        .unwrap();
}
