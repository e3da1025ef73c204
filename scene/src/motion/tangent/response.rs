//! What all directions share at an instant: each squirmer's slip, and how a velocity answers to a change of its heading.

use nalgebra::Vector3;

use crate::legendre::legendre_with_slope;
use crate::mobility::{Across, Heading, Mobility, Slip};
use crate::{Legendre, MAX_MODES};

/// One squirmer at an instant.
pub(super) struct OfEach {
    pub heading: Heading<Vector3<f64>>,
    /// The transverse heading turned by a quarter about the line of centres.
    pub turned: Vector3<f64>,
    /// The orders with their slopes `dW_n/dc`.
    pub orders: [(Legendre, f64); MAX_MODES],
}

impl OfEach {
    /// With so many orders.
    pub fn new(heading: Heading<Vector3<f64>>, line: &Vector3<f64>, count: usize) -> Self {
        let mut orders = [(
            Legendre {
                p: 0.0,
                derivative: 0.0,
                w: 0.0,
            },
            0.0,
        ); MAX_MODES];
        for (to, order) in (orders.iter_mut().take(count)).zip(legendre_with_slope(heading.cosine))
        {
            *to = order;
        }
        Self {
            turned: heading.turned(line),
            heading,
            orders,
        }
    }

    /// What modes of these strengths do, with the vector `across` of their slip across the line of centres.
    pub fn slip(
        &self,
        strengths: &[f64],
        across: Vector3<f64>,
    ) -> impl Iterator<Item = Slip<Vector3<f64>>> {
        (strengths.iter().zip(&self.orders)).map(move |(b, (order, _))| Slip {
            along: b * order.p,
            across: across * (b * order.w),
        })
    }
}

/// The parts of a velocity that are across the line of centres: mean velocity, turning, and the spin of each squirmer.
pub(super) type AcrossParts<T> = [T; 4];

pub(super) fn parts(of: &Across) -> AcrossParts<f64> {
    [
        of.mean_transverse,
        of.turning,
        of.mean_spin + of.counter_spin,
        of.mean_spin - of.counter_spin,
    ]
}

/// How the velocity of a pair answers to a change of one squirmer's heading: what all directions share.
#[derive(Clone, Copy)]
pub(super) struct Response {
    /// Opening, mean velocity along the line and both spins about it, by the cosine.
    pub along: [f64; 4],
    /// Parts across the line, by the cosine.
    pub by_cosine: AcrossParts<Vector3<f64>>,
    /// The same by the transverse heading, and by that turned by a quarter.
    pub by_transverse: AcrossParts<f64>,
    pub by_turned: AcrossParts<f64>,
}

impl Response {
    /// Of a squirmer with these strengths of squirming and swirl modes.
    pub fn new(of: &OfEach, by: &Mobility, squirming: &[f64], swirling: &[f64]) -> Self {
        let (mut along, mut by_transverse, mut by_turned) = ([0.0; 4], [0.0; 4], [0.0; 4]);
        let mut slopes = [[0.0; 4]; 2];
        let add = |to: &mut AcrossParts<f64>, across: &Across, weight: f64| {
            for (to, part) in to.iter_mut().zip(parts(across)) {
                *to += weight * part;
            }
        };
        for ((b, mode), (order, w_slope)) in squirming.iter().zip(&by.modes).zip(&of.orders) {
            along[0] += b * order.derivative * mode.opening;
            along[1] += b * order.derivative * mode.mean_axial;
            add(&mut by_transverse, &mode.across, b * order.w);
            add(&mut slopes[0], &mode.across, b * w_slope);
        }
        for ((c, mode), (order, w_slope)) in swirling.iter().zip(&by.swirl).zip(&of.orders) {
            let about = c * order.derivative;
            let [one, two] = mode.twist.spins(about, about);
            along[2] += one;
            along[3] += two;
            add(&mut by_turned, &mode.across, c * order.w);
            add(&mut slopes[1], &mode.across, c * w_slope);
        }
        Self {
            along,
            by_cosine: std::array::from_fn(|i| {
                of.heading.transverse * slopes[0][i] + of.turned * slopes[1][i]
            }),
            by_transverse,
            by_turned,
        }
    }
}
