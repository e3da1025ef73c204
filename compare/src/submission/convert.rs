//! From mobilities to loads and back: the balance of two spheres, in sums and differences over them.
//!
//! With the signs of [`scene::loads`] and [`super::KINDS`], along the line of centres and about it each combination is one number, across it a symmetric
//! 2 x 2 matrix, between `[U1 +- U2, w1 -+ w2]` and `[F1 +- F2, T1 -+ T2]` (spins as `omega x d`, torques as `T x d`, loads per `pi`):
//!
//! ```text
//! resistance   6 (Y11A +- Y12A),  -4 (Y11B +- Y12B),  8 (Y11C -+ Y12C)
//! mobility     (y11a +- y12a)/6,  (y11b -+ y12b)/4,  (y11c -+ y12c)/8
//! ```

use scene::SelfOther;

use super::quantity::{LOADS, PAIRS, Quantity, RIGID, SQUIRMING, Values};

/// Places among the pairs of scalars, of resistances and, counted from [`LOADS`], of mobilities.
const XA: usize = 0;
const YA: usize = 1;
const YB: usize = 2;
const XC: usize = 3;
const YC: usize = 4;

/// Which combination over the two spheres.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Parity {
    Sum,
    Difference,
}

use Parity::{Difference, Sum};

impl Parity {
    fn of(self, pair: SelfOther) -> f64 {
        match self {
            Sum => pair.sum,
            Difference => pair.difference,
        }
    }

    fn crossed(self) -> Self {
        match self {
            Sum => Difference,
            Difference => Sum,
        }
    }
}

/// A symmetric 2 x 2 matrix: first, mixed and last entry.
#[derive(Clone, Copy)]
struct Block([f64; 3]);

impl Block {
    fn inverse(self) -> Self {
        let [a, b, c] = self.0;
        let one = 1.0 / (a * c - b * b);
        Self([c * one, -b * one, a * one])
    }

    fn times(self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [a, b, c] = self.0;
        [a * x + b * y, b * x + c * y]
    }
}

/// Pairs of quantities as they are given.
pub(super) trait Given: Fn(usize) -> Option<SelfOther> {}

impl<F: Fn(usize) -> Option<SelfOther>> Given for F {}

fn resistance(given: &impl Given, parity: Parity) -> Option<Block> {
    Some(Block([
        6.0 * parity.of(given(YA)?),
        -4.0 * parity.of(given(YB)?),
        8.0 * parity.crossed().of(given(YC)?),
    ]))
}

fn mobility(given: &impl Given, parity: Parity) -> Option<Block> {
    let crossed = parity.crossed();
    Some(Block([
        parity.of(given(LOADS + YA)?) / 6.0,
        crossed.of(given(LOADS + YB)?) / 4.0,
        crossed.of(given(LOADS + YC)?) / 8.0,
    ]))
}

/// A pair of quantities from its sum and its difference.
fn pair_of(of: impl Fn(Parity) -> Option<f64>) -> Option<SelfOther> {
    let pair = SelfOther {
        sum: of(Sum)?,
        difference: of(Difference)?,
    };
    (pair.sum.abs() + pair.difference.abs())
        .is_finite()
        .then_some(pair)
}

/// Mode and kind (axial, transverse, turning) of a quantity by slip.
fn by_slip(place: usize) -> (usize, usize) {
    (place / 3, place % 3)
}

/// The pairs of mobilities and velocities that a pair of loads follows from. None of loads by swirl.
fn sources(load: usize) -> Option<Vec<usize>> {
    let across = [YA, YB, YC].map(|scalar| LOADS + scalar);
    Some(match load {
        XA | XC => vec![LOADS + load],
        YA | YB | YC => across.to_vec(),
        _ if load < SQUIRMING => {
            let (n, kind) = by_slip(load - 5);
            let velocity = RIGID + 3 * n;
            match kind {
                0 => vec![LOADS + XA, velocity],
                _ => across
                    .into_iter()
                    .chain([velocity + 1, velocity + 2])
                    .collect(),
            }
        }
        _ => return None,
    })
}

/// The pair that is missing for a pair of loads: among its sources where nothing but mobilities and velocities is held.
pub(super) fn lacking(load: usize, is_held: impl Fn(usize) -> bool) -> usize {
    let of_loads = (0..LOADS).any(&is_held);
    let sources = sources(load)
        .filter(|_| !of_loads)
        .unwrap_or_else(|| vec![load]);
    sources
        .into_iter()
        .find(|&pair| !is_held(pair))
        .unwrap_or(load)
}

/// The pair of loads with this place, from mobilities and velocities.
pub(super) fn load(given: &impl Given, load: usize) -> Option<SelfOther> {
    match load {
        XA | XC => pair_of(|parity| Some(1.0 / parity.of(given(LOADS + load)?))),
        YA | YB | YC => {
            let resistance = |parity| Some(mobility(given, parity)?.inverse().0);
            match load {
                YA => pair_of(|parity| Some(resistance(parity)?[0] / 6.0)),
                YB => pair_of(|parity| Some(resistance(parity)?[1] / -4.0)),
                _ => pair_of(|parity| Some(resistance(parity.crossed())?[2] / 8.0)),
            }
        }
        _ if load < SQUIRMING => {
            let (n, kind) = by_slip(load - 5);
            let velocity = |k: usize| given(RIGID + 3 * n + k);
            if kind == 0 {
                return pair_of(|parity| {
                    Some(6.0 * parity.of(velocity(0)?) / parity.of(given(LOADS + XA)?))
                });
            }
            let loads = |parity: Parity| {
                let [u, w] = [parity.of(velocity(1)?), parity.crossed().of(velocity(2)?)];
                Some(mobility(given, parity)?.inverse().times([u, w]))
            };
            match kind {
                1 => pair_of(|parity| Some(loads(parity)?[0])),
                _ => pair_of(|parity| Some(loads(parity.crossed())?[1])),
            }
        }
        _ => None,
    }
}

/// The pair of mobilities or velocities with this place, from loads.
fn velocity(given: &impl Given, place: usize) -> Option<SelfOther> {
    let Some(slip) = place.checked_sub(RIGID) else {
        let scalar = place - LOADS;
        let mobility = |parity| Some(resistance(given, parity)?.inverse().0);
        return match scalar {
            XA | XC => pair_of(|parity| Some(1.0 / parity.of(given(scalar)?))),
            YA => pair_of(|parity| Some(6.0 * mobility(parity)?[0])),
            YB => pair_of(|parity| Some(4.0 * mobility(parity.crossed())?[1])),
            _ => pair_of(|parity| Some(8.0 * mobility(parity.crossed())?[2])),
        };
    };
    let (n, kind) = by_slip(slip);
    let load = |k: usize| given(5 + 3 * n + k);
    if kind == 0 {
        return pair_of(|parity| Some(parity.of(load(0)?) / (6.0 * parity.of(given(XA)?))));
    }
    let velocities = |parity: Parity| {
        let [f, t] = [parity.of(load(1)?), parity.crossed().of(load(2)?)];
        Some(resistance(given, parity)?.inverse().times([f, t]))
    };
    match kind {
        1 => pair_of(|parity| Some(velocities(parity)?[0])),
        _ => pair_of(|parity| Some(velocities(parity.crossed())?[1])),
    }
}

/// What is not given and follows from what is: loads from mobilities, mobilities from loads.
pub(crate) fn derived(values: &Values) -> Values {
    let given = |pair: usize| values.pair(pair);
    let mut derived = Values::default();
    for pair in 0..PAIRS {
        let missing = |of: usize| values.get(Quantity(of)).is_none();
        if !(missing(2 * pair) && missing(2 * pair + 1)) {
            continue;
        }
        let follows = if pair < LOADS {
            load(&given, pair)
        } else {
            velocity(&given, pair)
        };
        if let Some(follows) = follows {
            derived.set_pair(pair, follows);
        }
    }
    derived
}
