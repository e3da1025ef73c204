//! Every CSV file that a command writes, and the page `docs/COLUMNS.md` that describes them.

use std::fmt::Write as _;

use super::{Column, Columns, UNITS};
use crate::cost::{CostRow, Finding, Recommendation};
use crate::hard_cases::HardCaseRow;
use crate::judge::{JudgeRow, LeaderRow};
use crate::reference::{
    DeflectionRow, FarFieldRow, MobilityRow, NearContactRow, ReferenceBoundState, ReferenceLoad,
};
use crate::scene_run::SampleRow;
use crate::study::cargo::CargoRow;
use crate::study::flow::FlowRow;
use crate::study::kinetics::{CollisionRow, KineticsRatioRow, KineticsRow};
use crate::study::maps::{
    BoundExample, BoundRow, FateRow, GrowthRow, GrowthShares, ScatterRow, TrustRow, TrustShares,
};
use crate::study::panels::TrajectoryRow;
use crate::study::ratios::RatioRow;
use crate::study::sensitivity::{DerivativeRow, SensitivityRow};
use crate::study::stress::{StressEncounterRow, StressRow, StressRunRow};
use crate::study::{ComparisonRow, LoadErrorRow, LoadRow, MeshErrorRow, SlopeRow};
use crate::sweep::SweepTail;
use crate::{EncounterRow, Method, OffsetRow};

/// A CSV file.
#[derive(Clone, Copy, Debug)]
pub struct CsvFile {
    /// Name of the file.
    pub name: &'static str,
    /// The commands that write it.
    pub commands: &'static [&'static str],
    /// What the file holds.
    pub holds: &'static str,
    /// What a row is.
    pub about: &'static str,
    /// Its columns in their order. In `sweep.csv` those of the parameters come before.
    pub columns: &'static [Column],
}

const fn file<R: Columns>(
    name: &'static str,
    commands: &'static [&'static str],
    holds: &'static str,
) -> CsvFile {
    CsvFile {
        name,
        commands,
        holds,
        about: R::ABOUT,
        columns: R::COLUMNS,
    }
}

/// Every CSV file. Files with the same kind of row stand together.
pub const FILES: [CsvFile; 47] = [
    file::<LoadRow>("loads.csv", &["loads"], "Loads at given gaps."),
    file::<EncounterRow>(
        "head-on.csv",
        &["head-on", "report"],
        "Opposed approach (Fig. 6).",
    ),
    file::<EncounterRow>(
        "orthogonal.csv",
        &["orthogonal", "report"],
        "Approach at right angles (Fig. 7).",
    ),
    file::<OffsetRow>(
        "offset.csv",
        &["offset", "report"],
        "Sensitivity to an offset out of the plane (Fig. 5b).",
    ),
    file::<SensitivityRow>(
        "sensitivity.csv",
        &["sensitivity", "report"],
        "How sensitive collisions are to an offset out of the plane, and to their start.",
    ),
    file::<DerivativeRow>(
        "sensitivity-derivatives.csv",
        &["sensitivity", "report"],
        "Every derivative of the outgoing headings.",
    ),
    file::<ScatterRow>(
        "scatter.csv",
        &["scatter", "report"],
        "Maps over the incoming angles (Figs 2 to 4).",
    ),
    file::<FateRow>(
        "fates.csv",
        &["fates", "report"],
        "Share of each outcome against beta and bottom-heaviness (Figs 5a and 8g).",
    ),
    file::<FateRow>(
        "gravity-fates.csv",
        &["report"],
        "Share of each outcome under gravity (Fig. 8g).",
    ),
    file::<JudgeRow>(
        "judge.csv",
        &["judge"],
        "Anybody's models against exact hydrodynamics.",
    ),
    file::<LeaderRow>(
        "leaderboard.csv",
        &["report"],
        "Public codes and the models of this workspace.",
    ),
    file::<BoundRow>(
        "bound-states.csv",
        &["trust", "growth", "report"],
        "Bound states, stable or not, in the plane and in three dimensions.",
    ),
    file::<GrowthRow>(
        "growth.csv",
        &["growth", "report"],
        "Growth of offsets out of the plane over the incoming angles.",
    ),
    file::<GrowthShares>(
        "growth-shares.csv",
        &["growth", "report"],
        "Share of the incoming angles for which motion in the plane is a fiction.",
    ),
    file::<TrustRow>(
        "trust.csv",
        &["trust", "report"],
        "Lubrication theory against exact hydrodynamics over the incoming angles.",
    ),
    file::<BoundExample>(
        "trust-examples.csv",
        &["trust"],
        "Pairs that one model binds and the other does not.",
    ),
    file::<TrustShares>(
        "trust-offset.csv",
        &["report"],
        "Lubrication theory against exact hydrodynamics with an offset out of the plane.",
    ),
    file::<TrajectoryRow>(
        "bottom-heavy.csv",
        &["bottom-heavy", "report"],
        "Bottom-heavy squirmers (Fig. 8a-f).",
    ),
    file::<TrajectoryRow>(
        "outcomes.csv",
        &["report"],
        "One start for each outcome of lubrication theory (Fig. 1c).",
    ),
    file::<TrajectoryRow>(
        "examples.csv",
        &["report"],
        "Neutral squirmers that meet (Fig. 2c).",
    ),
    file::<SampleRow>("run.csv", &["run"], "The trajectory of a scene file."),
    file::<FlowRow>(
        "flow.csv",
        &["flow"],
        "The flow about a pair on a grid in the plane of motion; with `--every` a file for each frame, `flow-0001.csv` and so on.",
    ),
    file::<StressRow>(
        "stress.csv",
        &["stress", "report"],
        "Stresslets and rates of work at given gaps (`--gap`).",
    ),
    file::<StressRunRow>(
        "stress-run.csv",
        &["stress"],
        "Stresslets, power and efficiency along the run of a scene file (`SCENE.toml`).",
    ),
    file::<StressEncounterRow>(
        "stress-encounters.csv",
        &["stress", "report"],
        "Excess stress and power of the paper's encounters (Figs 6 and 7; `--paper`, or nothing).",
    ),
    file::<SweepTail>(
        "sweep.csv",
        &["sweep", "merge"],
        "A sweep of a family of scenes.",
    ),
    file::<CollisionRow>(
        "collisions.csv",
        &["collisions", "merge"],
        "Collisions in three dimensions.",
    ),
    file::<KineticsRow>(
        "kinetics.csv",
        &["kinetics", "report"],
        "Collision integrals of a dilute suspension.",
    ),
    file::<KineticsRatioRow>(
        "kinetics-ratios.csv",
        &["kinetics", "report"],
        "Collision integrals by each method against exact hydrodynamics.",
    ),
    file::<HardCaseRow>(
        "hard-cases.csv",
        &["hard-cases", "report"],
        "Numerically hard cases, each with a bound.",
    ),
    file::<CostRow>("cost.csv", &["cost"], "Accuracy and time of every model."),
    file::<CostRow>(
        "cost-quick.csv",
        &["report"],
        "A quick measurement for the page, if the folder has no `cost.csv`.",
    ),
    file::<Recommendation>(
        "cost-target.csv",
        &["cost"],
        "The cheapest model for a target.",
    ),
    file::<Finding>(
        "cost-findings.csv",
        &["cost"],
        "Ratios, exponents and times that follow from `cost.csv`.",
    ),
    file::<LoadErrorRow>("load-errors.csv", &["report"], "Errors of the loads."),
    file::<MeshErrorRow>(
        "mesh-errors.csv",
        &["report"],
        "Errors of the boundary elements by the level of their mesh.",
    ),
    file::<RatioRow>(
        "ratios.csv",
        &["ratios", "report"],
        "Squirmers of unlike radii: shares of outcomes, and trust in lubrication theory.",
    ),
    file::<CargoRow>(
        "cargo.csv",
        &["cargo", "report"],
        "Displacements of a passive sphere by a swimmer that passes.",
    ),
    file::<SlopeRow>(
        "slopes.csv",
        &["report"],
        "How fast the loads by squirming grow as the gap closes.",
    ),
    file::<ComparisonRow>(
        "comparison.csv",
        &["report"],
        "Deflections by every method side by side.",
    ),
    file::<ReferenceLoad>(
        "reference/loads.csv",
        &["reference"],
        "`loads.csv` of the package of reference numbers.",
    ),
    file::<MobilityRow>(
        "reference/mobilities.csv",
        &["reference"],
        "`mobilities.csv` of the package of reference numbers.",
    ),
    file::<NearContactRow>(
        "reference/near-contact.csv",
        &["reference"],
        "`near-contact.csv` of the package of reference numbers.",
    ),
    file::<FarFieldRow>(
        "reference/far-field.csv",
        &["reference"],
        "`far-field.csv` of the package of reference numbers.",
    ),
    file::<DeflectionRow>(
        "reference/deflections.csv",
        &["reference"],
        "`deflections.csv` of the package of reference numbers.",
    ),
    file::<ReferenceBoundState>(
        "reference/bound-states.csv",
        &["reference"],
        "`bound-states.csv` of the package of reference numbers.",
    ),
    file::<FateRow>(
        "reference/shares.csv",
        &["reference"],
        "`shares.csv` of the package of reference numbers.",
    ),
];

const INTRODUCTION: &str = "\
# Columns of the CSV files

Every CSV file that a command writes has a header line with the names of its columns, then a line for each row. This
page is made from the code by `cargo run -p squirmers-compare --example columns > docs/COLUMNS.md`.

Squirmers have the numbers 1 and 2. The gap is the distance between their surfaces. A deflection is the outgoing minus
the incoming angle of a squirmer's orientation, projected on the x-y plane; it may exceed 360 degrees. Outgoing means at
infinite distance if the pair parts without gravity, and at the end of the run otherwise.

The words for outcomes are those of the columns of [fates.csv](#fatescsv). In addition, `contact` means that the spheres
touched, `unresolved` that the gap became too small for the model, `failed` that the run failed, and `skipped` that the
time limit left it out. `NaN` stands for a number that does not exist: runs with one of these four outcomes have no
deflections.
";

/// The text of `docs/COLUMNS.md`.
#[must_use]
pub fn page() -> String {
    let mut page = INTRODUCTION.to_owned();
    let _ = writeln!(page, "\n| unit | meaning |\n|---|---|");
    for (unit, meaning) in UNITS {
        let _ = writeln!(page, "| `{unit}` | {meaning} |");
    }
    let _ = writeln!(page, "\n| method | meaning |\n|---|---|");
    for method in Method::ALL {
        let _ = writeln!(page, "| `{method}` | {} |", method.title());
    }
    for (place, file) in FILES.iter().enumerate() {
        let commands: Vec<_> = (file.commands.iter())
            .map(|command| format!("`squirmers {command}`"))
            .collect();
        let _ = writeln!(
            page,
            "\n## {}\n\n{} Written by {}.",
            file.name,
            file.holds,
            commands.join(" and ")
        );
        let alike = (FILES[..place].iter()).find(|earlier| earlier.columns == file.columns);
        if let Some(earlier) = alike {
            let anchor = earlier.name.replace('.', "");
            let _ = writeln!(page, "It has the columns of [{}](#{anchor}).", earlier.name);
            continue;
        }
        let _ = writeln!(
            page,
            "{}\n\n| name | unit | meaning |\n|---|---|---|",
            file.about
        );
        for Column { name, unit, doc } in file.columns {
            let _ = writeln!(page, "| `{name}` | `{unit}` | {doc} |");
        }
    }
    page
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_describes_the_columns_as_they_are() {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/COLUMNS.md");
        let kept = std::fs::read_to_string(file).unwrap();
        assert!(
            kept == page(),
            "docs/COLUMNS.md is out of date: renew it by \
             `cargo run -p squirmers-compare --example columns > docs/COLUMNS.md`"
        );
    }

    #[test]
    fn every_column_has_a_known_unit_and_a_meaning_that_fits_a_table() {
        for file in FILES {
            for column in file.columns {
                let named = format!("{}, {}", file.name, column.name);
                assert!(
                    UNITS.iter().any(|(unit, _)| *unit == column.unit),
                    "{named}"
                );
                assert!(
                    column.doc.ends_with('.') && !column.doc.contains('|'),
                    "{named}"
                );
                // The classes of trust are shares, which are named by their limits in degrees.
                let angle = column.name.ends_with("_deg")
                    && !["trust-offset.csv", "ratios.csv"].contains(&file.name);
                assert!(!angle || column.unit == "deg", "{named}");
            }
        }
    }

    #[test]
    fn every_file_is_listed_once() {
        let mut names = FILES.map(|file| file.name);
        names.sort_unstable();
        assert!(names.windows(2).all(|pair| pair[0] < pair[1]), "{names:?}");
    }
}
