//! The gap at which a run ends because it closes.

use super::outcome::Outcome;
use crate::{Gap, Hydrodynamics};

/// Gap at which spheres that nothing keeps apart are in contact. Without repulsion lubrication theory
/// closes it as `exp(-exp(t))`: they never touch, but come this close in a finite time.
const TOUCHING_GAP: f64 = 1e-300;

/// The gap at which a run ends that nothing opens again.
#[derive(Clone, Copy, Debug)]
pub(super) struct Floor {
    pub gap: Gap,
    pub outcome: Outcome,
}

impl Floor {
    pub fn of<H: Hydrodynamics + ?Sized>(model: &H) -> Self {
        let smallest = model.range().smallest;
        if smallest > TOUCHING_GAP {
            Self {
                gap: Gap::from_ln(smallest.ln()),
                outcome: Outcome::Unresolved,
            }
        } else {
            Self {
                gap: Gap::from_ln(TOUCHING_GAP.ln()),
                outcome: Outcome::Contact,
            }
        }
    }
}
