//! From a plan to the one equation of motion that is compiled for it.

use super::coordinates::{Axisymmetric, MirrorSymmetric, Planar, PointSymmetric, Spatial};
use super::equations::{Absent, Dynamics, Effect, PairMotion, Present};
use super::swirling::Swirl;
use super::unlike::Unlike;
use crate::{Gravity, Hydrodynamics, Plan, Repulsion, State};

/// What is done with an equation of motion.
pub(super) trait Task: Sized {
    type Output;

    fn perform<H, C, R, G, const N: usize>(
        self,
        plan: &Plan,
        motion: PairMotion<'_, H, C, R, G>,
    ) -> Self::Output
    where
        H: Hydrodynamics + ?Sized,
        C: Dynamics<N>,
        R: Effect<Repulsion>,
        G: Effect<Gravity>;
}

/// Performs `task` on the equation of motion of `plan`.
pub(super) fn dispatch<H: Hydrodynamics + ?Sized, T: Task>(
    plan: &Plan,
    model: &H,
    task: T,
) -> T::Output {
    let start = &plan.start_in_frame();
    if plan.has_unlike_radii() {
        return of_unlike(plan, model, task);
    }
    match plan.state() {
        State::Axisymmetric => with_repulsion(plan, model, task, Axisymmetric::new(start), Absent),
        State::PointSymmetric => {
            with_repulsion(plan, model, task, PointSymmetric::new(start), Absent)
        }
        State::MirrorSymmetric => with_gravity(plan, model, task, MirrorSymmetric::new(start)),
        State::Planar => {
            let plane = Planar {
                z: start.midpoint.z,
            };
            with_gravity(plan, model, task, plane)
        }
        State::Spatial if plan.swirl() > 0 => {
            let swirl = Present(Swirl);
            with_gravity(plan, model, task, Spatial { swirl })
        }
        State::Spatial => with_gravity(plan, model, task, Spatial { swirl: Absent }),
    }
}

/// The same for unlike radii, which no exchange symmetry goes with.
fn of_unlike<H: Hydrodynamics + ?Sized, T: Task>(plan: &Plan, model: &H, task: T) -> T::Output {
    let start = &plan.start_in_frame();
    match plan.state() {
        State::Axisymmetric => {
            let coordinates = Unlike(Axisymmetric::new(start));
            task.perform(plan, effects(plan, model, coordinates))
        }
        State::Spatial => {
            let swirl = (plan.swirl() > 0).then_some(Swirl);
            task.perform(plan, effects(plan, model, Unlike(Spatial { swirl })))
        }
        State::Planar | State::PointSymmetric | State::MirrorSymmetric => {
            let z = start.midpoint.z;
            task.perform(plan, effects(plan, model, Unlike(Planar { z })))
        }
    }
}

/// The equation of motion with effects that are known while it runs.
fn effects<'a, H: ?Sized, C>(
    plan: &Plan,
    model: &'a H,
    coordinates: C,
) -> PairMotion<'a, H, C, Option<Repulsion>, Option<Gravity>> {
    motion(
        plan,
        model,
        coordinates,
        plan.repulsion(),
        plan.gravity_in_frame(),
    )
}

fn with_gravity<H, C, T, const N: usize>(
    plan: &Plan,
    model: &H,
    task: T,
    coordinates: C,
) -> T::Output
where
    H: Hydrodynamics + ?Sized,
    C: Dynamics<N>,
    T: Task,
{
    match plan.gravity_in_frame() {
        Some(gravity) => with_repulsion(plan, model, task, coordinates, Present(gravity)),
        None => with_repulsion(plan, model, task, coordinates, Absent),
    }
}

fn with_repulsion<H, C, T, G, const N: usize>(
    plan: &Plan,
    model: &H,
    task: T,
    coordinates: C,
    gravity: G,
) -> T::Output
where
    H: Hydrodynamics + ?Sized,
    C: Dynamics<N>,
    T: Task,
    G: Effect<Gravity>,
{
    match plan.repulsion() {
        Some(repulsion) => {
            let motion = motion(plan, model, coordinates, Present(repulsion), gravity);
            task.perform(plan, motion)
        }
        None => {
            let motion = motion(plan, model, coordinates, Absent, gravity);
            task.perform(plan, motion)
        }
    }
}

fn motion<'a, H: ?Sized, C, R, G>(
    plan: &Plan,
    model: &'a H,
    coordinates: C,
    repulsion: R,
    gravity: G,
) -> PairMotion<'a, H, C, R, G> {
    PairMotion {
        model,
        coordinates,
        squirmers: plan.scene().squirmers,
        set: plan.load_set(),
        repulsion,
        gravity,
        held_below_range: false,
        failure: None,
        loads: 0,
    }
}
