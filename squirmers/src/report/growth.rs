//! What the page says of motion out of the plane: how an offset grows over the incoming angles, and which bound states exist in three dimensions.

use super::findings::number;
use super::written;
use crate::commands::growth::OFFSET;
use crate::commands::maps::SCATTER_BETA;
use crate::error::CommandError;
use crate::figures::GrowthMap;
use crate::page::{Figure, Table};
use crate::pictures;
use compare::Model;
use compare::output::{OutputFolder, csv_text};
use compare::study::maps::{BoundRow, Grid, GrowthShares, Maps, Pair, bound_rows, growth_shares};
use compare::sweep::SweepOptions;

/// Points a side of the maps.
const GRID: usize = 10;

/// Tolerance of the integrator, as in other maps.
const TOLERANCE: f64 = 1e-7;

/// What a section shows of it.
#[derive(Debug, Default)]
pub(super) struct Growth {
    /// The finding in a sentence or two.
    pub finding: String,
    /// Paragraphs.
    pub prose: Vec<String>,
    /// The maps.
    pub figures: Vec<Figure>,
    /// The shares and the bound states.
    pub tables: Vec<Table>,
}

/// The maps of the paper's squirmers by these models.
pub(super) fn maps<'a>(
    models: &[&'a Model],
    sweep: &SweepOptions,
    out: &'a OutputFolder,
) -> Result<Maps<'a>, CommandError> {
    let mut options = *sweep;
    options.run.tolerance = TOLERANCE;
    let in_plane = |beta: f64| Pair {
        beta,
        g: 0.0,
        dz: 0.0,
    };
    Ok(Maps {
        name: "growth",
        models: models.to_vec(),
        exact: None,
        pairs: SCATTER_BETA.map(in_plane).into(),
        grid: Grid::new(GRID)?,
        options,
        out,
    })
}

/// The maps with their shares, and the bound states of the models; `None` if the time limit left something out.
pub(super) fn growth(
    models: &[&Model],
    sweep: &SweepOptions,
    out: &OutputFolder,
) -> Result<Option<Growth>, CommandError> {
    let (mut shares, mut drawn) = (Vec::new(), Vec::new());
    let complete =
        (maps(models, sweep, out)?).growth::<CommandError>(&mut |model, pair, rows| {
            shares.push(growth_shares(model, pair, &rows, OFFSET));
            drawn.push(GrowthMap::new(&rows, OFFSET)?);
            Ok(())
        })?;
    if !complete {
        return Ok(None);
    }
    let states = bound_rows(models, &SCATTER_BETA)?;
    let csv = csv_text(&shares)?;
    out.write("growth-shares.csv", &csv)?;
    let picture = pictures::of_growth(&drawn, OFFSET)?;
    Ok(Some(Growth {
        finding: finding(&shares, &states),
        prose: vec![
            format!(
                "The growth is the angle by which an outgoing orientation turns out of the plane per offset out of it (squirmer 1 raised by dz/2, squirmer \
                 2 lowered by dz/2), from the linearised motion along the run in the plane; the larger of the two. Where it is larger than one over \
                 the offset, motion in the plane is a fiction: for an offset of {} radii the limit is {} rad/a. Maps have {GRID} by {GRID} points; \
                 the command growth draws finer ones.",
                number(OFFSET),
                number(1.0 / OFFSET)
            ),
            states_in_words(&states),
        ],
        figures: written(picture.into_iter().collect(), out)?,
        tables: vec![
            Table::from_csv(
                "Shares of the incoming angles, and growth of pairs that part.",
                "growth-shares.csv",
                &csv,
            )?,
            Table::from_rows(
                "Bound states in three dimensions. Growth rates are those of the fastest small disturbance in the plane, and out of it apart from \
                 turning the whole pair.",
                "bound-states.csv",
                &states,
            )?,
        ],
    }))
}

/// The share of the plane that is a fiction, at most, and the attractors that are left in space.
fn finding(shares: &[GrowthShares], states: &[BoundRow]) -> String {
    let worst = (shares.iter()).max_by(|a, b| a.fiction().total_cmp(&b.fiction()));
    let mut text = worst.map_or_else(String::new, |row| {
        format!(
            "With an offset of {} radii out of the plane, motion in the plane is a fiction over up to {:.0} % of the incoming angles (β = {} by {}, {GRID} by {GRID} points).",
            number(row.offset),
            100.0 * row.fiction(),
            number(row.beta),
            row.method.in_sentence()
        )
    });
    let planar = states.iter().filter(|row| row.stable_in_plane == "yes");
    let (all, spatial) = planar.fold((0, 0), |(all, spatial), row| {
        (all + 1, spatial + usize::from(row.stable_in_space == "yes"))
    });
    if all > 0 {
        text += &format!(
            " Of {all} bound states that attract in the plane, {} in three dimensions.",
            match spatial {
                0 => "none attracts".to_owned(),
                1 => "one attracts".to_owned(),
                _ => format!("{spatial} attract"),
            }
        );
    }
    text
}

/// What becomes in space of each state that attracts in the plane.
fn states_in_words(states: &[BoundRow]) -> String {
    let parts: Vec<String> = (states.iter())
        .filter(|row| row.stable_in_plane == "yes")
        .map(|row| {
            let rate = row.growth_off_plane;
            let what = match row.stable_in_space {
                "yes" => format!("attracts in space too (decay at the rate {:.3})", -rate),
                "no" => format!("is left out of the plane (growth at the rate {rate:.3})"),
                other => format!("is {other} in space"),
            };
            let BoundRow {
                method,
                beta,
                outcome,
                gap,
                ..
            } = row;
            format!(
                "{outcome} at β = {} by {} (gap {gap:.3}) {what}",
                number(*beta),
                method.in_sentence()
            )
        })
        .collect();
    if parts.is_empty() {
        "No bound state attracts in the plane.".to_owned()
    } else {
        format!(
            "Bound states that attract in the plane: {}.",
            parts.join("; ")
        )
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

    use super::*;
    use crate::page::{Page, Section, render};
    use compare::{Method, ModelOptions};
    use scene::RunOptions;

    #[test]
    fn maps_shares_and_bound_states_are_on_the_page() {
        let folder = tempfile::tempdir().unwrap();
        let out = OutputFolder::open(folder.path()).unwrap();
        let models = [Method::Lt, Method::Exact]
            .map(|method| Model::set_up(method, &ModelOptions::default()).unwrap());
        let sweep = SweepOptions {
            run: RunOptions::default(),
            time_limit: None,
        };
        let models: Vec<&Model> = models.iter().collect();
        let growth = growth(&models, &sweep, &out).unwrap().unwrap();
        assert!(
            growth.finding.contains("a fiction over up to"),
            "{}",
            growth.finding
        );
        assert!(
            growth.prose[1].contains("is left out of the plane"),
            "{:?}",
            growth.prose
        );
        let section = Section {
            finding: growth.finding,
            prose: growth.prose,
            figures: growth.figures,
            tables: growth.tables,
            ..Section::default()
        };
        let page = render(&Page {
            sections: vec![section],
            ..Page::default()
        });
        for part in [
            "Growth of an offset out of the plane",
            "stable_in_space",
            "fiction",
        ] {
            assert!(page.contains(part), "{part}");
        }
        for file in ["growth.csv", "growth.svg", "growth-shares.csv"] {
            assert!(folder.path().join(file).exists(), "{file}");
        }
    }
}
