//! The template of the page.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::table::displayed;
use super::{Figure, MethodCost, Page, Provenance, Section, Table};

const STYLE: &str = include_str!("page.css");

/// Smallest width of a picture on a narrow screen, as a share of its own width. Below it the picture scrolls.
const SMALLEST_SHARE: f64 = 0.72;

/// Largest number of rows that are shown at once; longer tables are opened by a click.
const LONG: usize = 16;

/// Largest CSV, in bytes, that the page contains. The page links to the file of a larger one.
const MOST_EMBEDDED: usize = 1 << 20;

/// The page as one HTML file that loads no other files.
#[must_use]
pub fn render(page: &Page) -> String {
    let costs = (!page.costs.is_empty()).then(|| Section {
        id: "cost".to_owned(),
        title: "How long each method took".to_owned(),
        prose: vec![COST_PROSE.to_owned()],
        tables: vec![MethodCost::table(&page.costs)],
        ..Section::default()
    });
    let sections: Vec<&Section> = page.sections.iter().chain(&costs).collect();
    let markup = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (page.title) }
                link rel="icon" href="data:,";
                style { (PreEscaped(STYLE)) }
            }
            body {
                main {
                    h1 { (page.title) }
                    @for paragraph in &page.lead { p { (paragraph) } }
                    (findings(&sections))
                    @if sections.len() > 1 {
                        nav aria-label="Contents" {
                            h2 { "Contents" }
                            ul {
                                @for section in &sections {
                                    li { a href={ "#" (section.id) } { (section.title) } }
                                }
                                @if !page.notes.is_empty() { li { a href="#notes" { "Notes" } } }
                            }
                        }
                    }
                    @for section in &sections { (self::section(section)) }
                    @if !page.notes.is_empty() {
                        section id="notes" {
                            h2 { "Notes" }
                            ul { @for note in &page.notes { li { (note) } } }
                        }
                    }
                }
                (footer(&page.provenance))
            }
        }
    };
    markup.into_string()
}

const COST_PROSE: &str = "Times are wall-clock times in seconds. Set-up is the time to build a method's table; \
    a run is one encounter with a finished table. Errors are relative errors, estimated by each \
    method: of the interpolation in the table (of velocities by unit slip), and of the loads at gaps near contact.";

/// The finding of each section, with a link to the section.
fn findings(sections: &[&Section]) -> Markup {
    let found: Vec<_> = (sections.iter())
        .filter(|section| !section.finding.is_empty())
        .collect();
    html! {
        @if !found.is_empty() {
            section id="findings" {
                h2 { "What was found" }
                ul {
                    @for section in found {
                        li { a href={ "#" (section.id) } { (section.title) } ": " (section.finding) }
                    }
                }
            }
        }
    }
}

fn section(section: &Section) -> Markup {
    html! {
        section id=(section.id) {
            h2 { (section.title) }
            @if !section.finding.is_empty() { p.finding { (section.finding) } }
            @for paragraph in &section.prose { p { (paragraph) } }
            @for figure in &section.figures { (self::figure(figure)) }
            @for table in &section.tables { (self::table(table)) }
        }
    }
}

fn figure(figure: &Figure) -> Markup {
    let svg = figure
        .svg
        .find("<svg")
        .map_or("", |start| &figure.svg[start..]);
    let smallest = width(svg).map(|width| format!("min-width:{:.0}px", SMALLEST_SHARE * width));
    let svg = match smallest {
        Some(style) => svg.replacen("<svg ", &format!("<svg style=\"{style}\" "), 1),
        None => svg.to_owned(),
    };
    html! {
        figure {
            div.wide.picture tabindex="0" { (PreEscaped(svg)) }
            figcaption { (figure.caption) }
        }
    }
}

/// The width of an SVG, from its own attribute.
fn width(svg: &str) -> Option<f64> {
    let header = svg.split_once('>')?.0;
    header
        .split_once(" width=\"")?
        .1
        .split_once('"')?
        .0
        .parse()
        .ok()
}

fn table(table: &Table) -> Markup {
    let numeric: Vec<bool> = (0..table.headers.len())
        .map(|i| table.is_numeric(i))
        .collect();
    let class = |i: usize| numeric.get(i).is_some_and(|n| *n).then_some("number");
    let embedded = table.csv.len() <= MOST_EMBEDDED;
    let rows = html! {
        div.wide tabindex="0" {
            table {
                thead {
                    tr {
                        @for (i, header) in table.headers.iter().enumerate() {
                            th scope="col" class=[class(i)] { (header) }
                        }
                    }
                }
                tbody {
                    @for record in &table.records {
                        tr {
                            @for (i, (header, field)) in
                                table.headers.iter().zip(record).enumerate()
                            {
                                td class=[class(i)] { (displayed(header, field)) }
                            }
                        }
                    }
                }
            }
        }
    };
    html! {
        div.table {
            p {
                (table.caption) " · "
                @if embedded {
                    @let data = BASE64_STANDARD.encode(&table.csv);
                    a download=(table.file_name) href={ "data:text/csv;charset=utf-8;base64," (data) } {
                        (table.file_name)
                    }
                } @else {
                    a href=(table.file_name) { (table.file_name) }
                    " (a large file beside this page)"
                }
            }
            @if table.records.len() > LONG {
                details {
                    summary { "Show the " (table.records.len()) " rows" }
                    (rows)
                }
            } @else {
                (rows)
            }
        }
    }
}

fn footer(provenance: &Provenance) -> Markup {
    html! {
        footer {
            dl {
                dt { "Command" } dd { code { (provenance.command) } }
                dt { "Version" } dd { (provenance.version) }
                dt { "Machine" } dd { (provenance.machine) }
                dt { "Threads" } dd { (provenance.threads) }
                dt { "Date" } dd { (provenance.date) }
                dt { "Total time" } dd { (provenance.total_time) }
            }
        }
    }
}
