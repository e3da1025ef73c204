//! The section on public codes and the models of this workspace: who is how accurate, for how long.

use compare::judge::{LeaderRow, Scorecard, is_public, leader_rows, leaderboard};
use compare::output::{OutputFolder, csv_text};
use compare::{Model, numbers};
use serde::Serialize;

use crate::error::CommandError;
use crate::figures::trusted_gaps;
use crate::page::{Figure, Section, Table};
use crate::pictures::of_scores;

pub(super) fn section(exact: &Model, out: &OutputFolder) -> Result<Section, CommandError> {
    let cards = leaderboard(exact)?;
    let rows = leader_rows(&cards);
    let csv = csv_text(&rows)?;
    out.write("leaderboard.csv", &csv)?;
    let mut figures = Vec::new();
    let trusted = trusted_gaps(&rows)?;
    out.write("trusted-gaps.svg", &trusted)?;
    figures.push(Figure {
        svg: trusted,
        caption: "All that a model gives is within a bound from its mark on, to the largest of its gaps. A model without a mark breaks the bound there \
                  already. No model was asked at gaps smaller than 0.005, but for the near field."
            .to_owned(),
    });
    if let Some(picture) = of_scores(&rows)? {
        out.write(&picture.file_name, &picture.svg)?;
        figures.push(Figure {
            svg: picture.svg,
            caption: "Time of one gap, as measured on one core for public codes and now for the models of this workspace."
                .to_owned(),
        });
    }
    Ok(Section {
        id: "leaderboard".to_owned(),
        title: "Who is how accurate, for how long".to_owned(),
        finding: finding(&rows),
        prose: vec![
            "Public codes and the models of this workspace, all judged in the same way by `squirmers judge`. The score is the largest error of the ten \
             resistance scalars at gaps from 0.01 to 2, each divided by the larger of the exact scalar and 1."
                .to_owned(),
        ],
        figures,
        tables: vec![
            Table::from_csv(
                "Sorted by score; models without all ten scalars at all these gaps come last.",
                "leaderboard.csv",
                &csv,
            )?,
            Table::from_rows(
                "What is wrong with public codes, the worst first.",
                "leaderboard-faults.csv",
                &cards.iter().flat_map(faults).collect::<Vec<_>>(),
            )?,
        ],
    })
}

/// A fault of a public code, or a law that it breaks.
#[derive(Serialize)]
struct Wrong {
    model: String,
    what: &'static str,
    sentence: String,
}

fn faults(card: &Scorecard) -> Vec<Wrong> {
    if !is_public(&card.name) {
        return Vec::new();
    }
    let wrong = |what, sentence| Wrong {
        model: card.name.clone(),
        what,
        sentence,
    };
    let laws = card.matrix_laws.iter().filter(|law| law.is_broken());
    let laws = laws.map(|law| {
        let off = numbers::rounded(law.value, 4);
        wrong(
            "law broken",
            format!(
                "{} of the matrix: off by {off}, worst at gap {}",
                law.name,
                numbers::few_digits(law.gap)
            ),
        )
    });
    let faults = card
        .faults
        .iter()
        .map(|fault| wrong(fault.kind.name(), fault.sentence()));
    laws.chain(faults).collect()
}

fn finding(rows: &[LeaderRow]) -> String {
    let public = || {
        rows.iter()
            .filter(|row| is_public(&row.model) && row.score.is_finite())
    };
    let within = public().filter(|row| row.score <= 0.01).count();
    let beyond = public().filter(|row| row.score > 0.2).count();
    let count = public().count();
    format!(
        "Of {count} sets of resistance scalars by public codes and published formulas, {within} are within 1 % at gaps from 0.01 to 2, and {beyond} are off by more than 20 %."
    )
}
