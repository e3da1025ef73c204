//! The equation of motion: loads, balance and kinematics put together.

use super::chart::Chart;
use crate::balance::{External, Heading, PairVelocity, Transverse, pair_velocity};
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

/// The equation of motion in coordinates of dimension `N`.
pub(crate) trait Dynamics<const N: usize>: Chart<N> + Copy {
    /// What is perpendicular to the line of centres.
    type Across: Transverse;
    /// Whether headings take sines.
    const SINES: bool = true;

    /// Orientations in the pair frame.
    fn headings(&self, y: &[f64; N]) -> [Heading<Self::Across>; 2];
    /// Torques of gravity as `T x d`, per `pi mu a^2`.
    fn gravity_torques(
        &self,
        y: &[f64; N],
        gravity: Gravity,
        squirmers: &[Squirmer; 2],
    ) -> [Self::Across; 2];
    /// Time derivative of the state at an instant, by its headings and the loads of its model.
    ///
    /// # Errors
    /// The model's.
    #[inline(always)]
    fn motion<H, G>(
        &self,
        y: &[f64; N],
        headings: &[Heading<Self::Across>; 2],
        at: &Instant<'_, H, G>,
    ) -> Result<[f64; N], SceneError>
    where
        H: Hydrodynamics + ?Sized,
        G: Effect<Gravity>,
    {
        derivative(self, y, headings, at)
    }
    /// Velocity of the pair without swirl.
    #[inline(always)]
    fn velocity(
        gap: Gap,
        loads: &PairLoads,
        squirmers: &[Squirmer; 2],
        headings: &[Heading<Self::Across>; 2],
        external: &External<Self::Across>,
    ) -> PairVelocity<Self::Across> {
        pair_velocity(gap, loads, squirmers, headings, external)
    }
    /// Time derivative of the state for a velocity of the pair.
    fn derivative(&self, y: &[f64; N], velocity: &PairVelocity<Self::Across>) -> [f64; N];
    /// What gravity adds to [`Self::derivative`]: spin about the line of centres. Nothing in a plane, to which
    /// its torques are perpendicular.
    #[inline]
    fn add_axial_spin(
        &self,
        _y: &[f64; N],
        _dy: &mut [f64; N],
        _loads: &PairLoads,
        _gravity: Gravity,
        _squirmers: &[Squirmer; 2],
    ) {
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
    C: Dynamics<N>,
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
        C: Dynamics<N>,
    {
        // Sines come first: they wait for nothing and overlap with the gap's exponential and the repulsion's. Headings
        // without sines come last: over those calls they would have to be put aside.
        let sines = C::SINES.then(|| self.coordinates.headings(y));
        let gap = Gap::from_ln(y[self.coordinates.ln_gap()]);
        self.loads += 1;
        let instant = self.instant(gap, gap, set);
        let headings = sines.unwrap_or_else(|| self.coordinates.headings(y));
        match (self.coordinates).motion(y, &headings, &instant) {
            Ok(dy) => dy,
            Err(error) => self.refused(y, error),
        }
    }

    /// What the right-hand side reads at the gap of a state and at that at which the model is asked.
    #[inline(always)]
    fn instant(&self, gap: Gap, asked: Gap, set: LoadSet) -> Instant<'_, H, G> {
        Instant {
            model: self.model,
            set,
            squirmers: &self.squirmers,
            gap: asked,
            repulsion: self.repulsion.get().map_or(0.0, |r| r.force(gap)),
            gravity: self.gravity,
        }
    }

    /// The right-hand side where the model fails, and what it said is kept: a trial step went too far. Below its range
    /// it is asked at the end of that, if loads are held there; else nothing is a number, and the stepper retries
    /// with a shorter step.
    #[cold]
    #[inline(never)]
    fn refused<const N: usize>(&mut self, y: &[f64; N], error: SceneError) -> [f64; N]
    where
        C: Dynamics<N>,
    {
        self.failure = Some(error);
        let gap = Gap::from_ln(y[self.coordinates.ln_gap()]);
        let smallest = self.model.range().smallest;
        let end = Gap::new(smallest).ok();
        let Some(end) = end.filter(|_| self.held_below_range && gap.eps() < smallest) else {
            return [f64::NAN; N];
        };
        // Its gap too: by their own, held loads would close it ever faster.
        let headings = self.coordinates.headings(y);
        (self.coordinates)
            .motion(y, &headings, &self.instant(gap, end, self.set))
            .unwrap_or([f64::NAN; N])
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
}

impl<H: ?Sized, G: Effect<Gravity>> Instant<'_, H, G> {
    /// Loads of other than hydrodynamic origin.
    #[inline(always)]
    pub fn external<C: Dynamics<N>, const N: usize>(
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

/// Time derivative of the state `y` without swirl.
///
/// # Errors
/// The model's.
#[inline(always)]
pub(super) fn derivative<H, C, G, const N: usize>(
    coordinates: &C,
    y: &[f64; N],
    headings: &[Heading<C::Across>; 2],
    at: &Instant<'_, H, G>,
) -> Result<[f64; N], SceneError>
where
    H: Hydrodynamics + ?Sized,
    C: Dynamics<N>,
    G: Effect<Gravity>,
{
    // Matched by reference: the loads are too large to be moved about.
    let loads = at.model.interacting_loads(at.gap, at.set);
    let loads = match &loads {
        Ok(loads) => loads,
        Err(error) => return Err(error.clone()),
    };
    let external = at.external(coordinates, y);
    let velocity = C::velocity(at.gap, loads, at.squirmers, headings, &external);
    let mut dy = coordinates.derivative(y, &velocity);
    if let Some(gravity) = at.gravity.get() {
        coordinates.add_axial_spin(y, &mut dy, loads, gravity, at.squirmers);
    }
    Ok(dy)
}
