//! Maps: a grid of colours as one picture within the picture.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use plotters::style::RGBColor;

use super::{Canvas, fine};
use crate::figures::FigureError;

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

impl Canvas<'_> {
    /// A square grid of colours, one pixel a point, its lines from the bottom upward.
    pub(in crate::figures) fn image(
        &self,
        (x, y): (f64, f64),
        (width, height): (f64, f64),
        colours: &[RGBColor],
    ) -> Result<(), FigureError> {
        let data = BASE64_STANDARD.encode(png(colours)?);
        let [x, y, width, height] = [x, y, width, height].map(fine);
        *self.images.borrow_mut() += &format!(
            "<image x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" \
             style=\"image-rendering:pixelated\" preserveAspectRatio=\"none\" \
             href=\"data:image/png;base64,{data}\"/>\n"
        );
        Ok(())
    }
}
