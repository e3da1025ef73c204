//! How an offset out of the plane grows, over the plane of initial directions.

use super::canvas::{
    ABOVE, Axes, Axis, Canvas, Entry, Key, LEFT, Layout, Map, MapCell, whole_side,
};
use super::map::outcome_fill;
use super::style::{Colour, Fill, Hatch};
use super::{FigureError, heat, methods, number, same};
use compare::Method;
use compare::study::maps::GrowthRow;

/// Approximate side of a map, in nominal pixels: two and a colour bar are still read on a telephone.
const SIDE: f64 = 220.0;

/// Maps beside each other, at most.
const COLUMNS: usize = 2;

/// Room for a colour bar with the powers of ten and its title.
const BAR_ROOM: f64 = 84.0;

/// Powers of ten at the ends of the colour scale, of the growth in radians per radius.
const POWERS: std::ops::RangeInclusive<i32> = -1..=3;

/// What a point is, where it has no colour of the scale.
const STAYS: Fill = Fill::new(Colour(235, 235, 235), Hatch::Rising);
const STAYS_IN_THE_PLANE: Fill = Fill::new(Colour(213, 94, 0), Hatch::Falling);
const UNDEFINED: Fill = Fill::new(Colour(120, 120, 120), Hatch::Crossed);

/// Fills without a growth of their own, in the order of the legend.
const FILLS: [Fill; 4] = [STAYS, STAYS_IN_THE_PLANE, UNDEFINED, outcome_fill(None)];

/// One map, ready to be drawn.
pub struct GrowthMap {
    method: Method,
    beta: f64,
    map: Map,
    points: usize,
    /// Which of [`FILLS`] occur.
    occurs: [bool; FILLS.len()],
}

/// The colour of a growth, in radians per radius.
fn colour(growth: f64) -> Colour {
    let (low, high) = (f64::from(*POWERS.start()), f64::from(*POWERS.end()));
    heat::sequential((growth.log10() - low) / (high - low))
}

/// Index in [`FILLS`] of a point without a colour of the scale.
fn special(row: &GrowthRow, offset: f64) -> Option<usize> {
    if row.failed() {
        Some(3)
    } else if !row.is_known() {
        Some(2)
    } else if row.parts() {
        None
    } else {
        Some(usize::from(row.is_fiction(offset)))
    }
}

impl GrowthMap {
    /// From the rows of a grid, with `Delta` varying fastest; the offset out of the plane, in radii, tells which bound pairs stay near it.
    ///
    /// # Errors
    /// [`FigureError`] if there are no rows, or if they are not a square grid.
    pub fn new(rows: &[GrowthRow], offset: f64) -> Result<Self, FigureError> {
        let first = (rows.first()).ok_or(FigureError::Empty { what: "no map" })?;
        let mut occurs = [false; FILLS.len()];
        let cells = rows.iter().map(|row| {
            let special = special(row, offset);
            if let Some(index) = special {
                occurs[index] = true;
            }
            let scale = || Fill::new(colour(row.growth), Hatch::Plain);
            MapCell {
                fill: special.map_or_else(scale, |index| FILLS[index]),
                is_data: special.is_none_or(|index| index < 2),
            }
        });
        let map = Map::new(&cells.collect::<Vec<_>>())?;
        Ok(Self {
            method: first.method,
            beta: first.beta,
            map,
            points: rows.len().isqrt(),
            occurs,
        })
    }
}

/// Draws the maps, those of one squirmer parameter together. The `offset` out of the plane, in radii, is that of the maps.
///
/// # Errors
/// [`FigureError::Empty`] without maps.
pub fn growth(maps: &[GrowthMap], offset: f64) -> Result<String, FigureError> {
    let first = (maps.first()).ok_or(FigureError::Empty { what: "no map" })?;
    let side = whole_side(SIDE, first.points);
    let mut betas: Vec<f64> = Vec::new();
    for map in maps {
        if !betas.iter().any(|beta| same(*beta, map.beta)) {
            betas.push(map.beta);
        }
    }
    let columns = methods(maps.iter().map(|map| map.method))
        .len()
        .min(COLUMNS);
    // Each parameter begins a row of its own.
    let of = |beta: f64| maps.iter().filter(move |map| same(map.beta, beta));
    let rows: Vec<Vec<&GrowthMap>> = (betas.iter())
        .flat_map(|&beta| {
            let maps: Vec<_> = of(beta).collect();
            maps.chunks(columns).map(<[_]>::to_vec).collect::<Vec<_>>()
        })
        .collect();
    let layout = Layout::new((side, side), columns, rows.len());
    let (right, below) = layout.corner(columns, rows.len());
    let width = (right - LEFT + BAR_ROOM).max(420.0);
    let title = "Growth of an offset out of the plane";
    let mut canvas = Canvas::new(title, (width, below - ABOVE + 8.0), &legend(maps, offset));
    for (row, maps) in rows.iter().enumerate() {
        for (column, map) in maps.iter().enumerate() {
            let axes = Axes {
                title: format!("{}, β = {}", map.method, number(map.beta)),
                x: Axis::new(&(0.0..2.0), "difference of angles, Δ (π)", 5),
                y: Axis::new(&(0.0..2.0), "sum of angles, Σ (π)", 5),
            };
            let corner = layout.corner(column, row);
            canvas.panel(corner, (side, side), axes, |panel| panel.map(&map.map));
        }
        let (x, y) = layout.corner(maps.len(), row);
        bar(&mut canvas, (x - LEFT, y), side);
    }
    Ok(canvas.finish())
}

/// The colour bar, with its title.
fn bar(canvas: &mut Canvas, corner: (f64, f64), height: f64) {
    let (low, high) = (*POWERS.start(), *POWERS.end());
    let share = |power: i32| f64::from(power - low) / f64::from(high - low);
    let power = |share: f64| f64::from(low) + share * f64::from(high - low);
    let labels: Vec<_> = POWERS
        .map(|p| {
            let limit = match p {
                p if p == low => "≤ ",
                p if p == high => "≥ ",
                _ => "",
            };
            (share(p), format!("{limit}{}", number(10f64.powi(p))))
        })
        .collect();
    let scale = |share: f64| colour(10f64.powf(power(share)));
    heat::labelled_bar(canvas, (corner, height), scale, &labels);
    let middle = (corner.0 + 70.0, corner.1 + 0.5 * height);
    canvas.text(
        "growth (rad/a)",
        middle,
        super::canvas::TEXT,
        super::canvas::Anchor::Upright,
    );
}

/// What has no colour of the scale, as far as it occurs.
fn legend(maps: &[GrowthMap], offset: f64) -> Vec<Vec<Entry>> {
    let limit = number(1.0 / offset);
    let names = [
        format!("does not part, growth ≤ {limit} rad/a"),
        format!("does not part, growth > {limit} rad/a"),
        "undefined".to_owned(),
        "failed".to_owned(),
    ];
    let occurs = |index: usize| maps.iter().any(|map| map.occurs[index]);
    let entries = (names.into_iter().zip(FILLS).enumerate()).filter(|(index, _)| occurs(*index));
    // Each on a line of its own: they are long.
    let lines = entries.map(|(_, (name, fill))| vec![(Key::Patch(fill), name)]);
    lines.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::canvas::BELOW;
    use crate::figures::style::lightness;

    fn row(outcome: &str, status: &str, growth: f64) -> GrowthRow {
        GrowthRow {
            method: Method::Lt,
            beta: 5.0,
            delta: 0.5,
            sigma: 0.5,
            outcome: outcome.to_owned(),
            tilt1_per_dz: growth,
            tilt2_per_dz: growth,
            growth,
            exponent: f64::NAN,
            truncation: 0.0,
            status: status.to_owned(),
        }
    }

    #[test]
    fn what_has_no_growth_is_told_from_what_has_one_by_its_hatch() {
        for (i, a) in FILLS.iter().enumerate() {
            assert!(a.hatch != Hatch::Plain, "{a:?}");
            for b in &FILLS[..i] {
                let apart = (lightness(a.colour) - lightness(b.colour)).abs();
                assert!(a.hatch != b.hatch || apart >= 10.0, "{a:?} {b:?}");
            }
        }
    }

    #[test]
    fn pairs_that_stay_near_the_plane_are_told_from_those_that_leave_it() {
        let fill =
            |outcome: &str, status: &str, growth| special(&row(outcome, status, growth), 0.1);
        assert_eq!(fill("scattered", "known", 30.0), None);
        assert_eq!(fill("pairwise", "known", 9.0), Some(0));
        assert_eq!(fill("pairwise", "known", 11.0), Some(1));
        assert_eq!(fill("scattered", "grazing", f64::NAN), Some(2));
        assert_eq!(fill("failed", "failed", f64::NAN), Some(3));
    }

    #[test]
    fn larger_growth_is_darker() {
        let scale = [0.01, 0.1, 1.0, 10.0, 100.0, 1e3, 1e6].map(|g| lightness(colour(g)));
        assert!(scale.windows(2).all(|pair| pair[0] >= pair[1]), "{scale:?}");
        assert!(scale[1] - scale[5] > 50.0, "{scale:?}");
        assert_eq!(colour(0.0), colour(0.1));
    }

    #[test]
    fn the_legend_names_what_occurs_with_the_limit_of_the_offset() {
        let rows = [
            row("scattered", "known", 3.0),
            row("pairwise", "known", 30.0),
            row("pairwise", "known", 3.0),
            row("scattered", "grazing", f64::NAN),
        ];
        let maps = [GrowthMap::new(&rows, 0.1).unwrap()];
        let svg = growth(&maps, 0.1).unwrap();
        for named in [
            "≤ 10 rad/a",
            "&gt; 10 rad/a",
            "undefined",
            "lt, β = 5",
            "growth (rad/a)",
        ] {
            assert!(svg.contains(named), "{named}");
        }
        assert!(!svg.contains("failed") && !svg.contains("NaN"));
        assert!(growth(&[], 0.1).is_err() && GrowthMap::new(&[], 0.1).is_err());
    }

    #[test]
    fn three_methods_stand_in_two_columns_and_a_parameter_begins_a_row() {
        let of = |method: Method, beta: f64| {
            let row = GrowthRow {
                method,
                beta,
                ..row("scattered", "known", 3.0)
            };
            GrowthMap::new(&[row], 0.1).unwrap()
        };
        let maps: Vec<_> = [Method::Lt, Method::Exact, Method::Bem]
            .into_iter()
            .flat_map(|method| [1.0, 5.0].map(|beta| of(method, beta)))
            .collect();
        let svg = growth(&maps, 0.1).unwrap();
        let height = 4.0 * (ABOVE + SIDE + BELOW);
        let stated: f64 = svg
            .split("height=\"")
            .nth(1)
            .unwrap()
            .split('"')
            .next()
            .unwrap()
            .parse()
            .unwrap();
        assert!(
            stated > height && stated < height + 80.0,
            "{stated} {height}"
        );
        assert_eq!(svg.matches("<image").count(), 6);
    }
}
