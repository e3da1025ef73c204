//! Shares of the incoming angles.

use super::*;

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
