//! The sections on maps over the incoming angles: outcomes (Fig. 1c), deflections (Figs 2-4), shares
//! (Fig. 5a), and where lubrication theory can be trusted, in the plane and off it.

use super::{outcomes, written};
use crate::cli::maps::SCATTER_BETA;
use crate::maps::{
    self, BoundRow, FateRow, Grid, Pair, ScatterRow, TrustRow, bound_examples, bound_rows,
    trust_rows,
};
use crate::output::{OutputFolder, csv_text};
use crate::pictures;
use crate::report::{Section, Table};
use crate::sweep::SweepOptions;
use crate::{CompareError, Method, Model};

/// Points a side of the maps of Figs 2 to 4, of the shares against beta, and of the trust against the
/// offset.
const SCATTER_GRID: usize = 40;
const FATES_GRID: usize = 30;
const OFFSET_GRID: usize = 20;

/// Squirmer parameters of Fig. 5(a).
const FATES_BETA: std::ops::RangeInclusive<i32> = -10..=10;

/// Offsets out of the plane, in radii.
const OFFSETS: [f64; 6] = [0.0, 0.1, 0.2, 0.3, 0.4, 0.5];

/// Tolerance of the steps in maps.
const TOLERANCE: f64 = 1e-7;

/// The sections; none without lubrication theory or without the exact series to judge it by.
pub(super) fn sections(
    models: &[Model],
    sweep: &SweepOptions,
    out: &OutputFolder,
) -> Result<Vec<Section>, CompareError> {
    // Boundary elements agree with the exact series, as the sections above show.
    let models: Vec<&Model> = models
        .iter()
        .filter(|m| m.method() != Method::Bem)
        .collect();
    let exact = models.iter().find(|m| m.method() == Method::Exact);
    let (Some(exact), true) = (exact, models.len() > 1) else {
        return Ok(Vec::new());
    };
    let mut sweep = *sweep;
    sweep.run.tolerance = TOLERANCE;
    let report = Maps {
        models: &models,
        exact,
        sweep: &sweep,
        out,
    };
    let mut sections = vec![outcomes::section(&models, &sweep, out)?];
    let Some(rows) = report.scatter(&mut sections)? else {
        return Ok(sections);
    };
    report.fates(&mut sections)?;
    report.trust(&rows, &mut sections)?;
    report.trust_against_offset(&mut sections)?;
    Ok(sections)
}

struct Maps<'a> {
    models: &'a [&'a Model],
    exact: &'a Model,
    sweep: &'a SweepOptions,
    out: &'a OutputFolder,
}

fn in_plane(beta: f64) -> Pair {
    Pair {
        beta,
        g: 0.0,
        dz: 0.0,
    }
}

impl Maps<'_> {
    /// Figs 1(c), 2, 3 and 4.
    fn scatter(
        &self,
        sections: &mut Vec<Section>,
    ) -> Result<Option<Vec<ScatterRow>>, CompareError> {
        let pairs = SCATTER_BETA.map(in_plane);
        let grid = Grid::new(SCATTER_GRID)?;
        let Some(rows) = maps::scatter(self.models, &pairs, grid, self.sweep, self.out)? else {
            sections.push(unfinished(
                "scatter",
                "Maps over the incoming angles (Figs 2 to 4)",
            ));
            return Ok(None);
        };
        let csv = csv_text(&rows)?;
        self.out.write("scatter.csv", &csv)?;
        let shares = maps::fates_of(self.models, &pairs, grid, &rows);
        // Beta by beta, lubrication theory above what judges it.
        let mut drawn = Vec::new();
        for beta in SCATTER_BETA {
            let of_beta: Vec<ScatterRow> = (rows.iter())
                .filter(|row| row.beta.total_cmp(&beta).is_eq())
                .cloned()
                .collect();
            drawn.extend(pictures::of_scatter(&of_beta)?);
        }
        let table = Table::from_rows(
            "Shares of the plane; the linked file has every point.",
            "scatter.csv",
            &shares,
        )?;
        sections.push(Section {
            id: "scatter".to_owned(),
            title: "Maps over the incoming angles (Figs 1c and 2 to 4)".to_owned(),
            prose: vec![
                "Squirmers start at (-1.5, 0) and (1.5, 0) with the angles φ1 = π(Σ - Δ)/2 and φ2 = \
                 π(Σ + Δ)/2. What becomes of them is told from the motion itself: scattered (I), at rest \
                 facing each other (II), swimming together along a line (III), orbiting anticlockwise (IV) or \
                 clockwise (V). A pair is bound once gap and orientations have come to a fixed point from which \
                 nothing grows; undecided is what has neither parted nor settled at t = 200."
                    .to_owned(),
                bound_in_words(&shares),
            ],
            figures: written(drawn, self.out)?,
            tables: vec![Table { csv, ..table }],
        });
        Ok(Some(rows))
    }

    /// Fig. 5(a).
    fn fates(&self, sections: &mut Vec<Section>) -> Result<(), CompareError> {
        let title = "Share of each outcome against β (Fig. 5a)";
        let pairs: Vec<Pair> = FATES_BETA.map(f64::from).map(in_plane).collect();
        let grid = Grid::new(FATES_GRID)?;
        let Some(rows) = maps::fates(self.models, &pairs, grid, self.sweep, self.out)? else {
            sections.push(unfinished("fates", title));
            return Ok(());
        };
        let csv = csv_text(&rows)?;
        self.out.write("fates.csv", &csv)?;
        sections.push(Section {
            id: "fates".to_owned(),
            title: title.to_owned(),
            prose: vec![format!(
                "Shares of a grid of {FATES_GRID} by {FATES_GRID} incoming angles; the sampling error in the \
                 table is that of as many random ones."
            )],
            figures: written(pictures::of_fates(&rows)?, self.out)?,
            tables: vec![Table::from_csv("Shares of the plane.", "fates.csv", &csv)?],
        });
        Ok(())
    }

    /// The trust map, from the maps that have been run.
    fn trust(&self, rows: &[ScatterRow], sections: &mut Vec<Section>) -> Result<(), CompareError> {
        let of = |model: &Model| -> Vec<&[ScatterRow]> {
            let points = SCATTER_GRID * SCATTER_GRID;
            (rows.chunks(points))
                .filter(|map| map[0].method == model.method().name())
                .collect()
        };
        let referee = of(self.exact);
        let judged = self.models.iter().filter(|m| m.method() != Method::Exact);
        let trusted: Vec<TrustRow> = judged
            .flat_map(|model| of(model).into_iter().zip(referee.clone()))
            .zip(SCATTER_BETA.into_iter().cycle())
            .flat_map(|((judged, exact), beta)| trust_rows(judged, exact, in_plane(beta)))
            .collect();
        let states = bound_rows(self.models, &SCATTER_BETA)?;
        let examples = bound_examples(&trusted, &states);
        let (csv, states_csv) = (csv_text(&trusted)?, csv_text(&states)?);
        self.out.write("trust.csv", &csv)?;
        self.out.write("bound-states.csv", &states_csv)?;
        let shares = maps::trust_shares(&trusted);
        let table = Table::from_rows(
            "Shares of the plane by how far lubrication theory is from exact hydrodynamics; the linked file \
             has every point.",
            "trust.csv",
            &shares,
        )?;
        let mut prose: Vec<String> = shares.iter().map(trust_in_words).collect();
        prose.push(states_in_words(&states));
        sections.push(Section {
            id: "trust".to_owned(),
            title: "Where lubrication theory can be trusted".to_owned(),
            prose,
            figures: written(pictures::of_trust(&trusted)?, self.out)?,
            tables: vec![
                Table { csv, ..table },
                Table::from_rows(
                    "Pairs that one model binds and the other parts, or binds otherwise: an example of each kind, \
                     and what the other model has of that state (where both bind, exact hydrodynamics of \
                     lubrication theory's): none, an unstable one with its gap and growth rate by linearised \
                     motion, or one that attracts but is not reached from there.",
                    "trust-examples.csv",
                    &examples,
                )?,
                Table::from_csv(
                    "All bound states with gaps below 1, stable or not: fixed points of gap and orientations \
                     as seen along the line of centres, by Newton's method from all over the plane. Mirror \
                     images are left out.",
                    "bound-states.csv",
                    &states_csv,
                )?,
            ],
        });
        Ok(())
    }

    /// Trust against the offset out of the plane.
    fn trust_against_offset(&self, sections: &mut Vec<Section>) -> Result<(), CompareError> {
        let title = "Trust in lubrication theory off the plane";
        let pairs: Vec<Pair> = (SCATTER_BETA.into_iter())
            .flat_map(|beta| OFFSETS.map(|dz| Pair { beta, g: 0.0, dz }))
            .collect();
        let judged: Vec<&Model> = (self.models.iter().copied())
            .filter(|m| m.method() != Method::Exact)
            .collect();
        let grid = Grid::new(OFFSET_GRID)?;
        let (exact, sweep, name) = (self.exact, self.sweep, "trust-offset");
        let rows = maps::trust_as(name, &judged, exact, &pairs, grid, sweep, self.out)?;
        let Some(rows) = rows else {
            sections.push(unfinished("trust-offset", title));
            return Ok(());
        };
        let shares = maps::trust_shares(&rows);
        let csv = csv_text(&shares)?;
        self.out.write("trust-offset.csv", &csv)?;
        let drawn = pictures::of_trust_against_offset(&shares)?;
        sections.push(Section {
            id: "trust-offset".to_owned(),
            title: title.to_owned(),
            prose: vec![
                "The same classes when the first squirmer starts raised by δz/2 and the second lowered by \
                 δz/2, over all incoming angles of the plane."
                    .to_owned(),
            ],
            figures: written(drawn, self.out)?,
            tables: vec![Table::from_csv("Shares of the plane.", "trust-offset.csv", &csv)?],
        });
        Ok(())
    }
}

fn unfinished(id: &str, title: &str) -> Section {
    Section {
        id: id.to_owned(),
        title: title.to_owned(),
        prose: vec!["The time limit was reached: the same command goes on from here.".to_owned()],
        ..Section::default()
    }
}

fn percent(share: f64) -> String {
    format!("{:.1} %", 100.0 * share)
}

/// What is bound, map by map.
fn bound_in_words(shares: &[FateRow]) -> String {
    let parts: Vec<String> = (shares.iter())
        .filter(|row| row.bound() + row.undecided > 0.0)
        .map(|row| {
            let FateRow { method, beta, .. } = row;
            let mut kinds = Vec::new();
            for (name, share) in [
                ("swimming together", row.pairwise),
                ("orbiting", row.orbits()),
                ("at rest", row.standoff),
                ("undecided", row.undecided),
            ] {
                if share > 0.0 {
                    kinds.push(format!("{} {name}", percent(share)));
                }
            }
            format!("β = {beta} by {method}: {}", kinds.join(", "))
        })
        .collect();
    if parts.is_empty() {
        "No pair stays bound.".to_owned()
    } else {
        format!("What does not part: {}. All others part.", parts.join("; "))
    }
}

fn trust_in_words(shares: &maps::TrustShares) -> String {
    let usable = shares.within_5_deg + shares.within_15_deg;
    format!(
        "β = {}, {}: over {} of the incoming angles both outgoing directions are within 5° of the exact ones, \
         over {} within 15°; {} end otherwise altogether.",
        shares.beta,
        shares.method,
        percent(shares.within_5_deg),
        percent(usable),
        percent(shares.other_outcome),
    )
}

/// Which states attract, model by model.
fn states_in_words(states: &[BoundRow]) -> String {
    let stable: Vec<String> = (states.iter())
        .filter(|state| state.growth < 0.0 && !state.one_of_a_line)
        .map(|state| {
            format!(
                "{} has {} at β = {} (gap {:.3}, disturbances decay at the rate {:.3})",
                state.method, state.outcome, state.beta, state.gap, -state.growth
            )
        })
        .collect();
    if stable.is_empty() {
        return "No bound state attracts.".to_owned();
    }
    format!(
        "Bound states that attract every small disturbance in the plane: {}. All others in the table are \
         saddles, or neutral. Lubrication theory has besides, at its cut, a line of neutral states: any two \
         squirmers side by side in parallel at a gap of exactly 1, where its loads have faded to those of \
         lone squirmers. That is where its pullers swim together.",
        stable.join("; ")
    )
}
