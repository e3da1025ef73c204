//! The flow about a pair: speed as colours, streamlines, and the spheres with their orientations and slip.

use std::f64::consts::TAU;

use super::canvas::{
    ABOVE, Anchor, Axes, Axis, BELOW, CAPTION_LINE, Canvas, Key, LEFT, Map, MapCell, Panel, TEXT,
    TITLE, whole_side,
};
use super::heat;
use super::streamlines::{Square, streamlines};
use super::style::{Colour, Fill, Hatch, WHITE, colour};
use super::{FigureError, number};
use compare::study::flow::{FlowField, FlowFrame, Window};
use scene::nalgebra::Vector3;

/// Approximate side of the plot, in pixels.
const SIDE: f64 = 440.0;

/// Distance of streamlines, in pixels.
const APART: f64 = 22.0;

/// Arrow heads along a streamline: the first is this far from its beginning, the others twice as far from one another, in pixels.
const HEADS: f64 = 70.0;

/// Smallest distance of the labels of the colour bar, as a share of its height.
const LABELS_APART: f64 = 0.09;

/// Speeds up to this share of the largest have no streamlines.
const STILL: f64 = 1e-6;

/// Arrows of slip around a sphere, the length of the longest one in radii, and the radius of the ring on which they are.
const SLIPS: usize = 20;
const SLIP_LENGTH: f64 = 0.34;
const SLIP_RING: f64 = 0.86;

/// Length of the longest arrow of an orientation, in pixels; arrows of slip are at most 0.6 times as long.
const LONGEST: f64 = 60.0;

/// The smallest slip that has an arrow, as a share of the longest one.
const LEAST_SLIP: f64 = 0.08;

/// The smallest radii of spheres with an arrow of their orientation, and with their number and arrows of their slip, in pixels.
const LEAST_RADIUS: f64 = 10.0;
const LEAST_RADIUS_OF_SLIP: f64 = 26.0;

/// Colour of slip.
const SLIP: Colour = Colour(170, 60, 110);

/// Share of the colour scale that is used: darker colours would hide the lines.
const LIGHTER: f64 = 0.86;

/// Draws a field. The `name` is that of the scene, and `fastest` the speed at the end of the colour scale.
///
/// # Errors
/// [`FigureError`] if the picture of the field cannot be encoded.
pub fn flow(field: &FlowField, name: &str, fastest: f64) -> Result<String, FigureError> {
    let side = whole_side(SIDE, field.side);
    let lines = caption(field, name, fastest);
    let foot = TITLE + ABOVE + side + BELOW;
    let caption_height = CAPTION_LINE * lines.len() as f64 + 8.0;
    let width = LEFT + side + 14.0 + heat::BAR_ROOM;
    let slip = largest_slip(field, side);
    let method = field.method.title();
    let title = format!("Flow about two squirmers: {}", in_title(method));
    let mut canvas = Canvas::new(&title, (width, foot + caption_height), &[legend(slip)]);
    let window = &field.window;
    let (low, high) = (window.at((0.0, 0.0)), window.at((1.0, 1.0)));
    let titles = if window.section.is_level {
        ["x (radii a)", "y (radii a)"]
    } else {
        ["along the line of centres (radii a)", "across (radii a)"]
    };
    let axes = Axes {
        title: format!(
            "t = {} a/Vs, gap {} a, {}",
            short(field.t),
            short(field.pair.configuration.gap.eps()),
            frame_in_words(field.frame)
        ),
        x: Axis::new(&(low.0..high.0), titles[0], 7),
        y: Axis::new(&(low.1..high.1), titles[1], 7),
    };
    let map = Map::new(&cells(field, fastest))?;
    let corner = (LEFT, TITLE + ABOVE);
    canvas.panel(corner, (side, side), axes, |panel| {
        panel.map(&map);
        panel.within_frame(|panel| {
            draw_lines(panel, field, side);
            for k in [0, 1] {
                draw_squirmer(panel, field, k, slip);
            }
        });
    });
    if fastest > 0.0 {
        let beside = (LEFT + side + 14.0, TITLE + ABOVE);
        heat::labelled_bar(&mut canvas, (beside, side), shade, &bar_labels(fastest));
        let above = (beside.0 + 24.0, TITLE + 0.5 * ABOVE);
        canvas.text("speed (Vs)", above, TEXT, Anchor::Middle);
    }
    canvas.caption(&lines, foot + 4.0);
    Ok(canvas.finish())
}

/// Round speeds beside the colour bar, at their shares of its height, and the largest.
fn bar_labels(fastest: f64) -> Vec<(f64, String)> {
    let mut labels = vec![(0.0, "0".to_owned()), (1.0, short(fastest))];
    let power = fastest.log10().floor() as i32;
    for exponent in [power, power - 1, power - 2] {
        for digit in [5, 2, 1] {
            // From its text, so that it is the number that the label says.
            let speed: f64 = format!("{digit}e{exponent}").parse().unwrap_or(0.0);
            let share = (speed / fastest).sqrt();
            if share < 1.0
                && labels
                    .iter()
                    .all(|(other, _)| (share - other).abs() > LABELS_APART)
            {
                labels.push((share, number(speed)));
            }
        }
    }
    labels
}

/// A method within the title.
fn in_title(title: &str) -> String {
    let mut letters = title.chars();
    let first = letters
        .next()
        .map(|letter| letter.to_lowercase().to_string());
    first.unwrap_or_default() + letters.as_str()
}

/// A number with three digits.
fn short(value: f64) -> String {
    number(format!("{value:.2e}").parse().unwrap_or(value))
}

fn frame_in_words(frame: FlowFrame) -> String {
    match frame {
        FlowFrame::Lab => "laboratory frame".to_owned(),
        FlowFrame::Squirmer(k) => format!("frame of squirmer {}", k + 1),
    }
}

/// The lines below the plot.
fn caption(field: &FlowField, name: &str, fastest: f64) -> Vec<String> {
    let mut lines = vec![format!(
        "{name}, {} x {} points, estimated error of the velocity {} Vs",
        field.side,
        field.side,
        short(field.error_estimate)
    )];
    lines.push(if fastest > 0.0 {
        "Colours go by the square root of the speed, up to the largest speed of the surfaces."
            .to_owned()
    } else {
        "The fluid is at rest.".to_owned()
    });
    if field.frame != FlowFrame::Lab {
        lines.push("The velocity of that squirmer is subtracted; its spin is not.".to_owned());
    }
    let section = &field.window.section;
    if !section.is_level {
        let normal = section.normal();
        let [x, y, z] = [normal.x, normal.y, normal.z].map(short);
        lines.push(format!(
            "Plane through both centres with normal ({x}, {y}, {z}); velocity out of it up to {} Vs",
            short(field.largest_across())
        ));
    }
    lines
}

fn legend(slip: f64) -> Vec<(Key, String)> {
    let mut entries = vec![
        (Key::Arrow(colour(0)), "squirmer 1".to_owned()),
        (Key::Arrow(colour(1)), "squirmer 2".to_owned()),
    ];
    if slip > 0.0 {
        let text = format!("slip, the longest {} Vs", short(slip));
        entries.push((Key::Arrow(SLIP), text));
    }
    entries
}

/// Colour at a share of the scale.
fn shade(share: f64) -> Colour {
    heat::sequential(LIGHTER * share)
}

fn cells(field: &FlowField, fastest: f64) -> Vec<MapCell> {
    let cell = |speed: f64| {
        let share = if fastest > 0.0 { speed / fastest } else { 0.0 };
        // Within a sphere there is no speed. On a coarse grid such a cell sticks out: it is not that of still fluid.
        let colour = if speed.is_nan() {
            WHITE
        } else {
            shade(share.sqrt())
        };
        MapCell {
            fill: Fill::new(colour, Hatch::Plain),
            is_data: true,
        }
    };
    let points = field.points.iter();
    points
        .map(|point| cell(point.state.velocity.norm()))
        .collect()
}

/// Streamlines of the velocity in the plane.
fn draw_lines(panel: &mut Panel<'_>, field: &FlowField, side: f64) {
    let Window { half_width, .. } = field.window;
    let square = Square {
        corner: field.window.at((0.0, 0.0)),
        side: 2.0 * half_width,
    };
    let per_pixel = square.side / side;
    let velocities: Vec<_> = (field.points.iter())
        .map(|point| field.window.section.along(&point.state.velocity))
        .collect();
    let speeds = velocities.iter().map(|(u, v)| u.hypot(*v));
    let still = STILL * speeds.fold(0.0, f64::max);
    let velocity = |at| interpolated(&velocities, field.side, square, at);
    for line in streamlines(square, APART * per_pixel, still, velocity) {
        panel.streamline(&line);
        let mut travelled = 0.0;
        let length: f64 = line.windows(2).map(|ends| distance(ends[0], ends[1])).sum();
        // Short lines have one head in their middle.
        let mut next = (HEADS * per_pixel).min(0.5 * length);
        for ends in line.windows(2) {
            travelled += distance(ends[0], ends[1]);
            if travelled >= next {
                panel.head(ends[1], (ends[1].0 - ends[0].0, ends[1].1 - ends[0].1));
                next += 2.0 * HEADS * per_pixel;
            }
        }
    }
}

fn distance(a: (f64, f64), b: (f64, f64)) -> f64 {
    (a.0 - b.0).hypot(a.1 - b.1)
}

/// Bilinear interpolation between the middles of cells; `None` beside a point without a velocity.
fn interpolated(
    velocities: &[(f64, f64)],
    side: usize,
    square: Square,
    (x, y): (f64, f64),
) -> Option<(f64, f64)> {
    let last = (side - 1) as f64;
    let place = |v: f64, low: f64| ((v - low) / square.side * side as f64 - 0.5).clamp(0.0, last);
    let (column, row) = (place(x, square.corner.0), place(y, square.corner.1));
    let before = |place: f64| (place as usize).min(side - 2);
    let (i, j) = (before(column), before(row));
    let (s, t) = (column - i as f64, row - j as f64);
    let mut sum = (0.0, 0.0);
    for (index, weight) in [
        (j * side + i, (1.0 - s) * (1.0 - t)),
        (j * side + i + 1, s * (1.0 - t)),
        ((j + 1) * side + i, (1.0 - s) * t),
        ((j + 1) * side + i + 1, s * t),
    ] {
        sum.0 += weight * velocities[index].0;
        sum.1 += weight * velocities[index].1;
    }
    (sum.0.is_finite() && sum.1.is_finite()).then_some(sum)
}

/// Points of the surface in the plane, with the part of the slip in it.
fn slips(field: &FlowField, k: usize) -> impl Iterator<Item = ((f64, f64), (f64, f64))> {
    let section = field.window.section;
    let pair = field.pair;
    (0..SLIPS).map(move |index| {
        let angle = TAU * (index as f64 + 0.5) / SLIPS as f64;
        let normal: Vector3<f64> = section.axes[0] * angle.cos() + section.axes[1] * angle.sin();
        let slip = pair.slip(k, &normal);
        (section.along(&normal), section.along(&slip))
    })
}

/// The largest slip that is drawn on a plot of the given side in pixels.
fn largest_slip(field: &FlowField, side: f64) -> f64 {
    let per_radius = 0.5 * side / field.window.half_width;
    let large = |k: &usize| field.pair.configuration.radii[*k] * per_radius >= LEAST_RADIUS_OF_SLIP;
    let all = [0, 1]
        .into_iter()
        .filter(large)
        .flat_map(|k| slips(field, k));
    all.map(|(_, slip)| slip.0.hypot(slip.1))
        .fold(0.0, f64::max)
}

fn draw_squirmer(panel: &mut Panel<'_>, field: &FlowField, k: usize, largest: f64) {
    let configuration = &field.pair.configuration;
    let section = &field.window.section;
    let centre = section.coordinates(&configuration.positions()[k]);
    let radius = configuration.radii[k];
    panel.disc(centre, radius, colour(k));
    let pixels = panel.pixels(radius);
    if pixels < LEAST_RADIUS {
        return;
    }
    let heading = section.along(&configuration.orientations[k]);
    let ahead = |share: f64| {
        let length = share * radius;
        (centre.0 + length * heading.0, centre.1 + length * heading.1)
    };
    panel.arrow(
        ahead(-0.3),
        heading,
        (0.75 * pixels).min(LONGEST),
        colour(k),
    );
    if pixels < LEAST_RADIUS_OF_SLIP {
        return;
    }
    panel.label(ahead(-0.5), &(k + 1).to_string());
    for (normal, slip) in slips(field, k) {
        let strength = slip.0.hypot(slip.1);
        let share = strength / largest;
        if share > LEAST_SLIP {
            let along = (slip.0 / strength, slip.1 / strength);
            let longest = SLIP_LENGTH * radius * (0.6 * LONGEST / (SLIP_LENGTH * pixels)).min(1.0);
            let length = share * longest;
            let from =
                |centre: f64, n: f64, s: f64| centre + SLIP_RING * radius * n - 0.5 * length * s;
            let from = (
                from(centre.0, normal.0, along.0),
                from(centre.1, normal.1, along.1),
            );
            panel.arrow(from, along, panel.pixels(length), SLIP);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_of_the_bar_are_round_apart_and_where_the_scale_has_them() {
        for fastest in [1e-9, 0.996, 1.0, 2.05, 5.86, 123.0] {
            let mut labels = bar_labels(fastest);
            assert!((4..=9).contains(&labels.len()), "{fastest}: {labels:?}");
            labels.sort_by(|a, b| a.0.total_cmp(&b.0));
            assert!(
                labels
                    .windows(2)
                    .all(|two| two[1].0 - two[0].0 > LABELS_APART)
            );
        }
        assert!(bar_labels(4.0).contains(&(0.5, "1".to_owned())));
    }

    #[test]
    fn a_grid_is_interpolated_between_the_middles_of_its_cells() {
        let square = Square {
            corner: (-1.0, 3.0),
            side: 4.0,
        };
        let at = |i: usize, j: usize| (-0.5 + i as f64, 3.5 + j as f64);
        let linear = |(x, y): (f64, f64)| (2.0 * x - y, 1.0 + y);
        let mut grid: Vec<_> = (0..16).map(|k| linear(at(k % 4, k / 4))).collect();
        for place in [(0.3, 4.9), (2.4, 6.1), (-0.5, 3.5)] {
            let (u, v) = interpolated(&grid, 4, square, place).unwrap();
            let (a, b) = linear(place);
            assert!((u - a).abs() + (v - b).abs() < 1e-12, "{place:?}");
        }
        grid[5] = (f64::NAN, f64::NAN);
        assert!(interpolated(&grid, 4, square, (0.3, 4.9)).is_none());
        assert!(interpolated(&grid, 4, square, (2.4, 6.1)).is_some());
    }

    #[test]
    fn spheres_have_no_velocity_and_the_colour_of_none() {
        // A speed that is no number has the colour for that, not the one for rest.
        assert_ne!(shade(f64::NAN), shade(0.0));
    }
}
