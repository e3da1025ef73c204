//! Filled areas: maps, as one picture within the picture, and hatches.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use plotters::style::{RGBColor, WHITE};

use super::{Canvas, Stroke, fine};
use crate::figures::FigureError;
use crate::figures::style::{Dash, Fill, INK};

/// A square grid of colours as a PNG, its lines from the bottom upward.
fn png(colours: &[RGBColor]) -> Result<Vec<u8>, FigureError> {
    let side = colours.len().isqrt();
    if side == 0 || side * side != colours.len() {
        let what = "the map is not a square grid";
        return Err(FigureError::Empty { what });
    }
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, side as u32, side as u32);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header().map_err(FigureError::drawing)?;
    let lines = colours.chunks(side).rev().flatten();
    let data: Vec<u8> = lines.flat_map(|c| [c.0, c.1, c.2]).collect();
    writer
        .write_image_data(&data)
        .map_err(FigureError::drawing)?;
    writer.finish().map_err(FigureError::drawing)?;
    Ok(bytes)
}

/// Distance of the lines of a hatch along x, and their width.
const SPACING: f64 = 6.0;
const LINE: f64 = 0.9;

/// A piece of a line.
type Piece = [(f64, f64); 2];

/// Side of a map of `cells` points a side: near `nominal`, and a whole number of pixels a point, so that all are of the
/// same size. Where points are smaller than pixels it is `nominal`.
pub(in crate::figures) fn whole_side(nominal: f64, cells: usize) -> f64 {
    let cells = cells.max(1) as f64;
    if cells > 1.25 * nominal {
        return nominal;
    }
    (nominal / cells).round().max(1.0) * cells
}

/// Lines at 45 degrees over a box of `side * side` equal cells, as far as they cover cells that `takes` by column and
/// row from the upper left.
fn diagonals(
    (width, height): (f64, f64),
    side: usize,
    rising: bool,
    takes: impl Fn(usize, usize) -> bool,
) -> Vec<Piece> {
    let cell = (width / side as f64, height / side as f64);
    let index = |v: f64, size: f64| ((v / size) as usize).min(side - 1);
    let mut pieces: Vec<Piece> = Vec::new();
    for line in 0..((width + height) / SPACING).ceil() as usize {
        // Along this line x + y is the same.
        let sum = SPACING * (line as f64 + 0.5);
        let (from, to) = ((sum - height).max(0.0), sum.min(width));
        let columns = (0..=side).map(|i| cell.0 * i as f64);
        let rows = (0..=side).map(|j| sum - cell.1 * j as f64);
        let mut stops: Vec<f64> = columns
            .chain(rows)
            .filter(|x| (from..=to).contains(x))
            .collect();
        stops.extend([from, to]);
        stops.sort_by(f64::total_cmp);
        let mut last: Option<f64> = None;
        for ends in stops.windows(2).filter(|ends| ends[1] > ends[0]) {
            let x = 0.5 * (ends[0] + ends[1]);
            let (column, row) = (index(x, cell.0), index(sum - x, cell.1));
            let column = if rising { column } else { side - 1 - column };
            if !takes(column, row) {
                last = None;
                continue;
            }
            let at = |x: f64| (if rising { x } else { width - x }, sum - x);
            match (last, pieces.last_mut()) {
                (Some(end), Some(piece)) if end.total_cmp(&ends[0]).is_eq() => {
                    piece[1] = at(ends[1])
                }
                _ => pieces.push([at(ends[0]), at(ends[1])]),
            }
            last = Some(ends[1]);
        }
    }
    pieces
}

impl Canvas<'_> {
    /// A filled rectangle with its upper left corner at `corner`.
    pub(super) fn patch(
        &self,
        corner: (f64, f64),
        size: (f64, f64),
        fill: Fill,
    ) -> Result<(), FigureError> {
        self.rectangle(corner, size, fill.colour)?;
        let stroke = Stroke {
            colour: fill.line(),
            width: LINE,
            dash: Dash::Solid,
        };
        for rising in [true, false]
            .into_iter()
            .filter(|rising| fill.has_lines(*rising))
        {
            for piece in diagonals(size, 1, rising, |_, _| true) {
                self.line(&piece.map(|(x, y)| (corner.0 + x, corner.1 + y)), stroke)?;
            }
        }
        Ok(())
    }

    /// A square grid of fills, one pixel of an image a point, its lines from the bottom upward, and the hatches above it.
    pub(super) fn grid(
        &self,
        (x, y): (f64, f64),
        size: (f64, f64),
        fills: &[Fill],
    ) -> Result<(), FigureError> {
        let colours: Vec<RGBColor> = fills.iter().map(|fill| fill.colour).collect();
        let data = BASE64_STANDARD.encode(png(&colours)?);
        let [left, top, width, height] = [x, y, size.0, size.1].map(fine);
        let mut images = self.images.borrow_mut();
        *images += &format!(
            "<image x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\" \
             style=\"image-rendering:pixelated\" preserveAspectRatio=\"none\" \
             href=\"data:image/png;base64,{data}\"/>\n"
        );
        let side = fills.len().isqrt();
        for (rising, line) in [(true, INK), (false, INK), (true, WHITE), (false, WHITE)] {
            let pieces = diagonals(size, side, rising, |column, row| {
                let fill = fills[(side - 1 - row) * side + column];
                fill.has_lines(rising) && fill.line() == line
            });
            if pieces.is_empty() {
                continue;
            }
            let place = |at: (f64, f64)| (fine(x + at.0), fine(y + at.1));
            let path: String = (pieces.iter().map(|piece| piece.map(place)))
                .map(|[from, to]| format!("M{} {}L{} {}", from.0, from.1, to.0, to.1))
                .collect();
            let RGBColor(red, green, blue) = line;
            *images += &format!(
                "<path d=\"{path}\" fill=\"none\" stroke=\"#{red:02X}{green:02X}{blue:02X}\" \
                 stroke-width=\"{}\"/>\n",
                fine(LINE)
            );
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_of_a_map_are_a_whole_number_of_pixels() {
        for cells in 1..=337 {
            let side = whole_side(270.0, cells);
            let pixels = side / cells as f64;
            assert!((pixels - pixels.round()).abs() < 1e-9, "{cells}: {side}");
            assert!((0.6..=1.5).contains(&(side / 270.0)), "{cells}: {side}");
        }
        assert!((whole_side(270.0, 2000) - 270.0).abs() < 1e-9);
    }

    #[test]
    fn hatches_cover_the_cells_that_they_mark_and_no_others() {
        // One cell of nine, right of the middle and up.
        let marked = |column: usize, row: usize| (column, row) == (2, 0);
        for rising in [true, false] {
            let pieces = diagonals((90.0, 90.0), 3, rising, marked);
            assert!(pieces.len() >= 8, "{}", pieces.len());
            for (x, y) in pieces.into_iter().flatten() {
                let within = |v: f64, low: f64| (low - 1e-9..=low + 30.0 + 1e-9).contains(&v);
                assert!(within(x, 60.0) && within(y, 0.0), "{x}, {y}");
            }
        }
    }

    #[test]
    fn a_line_across_neighbouring_cells_is_one_piece() {
        let pieces = diagonals((90.0, 90.0), 45, true, |_, _| true);
        assert_eq!(pieces.len(), 30);
    }
}
