//! Motion of a pair of unlike radii: each squirmer's causes have coefficients of their own.

use super::{
    Across, External, Heading, Mobility, MobilitySet, PairVelocity, SwirlMobility, Transverse,
};
use crate::{Squirmer, legendre};

/// The coefficients of a pair of unlike radii at one gap. Where the two are equal, those of squirmer 1 and 2 follow from sums and
/// differences of causes, as in the [module](super); here they multiply the causes of either squirmer themselves.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MobilityOfEach {
    /// By the causes of each squirmer, `q_k, s_k, r_k, t_k` and `T_k . d`. Repulsion, which is one cause, opens the gap by that of squirmer 1;
    /// that of squirmer 2 is zero.
    pub by: [Mobility; 2],
    /// Mean velocity along `d` per repulsive force.
    pub mean_axial_by_repulsion: f64,
}

impl MobilityOfEach {
    /// Every coefficient of `set` by the causes of squirmer 1, then by those of squirmer 2, with its effect, its cause and its mode, such as
    /// `opening, d(ln eps)/dt by q1, mode 2`.
    #[must_use]
    pub fn named(&self, set: MobilitySet) -> Vec<(String, f64)> {
        let of = |k: usize| {
            // Repulsion is one cause.
            let named = self.by[k].named(set).into_iter();
            let named = named.filter(move |(name, _)| k == 0 || !name.ends_with(" by f"));
            named.map(move |(name, value)| (of_squirmer(&name, k + 1), value))
        };
        let drift = (
            "mean velocity along d by f".to_owned(),
            self.mean_axial_by_repulsion,
        );
        of(0).chain(of(1)).chain([drift]).collect()
    }
}

/// The name of a coefficient with the cause of one squirmer instead of a combination of both.
fn of_squirmer(name: &str, squirmer: usize) -> String {
    let Some((effect, cause)) = name.split_once(" by ") else {
        return name.to_owned();
    };
    let (cause, mode) = cause.split_once(", mode").unwrap_or((cause, ""));
    let kind = match cause {
        _ if cause.starts_with('(') => format!("T{squirmer} . d"),
        _ if cause.starts_with('C') => format!("C_n P_n(c{squirmer})"),
        "f" => "f".to_owned(),
        _ => cause
            .chars()
            .take(1)
            .chain(squirmer.to_string().chars())
            .collect(),
    };
    let mode = if mode.is_empty() {
        String::new()
    } else {
        format!(", mode{mode}")
    };
    format!("{effect} by {kind}{mode}")
}

/// Motion across `d` by a cause, as it is added up.
#[derive(Clone, Copy)]
struct Sum<T> {
    mean_transverse: T,
    turning: T,
    spin: [T; 2],
}

impl<T: Transverse> Sum<T> {
    fn none(zero: T) -> Self {
        Self {
            mean_transverse: zero,
            turning: zero,
            spin: [zero; 2],
        }
    }

    fn add(&mut self, of: &Across, cause: T) {
        self.mean_transverse = self.mean_transverse + cause * of.mean_transverse;
        self.turning = self.turning + cause * of.turning;
        let [one, two] = self.spin;
        self.spin = [
            one + cause * (of.mean_spin + of.counter_spin),
            two + cause * (of.mean_spin - of.counter_spin),
        ];
    }
}

/// Velocities of a pair of squirmers of unlike radii, which are free but for `external`, by the first `modes` squirming modes;
/// `headings` in the pair frame.
pub fn velocity_of_each<T: Transverse>(
    mobility: &MobilityOfEach,
    modes: usize,
    squirmers: &[Squirmer; 2],
    headings: &[Heading<T>; 2],
    external: &External<T>,
) -> PairVelocity<T> {
    let mut across = Sum::none(headings[0].transverse * 0.0);
    let mut opening = mobility.by[0].pair.repulsion * external.repulsion;
    let mut mean_axial = mobility.mean_axial_by_repulsion * external.repulsion;
    for (k, heading) in headings.iter().enumerate() {
        let by = &mobility.by[k];
        for ((n, mode), order) in
            (by.modes.iter().enumerate().take(modes)).zip(legendre(heading.cosine))
        {
            let b = squirmers[k].mode(n);
            opening += b * order.p * mode.opening;
            mean_axial += b * order.p * mode.mean_axial;
            across.add(&mode.across, heading.transverse * (b * order.w));
        }
        if let Some(torque) = external.torque {
            across.add(&by.pair.torque, torque[k]);
        }
    }
    PairVelocity {
        opening,
        mean_axial,
        mean_transverse: across.mean_transverse,
        turning: across.turning,
        spin: across.spin,
    }
}

/// Adds the motion across `d` by swirl, and returns the spin of each squirmer about `d` by it; `turned` are the transverse headings
/// turned by a quarter, `d x v`.
pub fn add_swirl_of_each<T: Transverse>(
    velocity: &mut PairVelocity<T>,
    mobility: &MobilityOfEach,
    squirmers: &[Squirmer; 2],
    (headings, turned): (&[Heading<T>; 2], &[T; 2]),
) -> [f64; 2] {
    let mut across = Sum {
        mean_transverse: velocity.mean_transverse,
        turning: velocity.turning,
        spin: velocity.spin,
    };
    let mut axial = [0.0; 2];
    for k in [0, 1] {
        let of_modes = mobility.by[k].swirl.iter().zip(squirmers[k].swirl());
        for ((of, strength), order) in of_modes.zip(legendre(headings[k].cosine)) {
            let SwirlMobility {
                twist,
                across: of_across,
            } = of;
            across.add(of_across, turned[k] * (strength * order.w));
            let about = strength * order.p;
            let spins = twist.spins(about, about);
            axial = [axial[0] + spins[0], axial[1] + spins[1]];
        }
    }
    velocity.mean_transverse = across.mean_transverse;
    velocity.turning = across.turning;
    velocity.spin = across.spin;
    axial
}
