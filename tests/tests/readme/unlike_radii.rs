//! Squirmers of unlike radii, and a passive sphere that one of them passes.

use super::*;
use compare::output::OutputFolder;
use compare::study::cargo::{Cargo, CargoRow, cargo_rows};
use compare::study::contact_slopes;
use compare::study::ratios::{RatioRow, Ratios, UnlikePair};

fn models(options: &ModelOptions) -> [Model; 2] {
    [Method::Lt, Method::Exact].map(|method| Model::set_up(method, options).unwrap())
}

fn without_cache() -> ModelOptions {
    ModelOptions {
        cache: None,
        ..ModelOptions::default()
    }
}

/// The rows of some ratios of radii, for each of two squirmers with this beta.
fn rows(beta: f64, ratios: &[f64]) -> Vec<RatioRow> {
    let pairs: Vec<_> = (ratios.iter())
        .map(|&ratio| UnlikePair {
            beta: [beta; 2],
            ratio,
        })
        .collect();
    let options = Ratios::options_of(&pairs, without_cache()).unwrap();
    let [lubrication, exact] = models(&options);
    let folder = tempfile::tempdir().unwrap();
    let out = OutputFolder::open(folder.path()).unwrap();
    let ratios = Ratios {
        judged: vec![&lubrication],
        exact: &exact,
        pairs: &pairs,
        grid: Grid::new(40).unwrap(),
        options: sweep_options(),
        out: &out,
    };
    ratios.rows().unwrap().unwrap()
}

#[test]
fn readme_unlike_radii_change_who_stays_bound() {
    let mut readme = Claims::default();
    let rows_of_pullers = rows(5.0, &[2.0, 1.0, 5.0]);
    let percent = |share: f64| format!("{:.0}", 100.0 * share);
    let bound = |row: &RatioRow, exact: bool| {
        let [_, standoff, pairwise, orbiting, _] = row.outcomes(exact);
        assert!(standoff.abs() < 1e-3, "{row:?}");
        // By lubrication theory side by side, by exact hydrodynamics in orbits.
        let other = if exact { pairwise } else { orbiting };
        assert!(other.abs() < 1e-3, "{row:?}");
        percent(pairwise + orbiting)
    };
    let [twice, equal, fivefold] = &rows_of_pullers[..] else {
        panic!("{rows_of_pullers:?}")
    };
    readme.says(&format!(
        "By exact hydrodynamics {} % of the pullers with β = 5 orbit if one is twice as large as the other, {} % if they are \
         equal, and {} % if one is five times as large; lubrication theory binds {}, {} and {} %, swimming side by side",
        bound(twice, true),
        bound(equal, true),
        bound(fivefold, true),
        bound(twice, false),
        bound(equal, false),
        bound(fivefold, false),
    ));
    let pushers = &rows(-5.0, &[2.0])[0];
    assert!(pushers.scattered_exact > 1.0 - 1e-9, "{pushers:?}");
    readme.says(&format!(
        "of pushers (β = -5) with a ratio of 2 it binds {} %",
        percent(1.0 - pushers.scattered)
    ));
    let slopes = contact_slopes(&[0.5, 2.0], 2).unwrap();
    let axial = |row: &compare::SlopeRow| row.name.starts_with("XF");
    let worst = (slopes.iter()).map(|row| (row.corrected / row.exact - 1.0).abs());
    assert!(worst.fold(0.0, f64::max) < 1e-3);
    assert!(
        slopes
            .iter()
            .filter(|row| !axial(row))
            .all(|row| (row.published - row.corrected).abs() < 1e-12)
    );
    let off = (slopes.iter().filter(|row| axial(row))).map(|row| 1.0 - row.published / row.exact);
    readme.says(&format!(
        "the paper's factors of ln(1/ε) hold for unlike radii, but for that of the axial squirming force: it is 12λ²/(1 + λ)², \
         and the printed one {:.0} % too small",
        100.0 * off.fold(0.0, f64::max)
    ));
}

#[test]
fn readme_a_swimmer_moves_a_passive_sphere() {
    let mut readme = Claims::default();
    let cargoes = [0.0, 5.0].map(|beta| Cargo {
        beta,
        ratio: 1.0,
        b: 0.5,
        far: 60.0,
    });
    let options = without_cache()
        .for_scenes(cargoes.iter().map(Cargo::scene))
        .unwrap();
    let moved = cargo_rows(&models(&options), &cargoes, &RunOptions::default());
    let along: Vec<f64> = moved.iter().map(|row: &CargoRow| row.along).collect();
    let [neutral_lt, puller_lt, neutral, puller] = along[..] else {
        panic!("{moved:?}")
    };
    readme.says(&format!(
        "A neutral squirmer on a path half a radius beside the centre of a sphere of its own size moves it {neutral:.2} radii \
         ahead, a strong puller (β = 5) {:.2} radii back; by lubrication theory these are {neutral_lt:.2} ahead and {:.2} back",
        -puller, -puller_lt
    ));
}
