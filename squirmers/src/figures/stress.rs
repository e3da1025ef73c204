//! Stresslets, power and efficiency: along a run, and against the gap.

use std::collections::BTreeSet;

use super::canvas::{Axes, Axis, Entry, Key, Layout};
use super::range::{decades, extremes, padded};
use super::style::{Dash, INK, Stroke, colour};
use super::{FigureError, distinct, methods};
use compare::Method;
use compare::study::stress::{StressRow, StressRunRow};

/// Size of a panel.
const PLOT: (f64, f64) = (300.0, 220.0);

/// Columns of panels.
const COLUMNS: usize = 3;

/// Components of a stresslet, and powers: their names in legends.
const COMPONENTS: [&str; 5] = ["xx", "xy", "xz", "yy", "yz"];
const POWERS: [&str; 4] = [
    "slip of 1",
    "slip of 2",
    "repulsion, gravity",
    "dissipation",
];

/// Values smaller than this share of the largest are zero but for rounding.
const NOISE: f64 = 1e-9;

/// A panel over time: title, title of its axis, and its lines.
struct Over {
    title: &'static str,
    unit: &'static str,
    lines: Vec<fn(&StressRunRow) -> f64>,
}

/// Draws the rows of a run, by one method or several.
///
/// # Errors
/// [`FigureError::Empty`] if there are no rows.
pub fn stress_run(rows: &[StressRunRow]) -> Result<String, FigureError> {
    let Some(end) = extremes(rows.iter().map(|row| row.t)) else {
        return Err(FigureError::Empty { what: "no samples" });
    };
    let methods = methods(rows.iter().map(|row| row.method));
    let panels = over_time();
    // What is zero throughout, as in a plane, is not in the legend.
    let shown: Vec<usize> = (0..COMPONENTS.len())
        .filter(|&k| {
            panels[..COLUMNS]
                .iter()
                .any(|panel| is_drawn(panel, k, rows))
        })
        .collect();
    let components = shown.iter().map(|&k| entry(k, COMPONENTS[k]));
    let powers = POWERS.iter().enumerate().map(|(k, name)| entry(k, name));
    let by = |(index, method): (usize, &Method)| -> Entry {
        let stroke = Stroke::new(INK, 1.6, Dash::of(index));
        (Key::Line(stroke), method.title().to_owned())
    };
    let legend = [
        components.collect::<Vec<_>>(),
        powers.collect(),
        methods.iter().enumerate().map(by).collect(),
    ];
    let layout = Layout::new(PLOT, COLUMNS, 2);
    let mut canvas = layout.canvas("Stresslets and power of a pair", &legend);
    let time = Axis::new(&(0.0..end.1), "time (a/Vs)", 7);
    for (place, panel) in panels.iter().enumerate() {
        let values = panel.lines.iter().flat_map(|of| rows.iter().map(of));
        let axes = Axes {
            title: panel.title.to_owned(),
            x: time.clone(),
            y: Axis::new(&padded(values.chain([0.0]), 0.06, NOISE), panel.unit, 7),
        };
        let corner = layout.corner(place % COLUMNS, place / COLUMNS);
        canvas.panel(corner, layout.plot, axes, |drawn| {
            drawn.zero_line();
            for (k, of) in panel.lines.iter().enumerate() {
                if is_drawn(panel, k, rows) {
                    for (index, &method) in methods.iter().enumerate() {
                        drawn.path(&over(rows, method, of), stroke(k, index));
                    }
                }
            }
        });
    }
    let gap = |row: &StressRunRow| row.gap.max(f64::MIN_POSITIVE).log10();
    let axes = Axes {
        title: "Gap".to_owned(),
        x: time,
        y: Axis::powers(&decades(rows.iter().map(gap)), "gap ε (radii a)", 6),
    };
    canvas.panel(layout.corner(2, 1), layout.plot, axes, |drawn| {
        for (index, &method) in methods.iter().enumerate() {
            let stroke = Stroke::new(INK, 1.6, Dash::of(index));
            drawn.path(&over(rows, method, &gap), stroke);
        }
    });
    Ok(canvas.finish())
}

/// The panels over time but for the gap.
fn over_time() -> [Over; 5] {
    [
        Over {
            title: "Pair less two lone squirmers",
            unit: "excess stresslet (μ a² Vs)",
            lines: vec![
                |row| row.excess_xx,
                |row| row.excess_xy,
                |row| row.excess_xz,
                |row| row.excess_yy,
                |row| row.excess_yz,
            ],
        },
        Over {
            title: "Squirmer 1",
            unit: "stresslet (μ a² Vs)",
            lines: vec![
                |row| row.s1_xx,
                |row| row.s1_xy,
                |row| row.s1_xz,
                |row| row.s1_yy,
                |row| row.s1_yz,
            ],
        },
        Over {
            title: "Squirmer 2",
            unit: "stresslet (μ a² Vs)",
            lines: vec![
                |row| row.s2_xx,
                |row| row.s2_xy,
                |row| row.s2_xz,
                |row| row.s2_yy,
                |row| row.s2_yz,
            ],
        },
        Over {
            title: "Power",
            unit: "power (μ a Vs²)",
            lines: vec![
                |row| row.slip_power1,
                |row| row.slip_power2,
                |row| row.external_power,
                |row| row.dissipation,
            ],
        },
        Over {
            title: "Efficiency of 1 and 2",
            unit: "efficiency",
            lines: vec![|row| row.efficiency1, |row| row.efficiency2],
        },
    ]
}

/// Whether a line of a panel is more than rounding.
fn is_drawn(panel: &Over, line: usize, rows: &[StressRunRow]) -> bool {
    let largest =
        |of: &fn(&StressRunRow) -> f64| rows.iter().map(|row| of(row).abs()).fold(0.0, f64::max);
    let scale = panel.lines.iter().map(largest).fold(0.0, f64::max);
    largest(&panel.lines[line]) > NOISE * scale
}

fn over(
    rows: &[StressRunRow],
    method: Method,
    of: &dyn Fn(&StressRunRow) -> f64,
) -> Vec<(f64, f64)> {
    let mine = rows.iter().filter(|row| row.method == method);
    mine.map(|row| (row.t, of(row))).collect()
}

/// A panel against the gap: title, beginnings of the names of what it shows, and whether both axes are logarithmic.
type Against = (&'static str, &'static [&'static str], bool);

const AGAINST: [Against; 6] = [
    ("XG: along the line, by velocity", &["XG"], true),
    ("YG, YH: across, by velocity and spin", &["YG", "YH"], false),
    ("XS: order 0, by slip", &["XS"], false),
    ("YS: order 1, by slip", &["YS"], false),
    ("ZS: order 2, by slip", &["ZS"], false),
    (
        "XP, YP, ZP: rates of work of mode 2",
        &["XP", "YP", "ZP"],
        false,
    ),
];

/// Lines in a panel, at most.
const LINES: usize = 8;

/// Draws stresslets and rates of work of one ratio of the radii against the gap.
///
/// # Errors
/// [`FigureError::Empty`] if there are fewer than two gaps.
pub fn stress_by_gap(rows: &[StressRow]) -> Result<String, FigureError> {
    let gaps = distinct(rows.iter().map(|row| row.gap));
    let (Some(least), Some(most), true) = (gaps.first(), gaps.last(), gaps.len() > 1) else {
        return Err(FigureError::Empty { what: "one gap" });
    };
    let methods = methods(rows.iter().map(|row| row.method));
    let x = least.log10()..most.log10();
    let panels = AGAINST.map(|(title, kinds, is_log)| (title, names(rows, kinds), is_log));
    let legend: Vec<Vec<Entry>> = panels
        .iter()
        .map(|(_, names, _)| {
            let entries = names.iter().enumerate();
            entries.map(|(k, name)| entry(k, name)).collect()
        })
        .collect();
    let layout = Layout::new(PLOT, COLUMNS, 2);
    let mut canvas = layout.canvas("Stresslets and rates of work near contact", &legend);
    for (place, (title, names, is_log)) in panels.iter().enumerate() {
        let shown = |row: &StressRow| {
            if *is_log {
                row.value.abs().log10()
            } else {
                row.value
            }
        };
        let of = |name: &str, method: Method| -> Vec<(f64, f64)> {
            let mut points: Vec<_> = (rows.iter())
                .filter(|row| row.name == name && row.method == method)
                .map(|row| (row.gap.log10(), shown(row)))
                .collect();
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            points
        };
        let values = rows
            .iter()
            .filter(|row| names.contains(&row.name.as_str()))
            .map(shown);
        let y = if *is_log {
            Axis::powers(&decades(values), "size", 6)
        } else {
            Axis::new(&padded(values, 0.06, NOISE), "value", 7)
        };
        let axes = Axes {
            title: (*title).to_owned(),
            x: Axis::powers(&x, "gap ε (radii a)", 6),
            y,
        };
        let corner = layout.corner(place % COLUMNS, place / COLUMNS);
        canvas.panel(corner, layout.plot, axes, |panel| {
            for (k, name) in names.iter().enumerate() {
                for (index, &method) in methods.iter().enumerate() {
                    panel.path(&of(name, method), stroke(k, index));
                }
            }
        });
    }
    Ok(canvas.finish())
}

/// The names that a panel shows: of rates of work those of mode 2 with itself.
fn names<'a>(rows: &'a [StressRow], kinds: &[&str]) -> Vec<&'a str> {
    let mut seen = BTreeSet::new();
    (rows.iter().map(|row| row.name.as_str()))
        .filter(|name| kinds.iter().any(|kind| name.starts_with(kind)))
        .filter(|name| !name.contains("P") || name.ends_with("_2_2"))
        .filter(|name| seen.insert(*name))
        .take(LINES)
        .collect()
}

fn entry(series: usize, name: &str) -> Entry {
    (Key::Line(stroke(series, 0)), name.to_owned())
}

/// Colours tell what is drawn, dashes which method. The first line is wider, so that it shows under an equal one.
fn stroke(series: usize, method: usize) -> Stroke {
    let width = if series == 0 { 3.6 } else { 1.8 };
    Stroke::new(colour(series), width, Dash::of(method))
}
