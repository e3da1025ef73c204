//! `squirmers judge`: anybody's models against exact hydrodynamics, with a verdict in words.

use std::time::{Duration, Instant};

use clap::Args;
use compare::judge::{
    GAPS, JudgeRow, Judged, LeaderRow, Options, Scorecard, judge, mover, referee,
};
use compare::numbers::{parse_number, parse_whole, rounded};
use compare::output::csv_text;
use compare::study::maps::Grid;
use compare::submission::Submitted;
use compare::{CompareError, Method};
use serde::Serialize;

use crate::arguments::GeneralArguments;
use crate::error::CommandError;
use crate::page::{Figure, Page, Section, Table, render};
use crate::pictures::{self, Picture};
use crate::streams::print_line;
use crate::{figures, provenance};

/// Points a side of the grid of incoming angles.
const GRID: usize = 20;

#[derive(Debug, Args)]
pub(crate) struct JudgeArguments {
    /// Models: NAME=FILE, or NAME=exec:COMMAND for a process that answers (docs/JUDGE.md)
    #[arg(value_name = "NAME=FILE", required = true)]
    submissions: Vec<String>,
    /// Points a side of the grid of incoming angles, for the shares of outcomes; 0 leaves all collisions out
    #[arg(long, value_name = "N", default_value_t = GRID, value_parser = parse_whole, allow_hyphen_values = true)]
    grid: usize,
    /// Seconds that a process has for an answer
    #[arg(long, value_name = "SECONDS", default_value = "60", value_parser = parse_number, allow_hyphen_values = true)]
    answer_limit: f64,
    /// Print all as JSON instead of the verdict in words
    #[arg(long)]
    json: bool,
}

pub(super) fn run(
    arguments: &JudgeArguments,
    general: &GeneralArguments,
    typed: &[String],
) -> Result<(), CommandError> {
    let started = Instant::now();
    let limit = Duration::try_from_secs_f64(arguments.answer_limit)
        .ok()
        .filter(|limit| !limit.is_zero());
    let limit = limit.ok_or_else(|| {
        let allowed = "give a number of seconds greater than 0";
        CommandError::input("--answer-limit", arguments.answer_limit, allowed)
    })?;
    let grid = match arguments.grid {
        0 => None,
        points => Some(Grid::new(points)?),
    };
    let mut submissions: Vec<(&str, Submitted)> = Vec::new();
    for text in &arguments.submissions {
        let refused = |allowed: String| CommandError::input("judge", text, allowed);
        let (name, source) = text
            .split_once('=')
            .ok_or_else(|| refused("give NAME=FILE, or NAME=exec:COMMAND".to_owned()))?;
        if submissions.iter().any(|(other, _)| *other == name) {
            return Err(refused(
                "the name is there twice: give each model its own".to_owned(),
            ));
        }
        let checked = Method::check(name);
        checked.map_err(|error| match error {
            CompareError::Input { allowed, .. } => refused(allowed),
            other => other.into(),
        })?;
        let submitted = Submitted::open(source, limit);
        let submitted =
            submitted.map_err(|error| CommandError::input("judge", name, error.to_string()))?;
        submissions.push((name, submitted));
    }
    let movers = (submissions.iter())
        .map(|(name, submitted)| match grid {
            Some(_) => Ok(mover(name, submitted)?),
            // Nothing is asked between the gaps at which it is judged.
            None => Ok(Err("not asked for".to_owned())),
        })
        .collect::<Result<Vec<_>, CommandError>>()?;
    let out = general.output()?;
    let exact = referee(&general.model_options())?;
    let options = Options { grid, gaps: &GAPS };
    let mut cards = Vec::new();
    for ((name, submitted), mover) in submissions.iter().zip(&movers) {
        let theirs = mover.as_ref().map_err(String::clone);
        cards.push(judge(name, submitted, theirs, &exact, &options)?);
    }
    let rows: Vec<JudgeRow> = cards.iter().flat_map(Scorecard::rows).collect();
    out.write("judge.csv", &csv_text(&rows)?)?;
    let errors: Vec<_> = cards.iter().flat_map(Scorecard::curves).collect();
    let picture = figures::judged_errors(&errors)?;
    out.write("judge.svg", &picture)?;
    let mut pictures_of_all = vec![Figure {
        svg: picture,
        caption: "Largest error of each group of numbers.".to_owned(),
    }];
    // Of models that state their time and have all scalars.
    let scores: Vec<LeaderRow> = cards.iter().map(LeaderRow::of).collect();
    if let Some(picture) = pictures::of_scores(&scores)? {
        out.write(&picture.file_name, &picture.svg)?;
        pictures_of_all.push(Figure {
            svg: picture.svg,
            caption: "Largest error of a resistance scalar against the time of one gap, as stated or measured."
                .to_owned(),
        });
    }
    let mut maps = Vec::new();
    for card in &cards {
        let rows = card
            .collisions
            .as_ref()
            .map_or(&[][..], |collisions| &collisions.maps);
        let pictures = pictures::of_trust(rows)?;
        for picture in &pictures {
            out.write(&picture.file_name, &picture.svg)?;
        }
        maps.push(pictures);
    }
    let page = page(
        &cards,
        &rows,
        (pictures_of_all, maps),
        provenance::of(typed, started.elapsed().as_secs_f64()),
    )?;
    let path = out.write("judge.html", &page)?;
    if arguments.json {
        let all: Vec<Judged<'_>> = cards.iter().map(Scorecard::judged).collect();
        let text = serde_json::to_string_pretty(&all)
            .map_err(|error| CommandError::input("--json", "output", error.to_string()))?;
        print_line!("{text}");
    } else {
        for card in &cards {
            for line in card.verdict() {
                print_line!("{}", wrapped(&line));
            }
            print_line!("");
        }
        print_line!("{}", path.display());
    }
    Ok(out.account().verdict()?)
}

/// A line broken to the width of a terminal, with what follows indented.
fn wrapped(line: &str) -> String {
    const WIDTH: usize = 80;
    let mut text = String::new();
    let mut width = 0;
    for word in line.split(' ') {
        let length = word.chars().count();
        if width > 0 && width + 1 + length > WIDTH {
            text.push_str("\n  ");
            width = 2;
        } else if width > 0 {
            text.push(' ');
            width += 1;
        }
        text.push_str(word);
        width += length;
    }
    text
}

/// One self-contained page.
fn page(
    cards: &[Scorecard],
    rows: &[JudgeRow],
    (figures, maps): (Vec<Figure>, Vec<Vec<Picture>>),
    provenance: crate::page::Provenance,
) -> Result<String, CommandError> {
    let mut sections = vec![Section {
        id: "errors".to_owned(),
        title: "Errors against the gap".to_owned(),
        prose: vec![
            "An error is divided by the larger of the exact number and its value of a lone sphere; that of an approach speed by the exact speed. Marks are \
             at the model's own gaps; lines between them follow its own interpolation where it declares one."
                .to_owned(),
        ],
        figures,
        ..Section::default()
    }];
    for ((place, card), maps) in cards.iter().enumerate().zip(maps) {
        let header = &card.header;
        let stated = [
            ("Version", &header.version),
            ("Citation", &header.citation),
            ("Call", &header.call),
            ("Machine", &header.machine),
        ];
        let stated = stated
            .into_iter()
            .filter_map(|(key, text)| Some(format!("{key}: {}.", text.as_deref()?)));
        let time = card.seconds_per_gap.map(|seconds| {
            format!(
                "One gap takes {} s; exact loads take {} s here.",
                compare::numbers::size(seconds),
                compare::numbers::size(card.exact_seconds_per_gap)
            )
        });
        let verdict = card.verdict();
        let (finding, prose) = verdict
            .split_first()
            .map_or((String::new(), &[][..]), |(first, rest)| {
                (first.clone(), rest)
            });
        let mine: Vec<&JudgeRow> = rows.iter().filter(|row| row.model == card.name).collect();
        let shown: Vec<&JudgeRow> = (mine.iter().copied())
            .filter(|row| {
                ![
                    "error",
                    "relative_error",
                    "raw_error",
                    "raw_relative_error",
                    "error_between",
                    "relative_error_between",
                ]
                .contains(&row.measure)
            })
            .collect();
        let caption = "What was measured. Errors at each gap are in judge.csv.";
        sections.push(Section {
            id: format!("model-{}", place + 1),
            title: header
                .title()
                .map_or(card.name.clone(), |title| format!("{}: {title}", card.name)),
            finding,
            prose: prose.iter().cloned().chain(stated).chain(time).collect(),
            figures: (maps.into_iter())
                .map(|picture| Figure {
                    svg: picture.svg,
                    caption: "Where the model's outcomes and deflections differ from exact ones, over the incoming angles."
                        .to_owned(),
                })
                .collect(),
            tables: vec![
                errors_table(card)?,
                Table::from_rows(caption, &format!("judge-{}.csv", card.name), &shown)?,
            ],
        });
    }
    Ok(render(&Page {
        title: "Models judged against exact hydrodynamics".to_owned(),
        lead: vec![
            "Each model answers for two equal spheres in a Stokes fluid. Its numbers are compared with those of an exact series, then its laws, then the collisions that follow from it."
                .to_owned(),
        ],
        sections,
        provenance,
        ..Page::default()
    }))
}

/// A line of the table of errors.
#[derive(Serialize)]
struct ErrorLine {
    quantity: String,
    from: &'static str,
    error_percent_2: String,
    error_percent_05: String,
    error_percent_01: String,
    error_percent_001: String,
    worst_percent: String,
}

/// Errors at a few gaps, each relative to the exact number alone.
fn errors_table(card: &Scorecard) -> Result<Table, CommandError> {
    let mut items = Vec::new();
    for point in &card.points {
        if !items.contains(&point.item) {
            items.push(point.item);
        }
    }
    let lines: Vec<ErrorLine> = (items.iter())
        .map(|item| {
            let of_item = || card.points.iter().filter(|point| point.item == *item);
            let at = |gap: f64| {
                let here = of_item().find(|point| (point.gap / gap - 1.0).abs() < 1e-9);
                here.map_or("none".to_owned(), |point| {
                    rounded(point.relative_percent(), 4)
                })
            };
            let worst = of_item()
                .map(|point| point.error().abs())
                .fold(0.0, f64::max);
            ErrorLine {
                quantity: item.to_string(),
                from: if of_item().all(|point| point.given) {
                    "given"
                } else {
                    "derived"
                },
                error_percent_2: at(2.0),
                error_percent_05: at(0.5),
                error_percent_01: at(0.1),
                error_percent_001: at(0.01),
                worst_percent: rounded(100.0 * worst, 4),
            }
        })
        .collect();
    let caption = "Errors in per cent of the exact number at gaps 2, 0.5, 0.1 and 0.01; in the last column the largest error at any gap, in per cent of the larger of \
                   the exact number and its value of a lone sphere.";
    Ok(Table::from_rows(
        caption,
        &format!("errors-{}.csv", card.name),
        &lines,
    )?)
}
