//! Every number of docs/FINDINGS.md is computed here again, and the page has to say it; the README repeats lines of it.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::sync::OnceLock;

use compare::bottom_heavy::panel_runs;
use compare::maps::{
    FateRow, Grid, Pair, ScatterRow, bound_rows, fates_of, scatter_row, trust_rows, trust_shares,
};
use compare::sweep::{SweepOptions, encounters, offsets};
use compare::{Approach, Case, Defaults, Encounter, Method, Model, ModelOptions};
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

/// Lines of the table and entries of the list, each without line breaks.
fn statements(text: &str) -> Vec<String> {
    let section = text.split_once("## What was found\n").unwrap().1;
    let section = section.split("\n## ").next().unwrap();
    let rows = section
        .lines()
        .filter(|line| line.starts_with("| "))
        .skip(1);
    let entries = section.split("\n- ").skip(1);
    let entries = entries.map(|entry| entry.split("\n\n").next().unwrap());
    (rows.chain(entries))
        .map(|one| one.split_whitespace().collect::<Vec<_>>().join(" "))
        .collect()
}

#[test]
fn readme_repeats_what_the_findings_say() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../README.md");
    let readme = std::fs::read_to_string(path).unwrap();
    let findings = words_of("docs/FINDINGS.md");
    let statements = statements(&readme);
    // Four rows and four findings.
    assert_eq!(statements.len(), 8, "{statements:#?}");
    for statement in statements {
        assert!(
            findings.contains(&statement),
            "docs/FINDINGS.md lacks: {statement}"
        );
    }
}

#[test]
fn readme_shows_the_example_as_it_is() {
    let read = |file: &str| {
        let path = format!("{}/../{file}", env!("CARGO_MANIFEST_DIR"));
        std::fs::read_to_string(path).unwrap()
    };
    let example = read("compare/examples/one_collision.rs");
    let (_, code) = example.split_once("\n\n").unwrap();
    assert!(read("README.md").contains(&format!("```rust\n{}\n```", code.trim_end())));
}

#[test]
fn readme_table_of_deflections() {
    let mut readme = Claims::default();
    for (approach, beta, dx) in [
        (Approach::HeadOn, 5.0, 1.0),
        (Approach::HeadOn, 5.0, 2.0),
        (Approach::HeadOn, 5.0, 3.0),
        (Approach::Orthogonal, -1.0, 1.0),
        (Approach::Orthogonal, 1.0, 1.0),
        (Approach::Orthogonal, 5.0, 1.0),
    ] {
        let case = case(approach, beta, dx);
        let name = match approach {
            Approach::HeadOn => "opposed",
            Approach::Orthogonal => "right angles",
        };
        let cells = [Method::Lt, Method::LtCorrected, Method::Bem, Method::Exact].map(|method| {
            let encounter = encounter(&case, method);
            let angle = deflections(&case, method)[0];
            match (encounter.scattered(), angle.abs() < 5e-4) {
                (false, _) => "bound".to_owned(),
                (true, true) => "0".to_owned(),
                (true, false) => format!("{angle:.3}"),
            }
        });
        readme.says(&format!(
            "| {name}, β = {beta}, δx = {dx} | {} |",
            cells.join(" | ")
        ));
    }
}

#[test]
fn readme_boundary_elements_against_the_exact_series() {
    let mut readme = Claims::default();
    let worst = (paper_cases().iter())
        .flat_map(|case| {
            let [a, b] = [Method::Bem, Method::Exact].map(|m| deflections(case, m));
            [0, 1].map(|k| (a[k] - b[k]).abs())
        })
        .fold(0.0, f64::max);
    readme.says(&format!(
        "within {worst:.3}° in every encounter of Figs 6 and 7"
    ));
}

#[test]
fn readme_lubrication_theory_is_a_caricature() {
    let mut readme = Claims::default();
    let of = |approach, beta, dx, method| deflections(&case(approach, beta, dx), method);
    let ratio = |dx: f64, method| {
        of(Approach::HeadOn, 5.0, dx, method)[0] / of(Approach::HeadOn, 5.0, dx, Method::Exact)[0]
    };
    let ratios: Vec<f64> = [1.0, 2.0]
        .into_iter()
        .flat_map(|dx| [Method::Lt, Method::LtCorrected].map(|method| ratio(dx, method)))
        .collect();
    let (least, most) = ends(&ratios);
    readme.says(&format!("by {least:.1} to {most:.1} times too much"));
    for dx in [3.0, 5.0, 10.0] {
        assert!(of(Approach::HeadOn, 5.0, dx, Method::Lt)[0].abs() < 1e-9);
    }
    readme.says("not at all from δx = 3 on");
    let off: Vec<f64> = [-1.0, 1.0]
        .into_iter()
        .flat_map(|beta| {
            let [a, b] =
                [Method::Lt, Method::Exact].map(|m| of(Approach::Orthogonal, beta, 1.0, m));
            [0, 1].map(|k| (a[k] - b[k]).abs())
        })
        .collect();
    let (least, most) = ends(&off);
    readme.says(&format!(
        "{least:.0}° to {most:.0}° off at δx = 1 for β = ±1"
    ));
    for (beta, dx) in [(1.0, 2.0), (1.0, 3.0), (-1.0, 3.0)] {
        let [a, b] = [Method::Lt, Method::Exact].map(|m| of(Approach::Orthogonal, beta, dx, m)[0]);
        assert!(a * b < 0.0, "beta {beta}, dx {dx}: {a} and {b}");
    }
    readme.says("the wrong sign for the first squirmer at δx = 2 (β = 1) and 3 (both)");
    for dx in [1.0, 2.0] {
        let case = case(Approach::Orthogonal, 5.0, dx);
        assert!(!encounter(&case, Method::Lt).scattered());
        assert!(encounter(&case, Method::Exact).scattered());
    }
    readme.says("binds strong pullers (β = 5, δx = 1 and 2) that full hydrodynamics parts");
}

fn ends(values: &[f64]) -> (f64, f64) {
    values
        .iter()
        .fold((f64::INFINITY, 0.0), |(least, most), v| {
            (least.min(*v), most.max(*v))
        })
}

/// A map over the incoming angles.
fn map(model: &Model, beta: f64, points: usize) -> Vec<ScatterRow> {
    let pair = Pair {
        beta,
        g: 0.0,
        dz: 0.0,
    };
    map_of(model, pair, points)
}

fn map_of(model: &Model, pair: Pair, points: usize) -> Vec<ScatterRow> {
    let values = Grid::new(points).unwrap().values();
    let starts: Vec<_> = (values.iter())
        .flat_map(|&sigma| values.iter().map(move |&delta| (delta, sigma)))
        .collect();
    (starts.into_par_iter())
        .map(|at| scatter_row(model, pair, at, &RunOptions::default()))
        .collect()
}

/// Points a side of the maps of outcomes.
const MAP: usize = 60;

fn fates(model: &Model, beta: f64) -> FateRow {
    let pair = Pair {
        beta,
        g: 0.0,
        dz: 0.0,
    };
    fates_of(model, pair, &map(model, beta, MAP))
}

#[test]
fn readme_which_pairs_stay_bound() {
    let mut readme = Claims::default();
    let [pullers, pushers] = [5.0, -5.0].map(|beta| fates(lubrication(), beta));
    readme.says(&format!(
        "lubrication theory binds {:.0} % of the pullers with β = 5 (swimming side by side) and {:.0} % of the \
         pushers with β = -5 (orbiting)",
        100.0 * pullers.pairwise,
        100.0 * pushers.orbits()
    ));
    let [pullers, pushers] = [5.0, -5.0].map(|beta| fates(exact(), beta));
    assert!(
        (pullers.bound() - pullers.orbits()).abs() < 0.005,
        "{pullers:?}"
    );
    assert!(pushers.bound() < 0.001, "{pushers:?}");
    readme.says(&format!(
        "Full hydrodynamics binds {:.0} % of the pullers, all of them orbiting, and none of the pushers",
        100.0 * pullers.orbits()
    ));
    let weak = fates(exact(), 1.0);
    let states = bound_rows(&[exact()], &[1.0, -1.0]).unwrap();
    let found = |beta: f64, attracts: bool| {
        (states.iter())
            .find(|s| {
                (s.beta - beta).abs() < 1e-12
                    && s.outcome == "pairwise"
                    && (s.growth < 0.0) == attracts
                    && !s.one_of_a_line
            })
            .unwrap_or_else(|| panic!("{states:?}"))
    };
    let state = found(1.0, true);
    readme.says(&format!("side by side at a gap of {:.3}", state.gap));
    readme.says(&format!("decay at the rate {:.2} V_s/a", -state.growth));
    readme.says(&format!(
        "takes in {:.0} % of the incoming angles",
        100.0 * weak.bound()
    ));
    let image = found(-1.0, false);
    assert!((image.gap - state.gap).abs() < 1e-6, "{image:?}");
    readme.says("Its mirror image in time, at β = -1, repels");
}

#[test]
fn readme_where_lubrication_theory_can_be_trusted() {
    let mut readme = Claims::default();
    let shares = |beta: f64| {
        let pair = Pair {
            beta,
            g: 0.0,
            dz: 0.0,
        };
        let [judged, referee] = [lubrication(), exact()].map(|model| map(model, beta, 30));
        trust_shares(&trust_rows(&judged, &referee, pair)).remove(0)
    };
    let within_15 = |beta: f64| {
        let shares = shares(beta);
        100.0 * (shares.within_5_deg + shares.within_15_deg)
    };
    let neutral = shares(0.0);
    readme.says(&format!(
        "over {:.0} % of the incoming angles for β = 0 both outgoing directions are within 5°, over {:.0} % within 15°",
        100.0 * neutral.within_5_deg,
        within_15(0.0)
    ));
    let (least, most) = ends(&[1.0, -1.0].map(within_15));
    readme.says(&format!(
        "for β = ±1 over {least:.0} to {most:.0} % within 15°"
    ));
    let (least, most) = ends(&[5.0, -5.0].map(within_15));
    let [puller, pusher] = [5.0, -5.0].map(|beta| 100.0 * shares(beta).other_outcome);
    readme.says(&format!(
        "for β = 5 and -5 over {least:.0} to {most:.0} %, and {puller:.0} % and {pusher:.0} % end otherwise altogether"
    ));
}

#[test]
fn readme_an_offset_out_of_the_plane() {
    let mut readme = Claims::default();
    let defaults = Defaults::paper().unwrap().offset;
    let model = set_up(Method::Exact, LoadSet::all(2));
    let (rows, _) = offsets(&[model], &defaults.cases(), &[0.1, 0.5], &sweep_options());
    let most = |approach: &str, strong: bool, dz: f64| {
        (rows.iter())
            .filter(|r| r.case == approach && (r.dz - dz).abs() < 1e-9)
            .filter(|r| (r.beta > 1.0) == strong)
            .map(|r| r.change1_deg.max(r.change2_deg))
            .fold(0.0, f64::max)
    };
    readme.says(&format!(
        "by up to {:.0}° in opposed encounters and {:.0}° at right angles for β = ±1",
        most("head-on", true, 0.5),
        most("orthogonal", false, 0.5)
    ));
    readme.says(&format!(
        "0.1 radii change the outgoing direction by {:.0}°",
        most("orthogonal", true, 0.1)
    ));
}

/// Points a side of the maps under gravity.
const GRAVITY_MAP: usize = 30;

#[test]
fn readme_gravity_binds_other_pairs() {
    let mut readme = Claims::default();
    let [lubrication, exact] = [Method::Lt, Method::Exact].map(|m| set_up(m, LoadSet::all(2)));
    let orbits = |model: &Model, beta: f64, g: f64| {
        let pair = Pair { beta, g, dz: 0.0 };
        fates_of(model, pair, &map_of(model, pair, GRAVITY_MAP)).orbits()
    };
    // Drifting orbits of strong pushers end between 2 and 2.5 by lubrication theory, and do not occur at all.
    assert!(orbits(&lubrication, -5.0, 2.0) > 0.1);
    assert!(orbits(&lubrication, -5.0, 2.5) < 0.001);
    for g in [0.0, 1.0, 2.0] {
        assert!(orbits(&exact, -5.0, g) < 0.001, "G {g}");
    }
    readme.says("up to a bottom-heaviness between 2 and 2.5, do not occur");
    let last = orbits(&exact, 5.0, 2.5);
    assert!(orbits(&exact, 5.0, 3.0) < 0.001);
    readme.says(&format!(
        "strong pullers orbit up to between 2.5 and 3 ({:.0} % of the starts with β = 5 at 2.5)",
        100.0 * last
    ));
    let panels = Defaults::paper().unwrap().bottom_heavy;
    let down: Vec<_> = panels.into_iter().filter(|p| p.panel == "f").collect();
    let runs = panel_runs(&[&lubrication, &exact], &down, &sweep_options());
    let [by_lubrication, by_exact] = [0, 1].map(|k| runs[k].summary().depth_ratio);
    readme.says(&format!(
        "The pair that swims downward, {by_lubrication:.1} times as far as its members alone, turns round after \
         {by_exact:.1} times"
    ));
}

/// One measured cost, a line of `fixtures/measured-costs.csv`.
#[derive(serde::Deserialize)]
struct Cost {
    finding: String,
    of: String,
    value: f64,
}

/// To one digit, with commas between thousands.
fn about(value: f64) -> String {
    let unit = 10_f64.powf(value.log10().floor());
    let digits = format!("{:.0}", (value / unit).round() * unit);
    let from_right = digits.char_indices().map(|(i, c)| (digits.len() - i, c));
    from_right
        .flat_map(|(left, c)| {
            (left % 3 == 0 && left < digits.len())
                .then_some(',')
                .into_iter()
                .chain([c])
        })
        .collect()
}

/// Times are those of one quiet machine, kept with what measured them; README says what they come to.
#[test]
fn readme_times_are_those_that_were_measured() {
    let mut readme = Claims::default();
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../fixtures/measured-costs.csv"
    );
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_path(path)
        .unwrap();
    let costs: Vec<Cost> = reader.deserialize().map(Result::unwrap).collect();
    let measured = |finding: &str, of: &str| {
        (costs
            .iter()
            .find(|cost| cost.finding == finding && cost.of == of))
        .unwrap_or_else(|| panic!("no '{finding}' of {of}"))
        .value
    };
    let collision = "slowest collision of Fig. 6, tol 1e-8";
    let ratio = measured("right-hand side over lubrication's", "exact-table");
    readme.says(&format!(
        "a collision takes up to {:.2} ms by exact loads, {:.3} ms by lubrication theory ({ratio:.1} and 1 for a \
         right-hand side)",
        1e-3 * measured(collision, "exact-table"),
        1e-3 * measured(collision, "lt")
    ));
    let direct = "solved trajectory over tabulated, least";
    readme.says(&format!(
        "boundary elements (level 1) solved at every step take {} times as long as the exact table",
        about(measured(direct, "bem-1"))
    ));
    readme.says(&format!(
        "SciPy's solver of the same method {} times as long for lubrication theory",
        about(measured("SciPy's solver over ours", "lt, dx 1"))
    ));
    readme.says(&format!(
        "The tables take {} s on two cores",
        about(measured("building the table", "bem-3-table"))
    ));
}
