//! Every number of docs/FINDINGS.md is computed here again, and the page has to say it; the README repeats lines of it.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

mod costs;
mod deflections;
mod incoming_angles;
mod page;
mod public_codes;
mod unlike_radii;

use std::sync::OnceLock;

use compare::study::maps::{
    FateRow, Grid, Pair, ScatterRow, bound_rows, fates_of, scatter_row, trust_rows, trust_shares,
};
use compare::study::panels::panel_runs;
use compare::sweep::SweepOptions;
use compare::{Approach, Case, Defaults, Encounter, Method, Model, ModelOptions};
use compare::{encounters, offsets};
use rayon::prelude::*;
use scene::{LoadSet, RunOptions};

/// The text of a file of the project, without line breaks.
fn words_of(file: &str) -> String {
    let path = format!("{}/../{file}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).unwrap();
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// What the findings have to say.
#[derive(Default)]
struct Claims(Vec<String>);

impl Claims {
    /// The findings have to say this.
    fn says(&mut self, what: &str) {
        self.0.push(what.to_owned());
    }
}

impl Drop for Claims {
    /// Line breaks of the README do not matter.
    fn drop(&mut self) {
        if std::thread::panicking() {
            return;
        }
        let text = words_of("docs/FINDINGS.md");
        let missing: Vec<_> = self.0.iter().filter(|c| !text.contains(*c)).collect();
        assert!(
            missing.is_empty(),
            "docs/FINDINGS.md does not say: {missing:#?}"
        );
    }
}

fn set_up(method: Method, tabulated: LoadSet) -> Model {
    let options = ModelOptions {
        cache: None,
        tabulated,
        ..ModelOptions::default()
    };
    Model::set_up(method, &options).unwrap()
}

fn lubrication() -> &'static Model {
    static MODEL: OnceLock<Model> = OnceLock::new();
    MODEL.get_or_init(|| set_up(Method::Lt, LoadSet::planar(2)))
}

fn exact() -> &'static Model {
    static MODEL: OnceLock<Model> = OnceLock::new();
    MODEL.get_or_init(|| set_up(Method::Exact, LoadSet::planar(2)))
}

fn sweep_options() -> SweepOptions {
    SweepOptions {
        run: RunOptions::default(),
        time_limit: None,
    }
}

fn paper_cases() -> Vec<Case> {
    let defaults = Defaults::paper().unwrap();
    let of = |approach| {
        let lists = defaults.encounters(approach);
        let one = |beta: f64, dx: f64| Case {
            approach,
            beta,
            dx,
            dz: 0.0,
        };
        (lists.beta.iter())
            .flat_map(|&beta| lists.dx.iter().map(move |&dx| one(beta, dx)))
            .collect::<Vec<_>>()
    };
    [of(Approach::HeadOn), of(Approach::Orthogonal)].concat()
}

fn all_encounters() -> &'static [Encounter] {
    static ALL: OnceLock<Vec<Encounter>> = OnceLock::new();
    ALL.get_or_init(|| {
        let planar = LoadSet::planar(2);
        let models = [Method::Lt, Method::LtCorrected, Method::Bem, Method::Exact]
            .map(|method| set_up(method, planar));
        encounters(&models, &paper_cases(), &sweep_options())
    })
}

fn encounter(case: &Case, method: Method) -> &'static Encounter {
    (all_encounters().iter())
        .find(|e| e.case == *case && e.method == method)
        .unwrap()
}

/// Deflections in degrees.
fn deflections(case: &Case, method: Method) -> [f64; 2] {
    let run = encounter(case, method).run.as_ref().unwrap();
    run.deflections_rad().map(f64::to_degrees)
}

fn case(approach: Approach, beta: f64, dx: f64) -> Case {
    Case {
        approach,
        beta,
        dx,
        dz: 0.0,
    }
}

fn ends(values: &[f64]) -> (f64, f64) {
    values
        .iter()
        .fold((f64::INFINITY, 0.0), |(least, most), v| {
            (least.min(*v), most.max(*v))
        })
}
