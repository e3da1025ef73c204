//! The equation of motion: loads, balance and kinematics put together.

use super::chart::Chart;
use crate::mobility::{
    External, Heading, MobilitySet, ModeMobility, PairMobility, PairVelocity, Transverse,
    pair_velocity,
};
use crate::ode::System;
use crate::{Gap, Gravity, Hydrodynamics, LoadSet, MAX_MODES, Repulsion, SceneError, Squirmer};

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

/// An effect of which it is known while running whether the scene calls for it.
impl<T: Copy> Effect<T> for Option<T> {
    #[inline]
    fn get(&self) -> Option<T> {
        *self
    }
}

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

    /// The loads of `set` with those left out that these coordinates never read, so that the compiler sees it.
    fn read(set: LoadSet) -> LoadSet;
    /// Orientations in the pair frame.
    fn headings(&self, y: &[f64; N]) -> [Heading<Self::Across>; 2];
    /// Torques of gravity as `T x d`, per `pi mu a^2`.
    fn gravity_torques(
        &self,
        y: &[f64; N],
        gravity: Gravity,
        squirmers: &[Squirmer; 2],
    ) -> [Self::Across; 2];
    /// Time derivative of the state at an instant, by its headings and the coefficients of its model, with room for those of `M` modes.
    ///
    /// # Errors
    /// The model's.
    #[inline(always)]
    fn motion<const M: usize, H, G>(
        &self,
        y: &[f64; N],
        headings: &[Heading<Self::Across>; 2],
        at: &Instant<'_, H, G>,
    ) -> Result<[f64; N], SceneError>
    where
        H: Hydrodynamics + ?Sized,
        G: Effect<Gravity>,
    {
        derivative::<M, _, _, _, N>(self, y, headings, at)
    }
    /// Velocity of the pair without swirl.
    #[inline(always)]
    fn velocity(
        mobility: (&PairMobility, &[ModeMobility]),
        squirmers: &[Squirmer; 2],
        headings: &[Heading<Self::Across>; 2],
        external: &External<Self::Across>,
    ) -> PairVelocity<Self::Across> {
        pair_velocity(mobility, squirmers, headings, external)
    }
    /// Time derivative of the state for a velocity of the pair.
    fn derivative(&self, y: &[f64; N], velocity: &PairVelocity<Self::Across>) -> [f64; N];
    /// Torques of gravity about the line of centres, per `pi mu a^2`. None in a plane, to which its torques are perpendicular.
    #[inline(always)]
    fn axial_torques(
        &self,
        _y: &[f64; N],
        _gravity: Gravity,
        _squirmers: &[Squirmer; 2],
    ) -> Option<[f64; 2]> {
        None
    }
    /// Adds spins about the line of centres to a derivative; they change nothing in a plane.
    #[inline(always)]
    fn add_axial_spin(&self, _y: &[f64; N], _dy: &mut [f64; N], _spins: [f64; 2]) {}
    /// The transverse headings turned by a quarter about the line of centres, where swirl acts.
    #[inline(always)]
    fn turned(
        &self,
        _y: &[f64; N],
        _headings: &[Heading<Self::Across>; 2],
    ) -> Option<[Self::Across; 2]> {
        None
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
        // One or two modes, the usual numbers, are known to the compiler: it keeps their mobilities out of memory. Two are inside the
        // stepper's loop; other numbers are compiled once.
        match self.set.modes {
            2 => self.evaluate::<2, N>(y, 2),
            1 => self.evaluate_one(y),
            _ => self.evaluate_many(y),
        }
    }
}

impl<H, C, R, G> PairMotion<'_, H, C, R, G>
where
    H: Hydrodynamics + ?Sized,
    R: Effect<Repulsion>,
    G: Effect<Gravity>,
{
    /// The right-hand side with so many modes, and room for `M`.
    #[inline(always)]
    fn evaluate<const M: usize, const N: usize>(&mut self, y: &[f64; N], modes: usize) -> [f64; N]
    where
        C: Dynamics<N>,
    {
        let set = C::read(LoadSet { modes, ..self.set });
        let headings = self.coordinates.headings(y);
        let gap = Gap::from_ln(y[self.coordinates.ln_gap()]);
        self.loads += 1;
        let instant = self.instant(gap, gap, set);
        match (self.coordinates).motion::<M, H, G>(y, &headings, &instant) {
            Ok(dy) => dy,
            Err(error) => self.refused(y, error),
        }
    }

    /// The right-hand side with one mode.
    #[inline(never)]
    fn evaluate_one<const N: usize>(&mut self, y: &[f64; N]) -> [f64; N]
    where
        C: Dynamics<N>,
    {
        self.evaluate::<2, N>(y, 1)
    }

    /// The right-hand side with any number of modes.
    #[inline(never)]
    fn evaluate_many<const N: usize>(&mut self, y: &[f64; N]) -> [f64; N]
    where
        C: Dynamics<N>,
    {
        self.evaluate::<MAX_MODES, N>(y, self.set.modes)
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
        let set = C::read(self.set);
        (self.coordinates)
            .motion::<MAX_MODES, H, G>(y, &headings, &self.instant(gap, end, set))
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
    /// The coefficients that are read.
    #[inline(always)]
    pub fn mobility_set(&self) -> MobilitySet {
        MobilitySet {
            loads: self.set,
            torque: self.gravity.get().is_some(),
        }
    }

    /// Torques of gravity about the line of centres.
    #[inline(always)]
    pub fn axial_torques<C: Dynamics<N>, const N: usize>(
        &self,
        coordinates: &C,
        y: &[f64; N],
    ) -> Option<[f64; 2]> {
        let gravity = self.gravity.get()?;
        coordinates.axial_torques(y, gravity, self.squirmers)
    }

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
pub(super) fn derivative<const M: usize, H, C, G, const N: usize>(
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
    let (mut pair, mut modes) = (PairMobility::default(), [ModeMobility::default(); M]);
    (at.model).interacting_mobility(at.gap, at.mobility_set(), (&mut pair, &mut modes))?;
    let external = at.external(coordinates, y);
    let read = &modes[..at.set.modes.min(M)];
    let velocity = C::velocity((&pair, read), at.squirmers, headings, &external);
    let mut dy = coordinates.derivative(y, &velocity);
    if let Some([t1, t2]) = at.axial_torques(coordinates, y) {
        coordinates.add_axial_spin(y, &mut dy, pair.twist.spins(t1 + t2, t1 - t2));
    }
    Ok(dy)
}
