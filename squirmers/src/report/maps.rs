//! The sections on maps over the incoming angles: outcomes (Fig. 1c), deflections (Figs 2-4), shares (Fig. 5a), and
//! where lubrication theory can be trusted, with and without an offset out of the plane.

use super::findings::{self, percent};
use super::{outcomes, written};
use crate::commands::maps::SCATTER_BETA;
use crate::error::CommandError;
use crate::page::{Section, Table};
use crate::pictures;
use compare::output::{OutputFolder, csv_text};
use compare::study::maps::{
    self, FateRow, Grid, Maps, Pair, ScatterRow, TrustRow, bound_examples, bound_rows, trust_rows,
};
use compare::sweep::SweepOptions;
use compare::{Method, Model};

/// Points a side of the maps of Figs 2 to 4, of the maps for the shares as a function of beta, and of the maps of
/// trust as a function of the offset.
const SCATTER_GRID: usize = 100;
const FATES_GRID: usize = 30;
const OFFSET_GRID: usize = 20;

/// Squirmer parameters of Fig. 5(a).
const FATES_BETA: std::ops::RangeInclusive<i32> = -10..=10;

/// Offsets out of the plane, in radii.
const OFFSETS: [f64; 6] = [0.0, 0.1, 0.2, 0.3, 0.4, 0.5];

/// Tolerance of the integrator in maps.
const TOLERANCE: f64 = 1e-7;

/// The maps of the page.
pub(super) struct ReportMaps<'a> {
    /// All models except boundary elements, which agree with the exact series.
    models: Vec<&'a Model>,
    exact: &'a Model,
    options: SweepOptions,
    out: &'a OutputFolder,
}

fn in_plane(beta: f64) -> Pair {
    Pair {
        beta,
        g: 0.0,
        dz: 0.0,
    }
}

impl<'a> ReportMaps<'a> {
    /// The maps; `None` without the exact series, or without a model to compare with them.
    pub(super) fn new(
        models: &'a [Model],
        sweep: &SweepOptions,
        out: &'a OutputFolder,
    ) -> Option<Self> {
        let models: Vec<&Model> = (models.iter())
            .filter(|model| model.method() != Method::Bem)
            .collect();
        let exact = models.iter().find(|m| m.method() == Method::Exact)?;
        let mut options = *sweep;
        options.run.tolerance = TOLERANCE;
        (models.len() > 1).then(|| Self {
            exact,
            models: models.clone(),
            options,
            out,
        })
    }

    fn named(
        &self,
        name: &'static str,
        pairs: Vec<Pair>,
        grid: usize,
    ) -> Result<Maps<'a>, CommandError> {
        Ok(Maps {
            name,
            models: self.models.clone(),
            exact: None,
            pairs,
            grid: Grid::new(grid)?,
            options: self.options,
            out: self.out,
        })
    }

    fn scatter_maps(&self) -> Result<Maps<'a>, CommandError> {
        self.named("scatter", SCATTER_BETA.map(in_plane).into(), SCATTER_GRID)
    }

    fn fates_maps(&self) -> Result<Maps<'a>, CommandError> {
        self.named(
            "fates",
            FATES_BETA.map(f64::from).map(in_plane).collect(),
            FATES_GRID,
        )
    }

    fn offset_maps(&self) -> Result<Maps<'a>, CommandError> {
        let pairs = (SCATTER_BETA.into_iter())
            .flat_map(|beta| OFFSETS.map(|dz| Pair { beta, g: 0.0, dz }))
            .collect();
        Ok(Maps {
            models: self.judged(),
            exact: Some(self.exact),
            ..self.named("trust-offset", pairs, OFFSET_GRID)?
        })
    }

    /// The models that are compared with the exact one.
    fn judged(&self) -> Vec<&'a Model> {
        (self.models.iter().copied())
            .filter(|model| model.method() != Method::Exact)
            .collect()
    }

    /// Checks that no finished lines of another command's maps would be deleted.
    pub(super) fn check(&self) -> Result<(), CommandError> {
        for maps in [
            self.scatter_maps()?,
            self.fates_maps()?,
            self.offset_maps()?,
        ] {
            maps.check()?;
        }
        Ok(())
    }

    /// All sections on maps.
    pub(super) fn sections(&self) -> Result<Vec<Section>, CommandError> {
        let mut sections = vec![outcomes::section(&self.models, &self.options, self.out)?];
        let Some(rows) = self.scatter(&mut sections)? else {
            return Ok(sections);
        };
        self.fates(&mut sections)?;
        self.trust(&rows, &mut sections)?;
        self.trust_against_offset(&mut sections)?;
        Ok(sections)
    }

    /// Figs 1(c), 2, 3 and 4.
    fn scatter(
        &self,
        sections: &mut Vec<Section>,
    ) -> Result<Option<Vec<ScatterRow>>, CommandError> {
        let (mut shares, mut drawn, mut all) = (Vec::new(), Vec::new(), Vec::new());
        let complete =
            (self.scatter_maps()?).scatter::<CommandError>(&mut |model, pair, rows| {
                shares.push(maps::fates_of(model, pair, &rows));
                drawn.push((pair.beta, pictures::of_scatter(&rows)?));
                all.extend(rows);
                Ok(())
            })?;
        if !complete {
            sections.push(unfinished(
                "scatter",
                "Maps over the incoming angles (Figs 2 to 4)",
            ));
            return Ok(None);
        }
        let csv = csv_text(&all)?;
        // For each beta, lubrication theory comes before exact hydrodynamics.
        let place = |beta: f64| SCATTER_BETA.iter().position(|b| b.total_cmp(&beta).is_eq());
        drawn.sort_by_key(|(beta, _)| place(*beta));
        let drawn = drawn.into_iter().flat_map(|(_, pictures)| pictures);
        let table = Table::from_rows(
            "Shares of the plane; the linked file has every point.",
            "scatter.csv",
            &shares,
        )?;
        sections.push(Section {
            id: "scatter".to_owned(),
            title: "Maps over the incoming angles (Figs 1c and 2 to 4)".to_owned(),
            finding: findings::of_bound(&shares),
            prose: vec![
                "Squirmers start at (-1.5, 0) and (1.5, 0) with the angles φ1 = π(Σ - Δ)/2 and φ2 = \
                 π(Σ + Δ)/2. The outcomes are: scattered (I), at rest facing each other (II), swimming together along a \
                 line (III), orbiting anticlockwise (IV) or clockwise (V). A pair is bound if its gap and orientations reach \
                 a fixed point at which no disturbance grows. A pair is undecided if it has neither parted nor reached such a \
                 fixed point at t = 200."
                    .to_owned(),
                bound_in_words(&shares),
            ],
            figures: written(drawn.collect(), self.out)?,
            tables: vec![Table { csv, ..table }],
        });
        Ok(Some(all))
    }

    /// Fig. 5(a).
    fn fates(&self, sections: &mut Vec<Section>) -> Result<(), CommandError> {
        let title = "Share of each outcome against β (Fig. 5a)";
        let Some(rows) = self.fates_maps()?.fates()? else {
            sections.push(unfinished("fates", title));
            return Ok(());
        };
        let csv = csv_text(&rows)?;
        self.out.write("fates.csv", &csv)?;
        sections.push(Section {
            id: "fates".to_owned(),
            title: title.to_owned(),
            finding: findings::of_fates(&rows),
            prose: vec![format!(
                "Shares of a grid of {FATES_GRID} by {FATES_GRID} incoming angles. The sampling error in the \
                 table is the error for the same number of random points."
            )],
            figures: written(pictures::of_fates(&rows)?, self.out)?,
            tables: vec![Table::from_csv("Shares of the plane.", "fates.csv", &csv)?],
        });
        Ok(())
    }

    /// The map of trust, from maps that have been run.
    fn trust(&self, rows: &[ScatterRow], sections: &mut Vec<Section>) -> Result<(), CommandError> {
        let of = |model: &Model| -> Vec<&[ScatterRow]> {
            let points = SCATTER_GRID * SCATTER_GRID;
            (rows.chunks(points))
                .filter(|map| map[0].method == model.method())
                .collect()
        };
        let referee = of(self.exact);
        let trusted: Vec<TrustRow> = (self.judged().into_iter())
            .flat_map(|model| of(model).into_iter().zip(referee.clone()))
            .zip(SCATTER_BETA.into_iter().cycle())
            .flat_map(|((judged, exact), beta)| trust_rows(judged, exact, in_plane(beta)))
            .collect();
        let states = bound_rows(&self.models, &SCATTER_BETA)?;
        let examples = bound_examples(&trusted, &states);
        let (csv, states_csv) = (csv_text(&trusted)?, csv_text(&states)?);
        self.out.write("trust.csv", &csv)?;
        self.out.write("bound-states.csv", &states_csv)?;
        let shares = maps::trust_shares(&trusted);
        let table = Table::from_rows(
            "Share of the plane in each class of difference between lubrication theory and exact hydrodynamics. The \
             linked file has every point.",
            "trust.csv",
            &shares,
        )?;
        let mut prose: Vec<String> = shares.iter().map(trust_in_words).collect();
        prose.push(findings::of_states(&states));
        sections.push(Section {
            id: "trust".to_owned(),
            title: "Where lubrication theory can be trusted".to_owned(),
            finding: findings::of_trust(&shares),
            prose,
            figures: written(pictures::of_trust(&trusted)?, self.out)?,
            tables: vec![
                Table { csv, ..table },
                Table::from_rows(
                    "Starts from which one model gives a bound state and the other gives a different outcome, with one \
                     example for each pair of outcomes. The column `state` says whether the other model has this bound \
                     state: it is absent, or unstable (with its gap and its growth rate from linearised motion), or stable \
                     but not reached from this start. If both models bind the pair, this is lubrication theory's state.",
                    "trust-examples.csv",
                    &examples,
                )?,
                Table::from_csv(
                    "All stable and unstable bound states with gaps below 1. They are fixed points of the gap and of the \
                     orientations relative to the line of centres, found by Newton's method from many starts. Mirror \
                     images are left out.",
                    "bound-states.csv",
                    &states_csv,
                )?,
            ],
        });
        Ok(())
    }

    /// Trust as a function of the offset out of the plane.
    fn trust_against_offset(&self, sections: &mut Vec<Section>) -> Result<(), CommandError> {
        let title = "Trust in lubrication theory off the plane";
        let mut shares = Vec::new();
        let complete = (self.offset_maps()?).trust::<CommandError>(false, &mut |_, _, rows| {
            shares.extend(maps::trust_shares(&rows));
            Ok(())
        })?;
        if !complete {
            sections.push(unfinished("trust-offset", title));
            return Ok(());
        }
        let csv = csv_text(&shares)?;
        self.out.write("trust-offset.csv", &csv)?;
        let drawn = pictures::of_trust_against_offset(&shares)?;
        sections.push(Section {
            id: "trust-offset".to_owned(),
            title: title.to_owned(),
            finding: findings::of_trust_against_offset(&shares),
            prose: vec![
                "Shares of the classes of difference when squirmer 1 starts at z = δz/2 and squirmer 2 at z = -δz/2, over \
                 all incoming angles of the plane."
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
        prose: vec!["The time limit was reached. The same command continues from here.".to_owned()],
        ..Section::default()
    }
}

/// The shares of pairs that do not part, for each map.
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
        format!(
            "Pairs that do not part: {}. All others part.",
            parts.join("; ")
        )
    }
}

fn trust_in_words(shares: &maps::TrustShares) -> String {
    let usable = shares.within_5_deg + shares.within_15_deg;
    format!(
        "β = {}, {}: both outgoing directions are within 5° of the exact ones over {} of the incoming angles, and \
         within 15° over {}. The outcome differs over {}.",
        shares.beta,
        shares.method,
        percent(shares.within_5_deg),
        percent(usable),
        percent(shares.other_outcome),
    )
}
