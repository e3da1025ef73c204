//! Evenly spaced streamlines of a plane field of velocities, after Jobard & Lefer, *Creating evenly-spaced streamlines of arbitrary density*
//! (Visualization in Scientific Computing '97, 43).
//!
//! A new line begins at the distance `apart` beside one that is there, and ends where it would come nearer than half of that to another one,
//! where it closes, at a body, at the end of the window, and where the fluid is at rest.

use std::collections::VecDeque;

/// A point, or a vector.
type Point = (f64, f64);

/// Steps along a line over the distance of lines.
const STEP: f64 = 0.12;

/// The distance at which a line ends at another one over the distance of lines.
const TEST: f64 = 0.5;

/// Points of a line that are near because they are neighbours.
const ALONG: usize = (3.0 * TEST / STEP) as usize;

/// The shortest line over the distance of lines.
const SHORTEST: f64 = 1.5;

/// Most steps of a line in one direction.
const MOST_STEPS: usize = 5000;

/// A square in which lines are drawn.
#[derive(Clone, Copy)]
pub(super) struct Square {
    /// Lower left corner.
    pub corner: Point,
    /// Side.
    pub side: f64,
}

impl Square {
    fn holds(&self, (x, y): Point) -> bool {
        let within = |v: f64, low: f64| (low..=low + self.side).contains(&v);
        within(x, self.corner.0) && within(y, self.corner.1)
    }
}

/// Streamlines in a square, about `apart` from one another. The function `velocity` gives `None` where there is no fluid; speeds up to `still`
/// count as rest.
pub(super) fn streamlines(
    square: Square,
    apart: f64,
    still: f64,
    velocity: impl Fn(Point) -> Option<Point>,
) -> Vec<Vec<Point>> {
    let direction = |at: Point| {
        let (u, v) = velocity(at).filter(|_| square.holds(at))?;
        let speed = u.hypot(v);
        (speed > still).then(|| (u / speed, v / speed))
    };
    let mut drawn = Lines::new(square, apart);
    let mut beside: VecDeque<usize> = VecDeque::new();
    // Regions that no line leads to have lines from seeds on a lattice.
    let count = (square.side / apart).floor().max(1.0) as usize;
    let lattice = (0..count * count).map(|index| {
        let share = |k: usize| (k as f64 + 0.5) / count as f64;
        let (x, y) = (share(index % count), share(index / count));
        (
            square.corner.0 + square.side * x,
            square.corner.1 + square.side * y,
        )
    });
    for seed in lattice {
        if let Some(line) = drawn.add_from(seed, &direction) {
            beside.push_back(line);
        }
        while let Some(line) = beside.pop_front() {
            for index in 0..drawn.lines[line].len() {
                let at = drawn.lines[line][index];
                let Some((u, v)) = direction(at) else {
                    continue;
                };
                for side in [1.0, -1.0] {
                    let seed = (at.0 - side * apart * v, at.1 + side * apart * u);
                    if let Some(line) = drawn.add_from(seed, &direction) {
                        beside.push_back(line);
                    }
                }
            }
        }
    }
    drawn.lines
}

/// The lines so far, with their points by boxes of a lattice.
struct Lines {
    square: Square,
    apart: f64,
    lines: Vec<Vec<Point>>,
    boxes: Vec<Vec<Point>>,
    count: usize,
}

impl Lines {
    fn new(square: Square, apart: f64) -> Self {
        let count = (square.side / apart).ceil().max(1.0) as usize;
        Self {
            square,
            apart,
            lines: Vec::new(),
            boxes: vec![Vec::new(); count * count],
            count,
        }
    }

    /// Column or row of a coordinate.
    fn place(&self, v: f64, low: f64) -> usize {
        let share = (v - low) / self.square.side;
        ((share * self.count as f64).max(0.0) as usize).min(self.count - 1)
    }

    /// Whether a point is at least `distance`, which is at most the side of a box, from all lines.
    fn are_beyond(&self, at: Point, distance: f64) -> bool {
        let column = self.place(at.0, self.square.corner.0);
        let row = self.place(at.1, self.square.corner.1);
        let near = |k: usize| k.saturating_sub(1)..=(k + 1).min(self.count - 1);
        near(row)
            .flat_map(|row| near(column).map(move |column| row * self.count + column))
            .flat_map(|index| &self.boxes[index])
            .all(|other| (at.0 - other.0).hypot(at.1 - other.1) >= distance)
    }

    /// Adds the line through a seed, if it is long enough; its index.
    fn add_from(
        &mut self,
        seed: Point,
        direction: &impl Fn(Point) -> Option<Point>,
    ) -> Option<usize> {
        direction(seed)?;
        // Rounding must not refuse a seed that lies beside its own line.
        if !self.are_beyond(seed, (1.0 - 1e-9) * self.apart) {
            return None;
        }
        let ahead = self.follow(seed, &[], 1.0, direction);
        let mut line = self.follow(seed, &ahead, -1.0, direction);
        line.reverse();
        line.push(seed);
        line.extend(ahead);
        if (line.len() - 1) as f64 * STEP < SHORTEST {
            return None;
        }
        for at in &line {
            let column = self.place(at.0, self.square.corner.0);
            let row = self.place(at.1, self.square.corner.1);
            self.boxes[row * self.count + column].push(*at);
        }
        self.lines.push(line);
        Some(self.lines.len() - 1)
    }

    /// Follows the field from a seed, with the part of the line that is there already on the other side of it.
    fn follow(
        &self,
        seed: Point,
        other_side: &[Point],
        sign: f64,
        direction: &impl Fn(Point) -> Option<Point>,
    ) -> Vec<Point> {
        let step = sign * STEP * self.apart;
        let mut line: Vec<Point> = Vec::new();
        let mut at = seed;
        while line.len() < MOST_STEPS {
            let Some(next) = advance(at, step, direction) else {
                break;
            };
            // The line so far, backward from its end.
            let line_so_far = line.iter().rev().chain([&seed]).chain(other_side);
            let comes_back = self.are_near(next, line_so_far.skip(ALONG));
            if comes_back || !self.are_beyond(next, TEST * self.apart) {
                break;
            }
            line.push(next);
            at = next;
        }
        line
    }

    /// Whether a point of a line is nearer to others of it than lines may be, half as near as it may be to another line.
    fn are_near<'a>(&self, at: Point, mut others: impl Iterator<Item = &'a Point>) -> bool {
        others.any(|to| (at.0 - to.0).hypot(at.1 - to.1) < 0.5 * TEST * self.apart)
    }
}

/// A step of the classical Runge-Kutta method along a field of unit vectors.
fn advance(at: Point, step: f64, direction: &impl Fn(Point) -> Option<Point>) -> Option<Point> {
    let from = |by: Point, length: f64| (at.0 + length * by.0, at.1 + length * by.1);
    let k1 = direction(at)?;
    let k2 = direction(from(k1, 0.5 * step))?;
    let k3 = direction(from(k2, 0.5 * step))?;
    let k4 = direction(from(k3, step))?;
    let mean = |a: f64, b: f64, c: f64, d: f64| (a + 2.0 * b + 2.0 * c + d) / 6.0;
    let by = (mean(k1.0, k2.0, k3.0, k4.0), mean(k1.1, k2.1, k3.1, k4.1));
    let next = from(by, step);
    // A point at rest between opposite directions is no way on.
    (by.0.hypot(by.1) > 0.5 && direction(next).is_some()).then_some(next)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: Square = Square {
        corner: (-2.0, -2.0),
        side: 4.0,
    };

    fn distance(a: Point, b: Point) -> f64 {
        (a.0 - b.0).hypot(a.1 - b.1)
    }

    /// A stream past a disc of radius 1/2.
    fn past_a_disc((x, y): Point) -> Option<Point> {
        let r2 = x * x + y * y;
        let share = 0.25 / r2;
        (r2 > 0.25).then_some((
            1.0 - share * (x * x - y * y) / r2,
            -2.0 * share * x * y / r2,
        ))
    }

    #[test]
    fn lines_keep_apart_stay_in_the_window_and_out_of_bodies() {
        let apart = 0.2;
        let lines = streamlines(SQUARE, apart, 1e-9, past_a_disc);
        assert!(lines.len() > 15, "{}", lines.len());
        for (index, line) in lines.iter().enumerate() {
            for at in line {
                assert!(SQUARE.holds(*at) && past_a_disc(*at).is_some(), "{at:?}");
                for other in lines[..index].iter().flatten() {
                    assert!(distance(*at, *other) >= TEST * apart - 1e-12);
                }
            }
        }
        // They fill the window: no place is far from all.
        for index in 0..400 {
            let at = (
                -1.9 + 0.2 * f64::from(index % 20),
                -1.9 + 0.2 * f64::from(index / 20),
            );
            if past_a_disc(at).is_some() {
                let nearest = lines
                    .iter()
                    .flatten()
                    .map(|p| distance(*p, at))
                    .fold(9.0, f64::min);
                assert!(nearest < 1.3 * apart, "{at:?}: {nearest}");
            }
        }
    }

    #[test]
    fn lines_follow_the_stream_function() {
        for line in streamlines(SQUARE, 0.25, 1e-9, past_a_disc) {
            let stream = |(x, y): Point| y * (1.0 - 0.25 / (x * x + y * y));
            for at in &line {
                assert!((stream(*at) - stream(line[0])).abs() < 1e-4);
            }
        }
    }

    #[test]
    fn a_closed_line_goes_round_once() {
        let lines = streamlines(SQUARE, 0.4, 1e-9, |(x, y)| Some((-y, x)));
        let whole = |line: &&Vec<Point>| line.iter().all(|at| at.0.hypot(at.1) < 1.9);
        let mut circles = 0;
        for line in lines.iter().filter(whole) {
            let length: f64 = line.windows(2).map(|ends| distance(ends[0], ends[1])).sum();
            let radius = line[0].0.hypot(line[0].1);
            assert!(
                length < 2.0 * std::f64::consts::PI * radius,
                "{radius}: {length}"
            );
            circles += 1;
        }
        assert!(circles > 2);
    }

    #[test]
    fn fluid_at_rest_has_no_lines() {
        assert!(streamlines(SQUARE, 0.2, 1e-9, |_| Some((0.0, 0.0))).is_empty());
        assert!(streamlines(SQUARE, 0.2, 1e-9, |_| None).is_empty());
    }
}
