//! How good public codes are near contact.

use super::*;
use compare::judge::{GAPS, Item, LeaderRow, Options, Scorecard, judge, mover};
use compare::submission::{Submission, Submitted};

fn card(name: &str, grid: Option<Grid>) -> Scorecard {
    let submission = Submission::parse(fixtures::peer(name).unwrap()).unwrap();
    let submitted = Submitted::File(submission);
    let theirs = grid.map(|_| mover(&format!("{name}-readme"), &submitted).unwrap());
    let theirs = theirs
        .as_ref()
        .map_or(Err("not asked for".to_owned()), |model| {
            model.as_ref().map_err(String::clone)
        });
    judge(
        name,
        &submitted,
        theirs,
        exact(),
        &Options { grid, gaps: &GAPS },
    )
    .unwrap()
}

/// The error of `X11A` in per cent, at a gap.
fn squeezing(card: &Scorecard, gap: f64) -> String {
    let is_meant = |item: Item| item.to_string() == "X11A";
    let mut points = card.points.iter().chain(&card.between);
    let point = points
        .find(|point| is_meant(point.item) && (point.gap / gap - 1.0).abs() < 1e-9)
        .unwrap();
    format!("{:.0}", point.relative_percent().abs())
}

#[test]
fn readme_public_codes_near_contact() {
    let mut readme = Claims::default();
    let (pystokes, blobs) = (
        card("pystokes", Some(Grid::new(20).unwrap())),
        card("multiblobs-642", None),
    );
    readme.says(&format!(
        "At a gap of 0.01 the squeezing force X11A is off by {} % in PyStokes and by {} % for spheres of 642 blobs",
        squeezing(&pystokes, 0.01),
        squeezing(&blobs, 0.01)
    ));
    let table = card("townsend-table", None);
    let between = table
        .between
        .iter()
        .filter(|point| point.given)
        .map(|point| point.error().abs())
        .fold(0.0, f64::max);
    let row = LeaderRow::of(&table);
    assert!(row.error_01 < 1e-6, "{row:?}");
    readme.says(&format!(
        "a published table of Stokesian dynamics, right to 1e-6 at its node 0.1, by up to {:.0} % between its nodes",
        100.0 * between
    ));
    let jfsd = card("jfsd-matrix", None);
    let law = jfsd
        .matrix_laws
        .iter()
        .find(|law| law.name == "equal spheres")
        .unwrap();
    assert!(law.is_broken());
    readme.says(&format!(
        "JFSD's two equal spheres turn differently, by {:.3} at a gap of {}",
        law.value, law.gap
    ));
    let collisions = pystokes.collisions.as_ref().unwrap();
    let worst = collisions
        .cases
        .iter()
        .filter_map(|score| score.error_deg())
        .fold(0.0, f64::max);
    let shares = collisions
        .trust
        .iter()
        .find(|shares| (shares.beta - 5.0).abs() < 1e-9)
        .unwrap();
    readme.says(&format!(
        "With PyStokes deflections of the paper's cases are off by up to {worst:.0}°, and {:.0} % of the incoming angles of pullers with β = 5 end otherwise",
        100.0 * shares.other_outcome
    ));
}
