//! Filled areas: maps, each drawn as one pixel image, and hatches.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use maud::html;

use super::{Canvas, px};
use crate::figures::FigureError;
use crate::figures::style::{Fill, INK, WHITE};

/// Distance of the lines of a hatch along x, and width of the lines.
const SPACING: f64 = 6.0;
const LINE: f64 = 0.9;

/// One point of a map.
#[derive(Clone, Copy)]
pub(crate) struct MapCell {
    pub fill: Fill,
    /// Whether the panel's quantity is known at this point.
    pub is_data: bool,
}

/// A square grid of fills. Its rows are ordered from the bottom upward.
pub(crate) struct Map {
    fills: Vec<Fill>,
    side: usize,
    /// The colours as a PNG in base64, with one pixel for each point.
    image: String,
    pub is_data: bool,
}

impl Map {
    /// # Errors
    /// [`FigureError`] if the cells are not a square grid, or cannot be encoded.
    pub(crate) fn new(cells: &[MapCell]) -> Result<Self, FigureError> {
        let side = cells.len().isqrt();
        if side == 0 || side * side != cells.len() {
            let what = "the map is not a square grid";
            return Err(FigureError::Empty { what });
        }
        let fills: Vec<Fill> = cells.iter().map(|cell| cell.fill).collect();
        let lines = fills.chunks(side).rev().flatten();
        let data: Vec<u8> = lines
            .flat_map(|f| [f.colour.0, f.colour.1, f.colour.2])
            .collect();
        let image = BASE64_STANDARD.encode(png(side as u32, &data).map_err(FigureError::encoding)?);
        let is_data = cells.iter().any(|cell| cell.is_data);
        Ok(Self {
            fills,
            side,
            image,
            is_data,
        })
    }
}

/// A square picture of pixels in red, green and blue.
fn png(side: u32, data: &[u8]) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, side, side);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(data)?;
    writer.finish()?;
    Ok(bytes)
}

/// Side of a map of `cells` points a side. It is near `nominal`, and each point has a whole number of pixels, so that
/// all points have the same size. If points are smaller than pixels, the side is `nominal`.
pub(crate) fn whole_side(nominal: f64, cells: usize) -> f64 {
    let cells = cells.max(1) as f64;
    if cells > 1.25 * nominal {
        return nominal;
    }
    (nominal / cells).round().max(1.0) * cells
}

/// Lines at 45 degrees over a box, only over those places for which `takes` is true. Borders between places are at
/// whole pixels, so lines begin and end there.
fn hatch(
    (width, height): (f64, f64),
    rising: bool,
    takes: impl Fn((f64, f64)) -> bool,
) -> Vec<[(f64, f64); 2]> {
    let mut pieces = Vec::new();
    for line in 0..((width + height) / SPACING).ceil() as usize {
        // Along this line x + y is constant.
        let sum = SPACING * (line as f64 + 0.5);
        let (from, to) = ((sum - height).max(0.0), sum.min(width));
        let at = |x: f64| (if rising { x } else { width - x }, sum - x);
        let steps = (to - from).max(0.0).ceil() as usize;
        let mut start = None;
        for step in 0..=steps {
            let x = (from + step as f64).min(to);
            let middle = 0.5 * (x + (x + 1.0).min(to));
            let is_covered = step < steps && takes(at(middle));
            match (start, is_covered) {
                (None, true) => start = Some(x),
                (Some(first), false) => {
                    pieces.push([at(first), at(x)]);
                    start = None;
                }
                _ => {}
            }
        }
    }
    pieces
}

impl Canvas {
    /// A filled rectangle with its upper left corner at `corner`.
    pub(super) fn patch(&mut self, corner: (f64, f64), size: (f64, f64), fill: Fill) {
        self.rectangle(corner, size, fill.colour);
        self.hatches(corner, size, |_| fill);
    }

    /// A map with its upper left corner at `(x, y)`.
    pub(super) fn map(&mut self, (x, y): (f64, f64), size: (f64, f64), map: &Map) {
        let data = format!("data:image/png;base64,{}", map.image);
        let (width, height) = (px(size.0), px(size.1));
        self.draw(html! {
            image x=(px(x)) y=(px(y)) width=(width) height=(height) style="image-rendering:pixelated"
                preserveAspectRatio="none" href=(data) {}
        });
        let index = |share: f64| ((share * map.side as f64) as usize).min(map.side - 1);
        self.hatches((x, y), size, |at| {
            let (column, row) = (index(at.0 / size.0), index(1.0 - at.1 / size.1));
            map.fills[row * map.side + column]
        });
    }

    /// The hatches of a box of fills, with a path for each colour and direction.
    fn hatches(&mut self, (x, y): (f64, f64), size: (f64, f64), fill: impl Fn((f64, f64)) -> Fill) {
        for (rising, line) in [(true, INK), (false, INK), (true, WHITE), (false, WHITE)] {
            let marked = |at| fill(at).has_lines(rising) && fill(at).line() == line;
            let place = |at: (f64, f64)| format!("{} {}", px(x + at.0), px(y + at.1));
            let pieces = hatch(size, rising, marked).into_iter();
            let path: String = pieces
                .map(|ends| format!("M{}L{}", place(ends[0]), place(ends[1])))
                .collect();
            if !path.is_empty() {
                self.draw(html! { path d=(path) fill="none" stroke=(line) stroke-width=(LINE) {} });
            }
        }
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
        let marked = |(x, y): (f64, f64)| x > 60.0 && y < 30.0;
        for rising in [true, false] {
            let pieces = hatch((90.0, 90.0), rising, marked);
            assert!(pieces.len() >= 8, "{}", pieces.len());
            for [from, to] in &pieces {
                let falls = (to.0 - from.0) * (to.1 - from.1) > 0.0;
                assert_ne!(falls, rising, "{from:?} {to:?}");
            }
            for (x, y) in pieces.into_iter().flatten() {
                let within = |v: f64, low: f64| (low - 1e-9..=low + 30.0 + 1e-9).contains(&v);
                assert!(within(x, 60.0) && within(y, 0.0), "{x}, {y}");
            }
        }
    }

    #[test]
    fn a_line_across_neighbouring_cells_is_one_piece() {
        assert_eq!(hatch((90.0, 90.0), true, |_| true).len(), 30);
    }
}
