//! The equation of motion: loads, balance and kinematics put together.

use super::coordinates::Coordinates;
use crate::balance::{External, Heading};
use crate::ode::System;
use crate::{Gap, Gravity, Hydrodynamics, LoadSet, PairLoads, Repulsion, SceneError, Squirmer};

/// An effect that the compiler knows to be there or not, so that an absent one leaves no trace.
pub(crate) trait Effect<T>: Copy {
    /// The effect, if it is there.
    fn get(&self) -> Option<T>;
}

/// An effect that the scene does not call for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Absent;

impl<T> Effect<T> for Absent {
    #[inline]
    fn get(&self) -> Option<T> {
        None
    }
}

/// An effect that the scene calls for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Present<T>(pub T);

impl<T: Copy> Effect<T> for Present<T> {
    #[inline]
    fn get(&self) -> Option<T> {
        Some(self.0)
    }
}

/// Right-hand side of a pair's motion in the coordinates `C`.
pub(crate) struct PairMotion<'a, H: ?Sized, C, R, G> {
    pub model: &'a H,
    pub coordinates: C,
    pub squirmers: [Squirmer; 2],
    pub set: LoadSet,
    pub repulsion: R,
    pub gravity: G,
    /// Whether a trial state at a gap below the model's range has the loads of the smallest gap in it, so that the
    /// end of the range can be located; otherwise the model fails there.
    pub held_below_range: bool,
    /// Why the last right-hand side could not be computed, if it could not.
    pub failure: Option<SceneError>,
    /// Loads evaluated so far.
    pub loads: u64,
}

impl<H, C, R, G, const N: usize> System<N> for PairMotion<'_, H, C, R, G>
where
    H: Hydrodynamics + ?Sized,
    C: Coordinates<N>,
    R: Effect<Repulsion>,
    G: Effect<Gravity>,
{
    // The stepper's loop over stages has it inside, its state in registers; others call one copy of it.
    #[inline(always)]
    fn rhs(&mut self, _t: f64, y: &[f64; N]) -> [f64; N] {
        // Two modes, the usual number, are known to the compiler: it keeps their loads out of memory.
        match self.set.modes {
            2 => self.evaluate(
                y,
                LoadSet {
                    modes: 2,
                    ..self.set
                },
            ),
            _ => self.evaluate(y, self.set),
        }
    }
}

impl<H, C, R, G> PairMotion<'_, H, C, R, G>
where
    H: Hydrodynamics + ?Sized,
    R: Effect<Repulsion>,
    G: Effect<Gravity>,
{
    /// The right-hand side with the loads of `set`.
    #[inline(always)]
    fn evaluate<const N: usize>(&mut self, y: &[f64; N], set: LoadSet) -> [f64; N]
    where
        C: Coordinates<N>,
    {
        // First what waits for nothing: sines overlap with the gap's exponential and the repulsion's.
        let headings = self.coordinates.headings(y);
        let gap = Gap::from_ln(y[C::LN_GAP]);
        self.loads += 1;
        let instant = Instant {
            model: self.model,
            set,
            squirmers: &self.squirmers,
            gap,
            repulsion: self.repulsion.get().map_or(0.0, |r| r.force(gap)),
            gravity: self.gravity,
            held_below_range: self.held_below_range,
        };
        self.coordinates
            .motion(y, &headings, &instant, &mut self.failure)
    }
}

/// What a right-hand side reads besides the state.
pub(crate) struct Instant<'a, H: ?Sized, G> {
    pub model: &'a H,
    pub set: LoadSet,
    pub squirmers: &'a [Squirmer; 2],
    pub gap: Gap,
    /// Force that drives the two apart, per `pi mu a`.
    pub repulsion: f64,
    pub gravity: G,
    pub held_below_range: bool,
}

impl<H: ?Sized, G: Copy> Clone for Instant<'_, H, G> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<H: ?Sized, G: Copy> Copy for Instant<'_, H, G> {}

impl<H: Hydrodynamics + ?Sized, G> Instant<'_, H, G> {
    /// The smallest gap of the model's range where the pair is below it and loads are held there.
    pub fn end_of_range(&self) -> Option<Gap> {
        let smallest = self.model.range().smallest;
        (self.held_below_range && self.gap.eps() < smallest)
            .then(|| Gap::new(smallest).ok())
            .flatten()
    }
}

impl<H: ?Sized, G: Effect<Gravity>> Instant<'_, H, G> {
    /// Loads of other than hydrodynamic origin.
    #[inline(always)]
    pub fn external<C: Coordinates<N>, const N: usize>(
        &self,
        coordinates: &C,
        y: &[f64; N],
    ) -> External<C::Across> {
        External {
            repulsion: self.repulsion,
            torque: (self.gravity.get())
                .map(|gravity| coordinates.gravity_torques(y, gravity, self.squirmers)),
        }
    }
}

/// Time derivative of the state `y` without swirl; where the model fails, what it said is kept: a trial step went too
/// far. The stepper retries with a shorter one if nothing is a number then.
#[inline(always)]
pub(super) fn derivative<H, C, G, const N: usize>(
    coordinates: &C,
    y: &[f64; N],
    headings: &[Heading<C::Across>; 2],
    at: &Instant<'_, H, G>,
    failure: &mut Option<SceneError>,
) -> [f64; N]
where
    H: Hydrodynamics + ?Sized,
    C: Coordinates<N>,
    G: Effect<Gravity>,
{
    // Matched by reference: the loads are too large to be moved about.
    let loads = at.model.interacting_loads(at.gap, at.set);
    match &loads {
        Ok(loads) => derivative_by(coordinates, y, headings, at, loads),
        // By value: what is pointed to would have to be in memory also where the model answers.
        Err(error) => derivative_below_range(*coordinates, y, *headings, *at, error, failure),
    }
}

/// The same where the model fails, by the loads of its smallest gap below that; nothing is a number where they are
/// not held there.
#[cold]
#[inline(never)]
fn derivative_below_range<H, C, G, const N: usize>(
    coordinates: C,
    y: &[f64; N],
    headings: [Heading<C::Across>; 2],
    at: Instant<'_, H, G>,
    error: &SceneError,
    failure: &mut Option<SceneError>,
) -> [f64; N]
where
    H: Hydrodynamics + ?Sized,
    C: Coordinates<N>,
    G: Effect<Gravity>,
{
    *failure = Some(error.clone());
    let Some(gap) = at.end_of_range() else {
        return [f64::NAN; N];
    };
    // The gap too: by its own, held loads would close it ever faster.
    let at = Instant { gap, ..at };
    match &at.model.interacting_loads(gap, at.set) {
        Ok(loads) => derivative_by(&coordinates, y, &headings, &at, loads),
        Err(_) => [f64::NAN; N],
    }
}

/// Time derivative of the state `y` by the given loads.
#[inline(always)]
fn derivative_by<H, C, G, const N: usize>(
    coordinates: &C,
    y: &[f64; N],
    headings: &[Heading<C::Across>; 2],
    at: &Instant<'_, H, G>,
    loads: &PairLoads,
) -> [f64; N]
where
    H: Hydrodynamics + ?Sized,
    C: Coordinates<N>,
    G: Effect<Gravity>,
{
    let external = at.external(coordinates, y);
    let velocity = C::velocity(at.gap, loads, at.squirmers, headings, &external);
    let mut dy = coordinates.derivative(y, &velocity);
    if let Some(gravity) = at.gravity.get() {
        coordinates.add_axial_spin(y, &mut dy, loads, gravity, at.squirmers);
    }
    dy
}
