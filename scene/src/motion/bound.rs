//! The bound states that a pair of equal squirmers has under a model, stable or not.
//!
//! Without gravity the planar motion of gap and orientations, `r = (ln eps, angle 1, angle 2)`, is a
//! system of its own, `dr/dt = f(r)`, and its fixed points are the bound states of the paper's Fig.
//! 1(c). Trajectories find those that attract; here Newton's method, begun all over the plane, finds
//! the others too, and the eigenvalues of the Jacobian tell how fast each is left or approached.
//! What is out of the plane moves by itself, to first order: whether a state holds in space as well is a
//! matter of another matrix, of three.

use std::f64::consts::{PI, TAU};

use nalgebra::{Complex, Matrix3, SMatrix, Vector3};

use super::Outcome;
use super::chart::Chart as _;
use super::coordinates::Planar;
use super::equations::{Absent, PairMotion, Present};
use super::outcome::{AT_REST, judge_rates};
use super::steady::{Newton, fixed_point};
use super::tangent::off_plane;
use crate::ode::System;
use crate::{Gap, Hydrodynamics, LoadSet, Repulsion, SceneError, Squirmer};

/// A bound state of two equal squirmers in the plane, one of up to four that mirror and exchange of
/// the two make of each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundState {
    /// Gap, in radii.
    pub gap: Gap,
    /// Orientations, in radians, anticlockwise from the direction to the other squirmer.
    pub angles_rad: [f64; 2],
    /// What it is.
    pub outcome: Outcome,
    /// Rate at which the line of centres turns, in radians over `a/V_s`, anticlockwise.
    pub turning_rate_rad: f64,
    /// Speed of the midpoint, in `V_s`.
    pub speed: f64,
    /// Eigenvalues of the Jacobian of gap and orientations, in `V_s/a`, by falling real part.
    pub eigenvalues: [Complex<f64>; 3],
    /// How the components out of the plane of the line of centres, of orientation 1 and of orientation 2, `z`, change to first order: `dz/dt` is this times
    /// `z`, in `V_s/a`. The matrix is the same all along the way of the pair. NaN where the model does not answer nearby.
    ///
    /// The state turned about an axis in the plane is the same state, so that two eigenvalues say nothing: `±i` times the rate of turning. If the headings lie
    /// along the line of centres, only one does: turned about that line nothing of the state changes.
    pub off_plane: Matrix3<f64>,
}

/// Length of the area between the rows of x and y components, up to which the headings lie along the line of centres: above the error of a fixed point.
const ALONG: f64 = 1e-7;

impl BoundState {
    /// The largest rate, in `V_s/a`, at which something small grows in the plane; negative for a state
    /// that attracts.
    #[must_use]
    pub fn growth(&self) -> f64 {
        self.eigenvalues[0].re
    }

    /// Eigenvalues of the motion out of the plane, in `V_s/a`, by falling real part, those of turning the whole pair included.
    #[must_use]
    pub fn eigenvalues_off_plane(&self) -> [Complex<f64>; 3] {
        let mut eigenvalues: [Complex<f64>; 3] = self.off_plane.complex_eigenvalues().into();
        eigenvalues.sort_by(|a, b| b.re.total_cmp(&a.re));
        eigenvalues
    }

    /// The exponents out of the plane, in `V_s/a`, by falling real part: the eigenvalues without those of turning the whole pair. One; two if the
    /// headings lie along the line of centres. The state turned as a whole has `z = w_x v_y - w_y v_x` of each vector `v`, for any `w`: what the matrix does
    /// across all of these is left.
    #[must_use]
    pub fn exponents_off_plane(&self) -> Vec<Complex<f64>> {
        let [one, two] = self.angles_rad;
        let x = Vector3::new(1.0, one.cos(), -two.cos());
        let y = Vector3::new(0.0, one.sin(), -two.sin());
        let across = x.cross(&y);
        if across.norm() > ALONG {
            let n = across.normalize();
            return vec![Complex::from(n.dot(&(self.off_plane * n)))];
        }
        let n = [x.cross(&Vector3::x()).normalize(), x.normalize()];
        let basis = SMatrix::<f64, 3, 2>::from_columns(&[n[0], n[1].cross(&n[0])]);
        let left = basis.transpose() * self.off_plane * basis;
        let mut exponents: [Complex<f64>; 2] = left.complex_eigenvalues().into();
        exponents.sort_by(|a, b| b.re.total_cmp(&a.re));
        exponents.into()
    }

    /// The largest rate, in `V_s/a`, at which something small grows out of the plane, other than the whole pair turned; negative for a state to which the pair
    /// comes back.
    #[must_use]
    pub fn growth_off_plane(&self) -> f64 {
        (self.exponents_off_plane().first()).map_or(f64::NAN, |exponent| exponent.re)
    }

    /// Whether the state is one of a line of states, along which nothing grows or decays. A squirmer
    /// with `beta = 0` that follows another one keeps any gap.
    #[must_use]
    pub fn is_neutral(&self) -> bool {
        self.eigenvalues.iter().any(|e| e.norm() < NEUTRAL)
    }
}

/// Gaps at which the search begins, in radii.
const GAPS: [f64; 7] = [0.003, 0.006, 0.015, 0.04, 0.1, 0.3, 0.8];

/// Angles at which it begins, evenly around the circle.
const ANGLES: usize = 24;

/// Newton's method from afar.
const FROM_AFAR: Newton = Newton {
    nearby: 12.0,
    longest: 0.3,
    most_steps: 60,
};

/// Two fixed points closer than this, in each variable, are the same.
const SAME: f64 = 1e-6;
const SAME_IF_NEUTRAL: f64 = 1e-3;

/// Eigenvalue, in `V_s/a`, up to which a state is one of a line of them: above the error of the Jacobian,
/// far below any that was found otherwise.
const NEUTRAL: f64 = 1e-5;

/// Share of the gap at which the loads are cut off; nearer to the cut, where they have faded to those of
/// lone squirmers, every parallel pair is at rest in its own frame.
const BELOW_CUT: f64 = 0.999;

/// All bound states of two `squirmer`s with gaps up to that of contact, 1, by rising growth rate; one for
/// each line of neutral ones.
///
/// The search begins at a fixed list of gaps and angles: a state with a tiny basin of
/// Newton's method may be missed.
///
/// # Errors
/// [`SceneError`] if the model refuses so many modes.
pub fn bound_states(
    model: &dyn Hydrodynamics,
    squirmer: &Squirmer,
    repulsion: Repulsion,
) -> Result<Vec<BoundState>, SceneError> {
    let squirmers = [*squirmer; 2];
    let mut motion = PairMotion {
        model,
        coordinates: Planar { z: 0.0 },
        squirmers,
        set: LoadSet::planar(squirmer.modes().len()),
        repulsion: Present(repulsion),
        gravity: Absent,
        held_below_range: false,
        failure: None,
        loads: 0,
    };
    // A model that does not answer for the smallest of them is asked from its own smallest gap on.
    let range = model.range();
    let within = |gap: &f64| *gap >= range.smallest && *gap <= range.largest;
    let gaps: Vec<f64> = GAPS.into_iter().filter(within).collect();
    if let Some(&smallest) = gaps.first() {
        model.interacting_loads(Gap::new(smallest)?, motion.set)?;
    }
    let largest = BELOW_CUT * model.cutoff().unwrap_or(1.0).min(1.0);
    let mut found: Vec<BoundState> = Vec::new();
    let angle = |i: usize| TAU * i as f64 / ANGLES as f64 - PI;
    for gap in gaps {
        for i in 0..ANGLES {
            // Exchange of the two makes the others of these.
            for j in 0..=i {
                let start = [0.0, 0.0, 0.0, gap.ln(), angle(i), angle(j)];
                let state = bound_state_near(&mut motion, &start);
                let new = state.filter(|state| {
                    state.gap.eps() < largest && !found.iter().any(|other| same(state, other))
                });
                found.extend(new);
            }
        }
    }
    for state in &mut found {
        let at = (state.gap, state.angles_rad);
        if let Ok(matrix) = off_plane(model, squirmers, Some(repulsion), at) {
            state.off_plane = matrix;
        }
    }
    found.sort_by(|a, b| a.growth().total_cmp(&b.growth()));
    Ok(found)
}

type PlanarMotion<'a, H> = PairMotion<'a, H, Planar, Present<Repulsion>, Absent>;

/// The bound state that Newton's method finds from the planar state `y`.
fn bound_state_near<H: Hydrodynamics + ?Sized>(
    motion: &mut PlanarMotion<'_, H>,
    y: &[f64; 6],
) -> Option<BoundState> {
    let relative = motion.coordinates.relative()?;
    let dy = motion.called(0.0, y);
    let (y, dy, gradients) = fixed_point(motion, 0.0, (y, &dy), relative, FROM_AFAR)?;
    let &[gap, one, two] = relative.variables else {
        return None;
    };
    let (angles, turning) = canonical([y[one], y[two]], dy[relative.driven]);
    let speed = dy[0].hypot(dy[1]);
    let jacobian: Matrix3<f64> = gradients.fixed_rows::<3>(0).into_owned();
    let mut eigenvalues: [Complex<f64>; 3] = jacobian.complex_eigenvalues().into();
    eigenvalues.sort_by(|a, b| b.re.total_cmp(&a.re));
    Some(BoundState {
        gap: Gap::from_ln(y[gap]),
        angles_rad: angles,
        off_plane: Matrix3::repeat(f64::NAN),
        outcome: judge_rates(turning, speed),
        turning_rate_rad: turning,
        speed,
        eigenvalues,
    })
}

/// Of the images of a state by exchange and mirror: the one that turns anticlockwise, if it turns, and
/// has the larger angles.
fn canonical([one, two]: [f64; 2], turning: f64) -> ([f64; 2], f64) {
    let images = [
        ([one, two], turning),
        ([two, one], turning),
        ([-one, -two], -turning),
        ([-two, -one], -turning),
    ]
    .map(|(angles, turning)| (angles.map(wrapped), turning));
    let rank = |(angles, turning): &([f64; 2], f64)| {
        let turns = if *turning > AT_REST { 1.0 } else { 0.0 };
        [turns, angles[0], angles[1]]
    };
    images.into_iter().fold(images[0], |best, image| {
        if rank(&image) > rank(&best) {
            image
        } else {
            best
        }
    })
}

/// The angle from -pi to pi.
fn wrapped(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}

/// Whether two states are the same, or two of the same line.
fn same(a: &BoundState, b: &BoundState) -> bool {
    let neutral = a.is_neutral() && b.is_neutral();
    // Newton's method finds a neutral one less well.
    let close = if neutral { SAME_IF_NEUTRAL } else { SAME };
    let apart = |i: usize| wrapped(a.angles_rad[i] - b.angles_rad[i]).abs();
    (neutral && a.outcome == b.outcome)
        || ((a.gap.ln() - b.gap.ln()).abs() < close && apart(0) < close && apart(1) < close)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_state_and_its_images_are_one() {
        let expected = ([2.0, -0.3], 0.1);
        let close = |(angles, turning): ([f64; 2], f64)| {
            (angles.iter().zip(expected.0)).all(|(a, b)| (a - b).abs() < 1e-15)
                && (turning - expected.1).abs() < 1e-15
        };
        for (angles, turning) in [
            ([0.3, -2.0], -0.1),
            ([-2.0, 0.3], -0.1),
            ([2.0, -0.3], 0.1),
            ([-0.3, 2.0], 0.1),
        ] {
            assert!(close(canonical(angles, turning)), "{angles:?}");
        }
        // At rest there is no sense of turning to tell the images apart by.
        assert!(canonical([-0.5, 0.5], 0.0).0[0] > 0.0);
    }
}
