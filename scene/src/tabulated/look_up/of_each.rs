//! Tabulated columns of unlike radii as they are read.

use super::{across, laid_out, put};
use crate::mobility::{MobilityOfEach, MobilitySet, ModeMobility, SwirlMobility, Twist};
use crate::tabulated::build::Tabulation;
use crate::tabulated::columns::{BASE_MODES, Group};
use crate::tabulated::parts::{Parts, Place};
use crate::{Gap, LoadSet};

/// What is tabulated of unlike radii, in pairs of columns: first those by the causes of squirmer 1, then of squirmer 2.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::tabulated) struct ColumnsOfEach {
    /// Opening and mean axial velocity by the modes 1 and 2 of each, and by repulsion.
    axial: Parts<5>,
    /// Mean transverse velocity, counter spin, turning and mean spin by the modes 1 and 2 of each, and by the torque on each.
    across: Parts<12>,
    /// Spins about `d` by the torque on each.
    about: Parts<2>,
    /// All by each squirming mode from 3 on.
    modes: Vec<Parts<6>>,
    /// All by each swirl mode.
    swirl: Vec<Parts<6>>,
}

impl ColumnsOfEach {
    /// Lays out a tabulation for look-ups; one that is of equal radii is left out.
    pub fn take(&mut self, group: Group, tabulation: &Tabulation, usual: &[u32]) {
        let of = (tabulation, usual);
        match group {
            Group::AxialOfEach => self.axial = laid_out(of),
            Group::AcrossOfEach => self.across = laid_out(of),
            Group::AboutOfEach => self.about = laid_out(of),
            Group::ModeOfEach(n) => put(&mut self.modes, n - BASE_MODES - 1, of),
            Group::SwirlOfEach(n) => put(&mut self.swirl, n - 1, of),
            _ => {}
        }
    }

    /// The coefficients of `set`, or their derivatives; none if one is not tabulated.
    pub fn read<const SLOPE: bool>(
        &self,
        place: &Place<SLOPE>,
        set: MobilitySet,
    ) -> Option<MobilityOfEach> {
        let mut mobility = MobilityOfEach::default();
        let [first, second] = &mut mobility.by;
        let ([one, two, ..], [three, four, ..]) = (&mut first.modes, &mut second.modes);
        let modes = [one, two, three, four];
        if set.loads.axial.any() {
            let [a, b, c, d, repulsion] = self.axial.at(place)?;
            for (of, [opening, mean_axial]) in [a, b, c, d].into_iter().enumerate() {
                (modes[of].opening, modes[of].mean_axial) = (opening, mean_axial);
            }
            [first.pair.repulsion, mobility.mean_axial_by_repulsion] = repulsion;
        }
        if set.loads.transverse.any() {
            let by_slip: [[f64; 2]; 8] = self.across.at(place)?;
            for (mode, of) in modes.into_iter().zip(by_slip.chunks_exact(2)) {
                mode.across = across(of[0], of[1]);
            }
            if set.torque {
                let [.., a, b, c, d]: [[f64; 2]; 12] = self.across.at(place)?;
                (first.pair.torque, second.pair.torque) = (across(a, b), across(c, d));
            }
        }
        if set.loads.twist {
            let by_torque: [[f64; 2]; 2] = self.about.at(place)?;
            for (by, [mean, half_difference]) in mobility.by.iter_mut().zip(by_torque) {
                by.pair.twist = Twist {
                    mean,
                    half_difference,
                };
            }
        }
        for n in BASE_MODES..set.loads.modes {
            let of_mode: [[f64; 2]; 6] = self.modes.get(n - BASE_MODES)?.at(place)?;
            for (by, of) in mobility.by.iter_mut().zip(of_mode.chunks_exact(3)) {
                let [opening, mean_axial] = of[0];
                by.modes[n] = ModeMobility {
                    opening,
                    mean_axial,
                    across: across(of[1], of[2]),
                };
            }
        }
        for n in 0..set.loads.swirl {
            let of_mode: [[f64; 2]; 6] = self.swirl.get(n)?.at(place)?;
            for (by, of) in mobility.by.iter_mut().zip(of_mode.chunks_exact(3)) {
                let [mean, half_difference] = of[0];
                by.swirl[n] = SwirlMobility {
                    twist: Twist {
                        mean,
                        half_difference,
                    },
                    across: across(of[1], of[2]),
                };
            }
        }
        Some(mobility)
    }
}

/// From what is tabulated far apart, with the centres at `distance`, to the coefficients: by [`FarScale`](crate::mobility::FarScale).
pub(in crate::tabulated) fn shrink_of_each(
    mobility: &mut MobilityOfEach,
    set: MobilitySet,
    gap: Gap,
    distance: f64,
) {
    for by in &mut mobility.by {
        super::shrink(
            gap,
            distance,
            &mut by.pair,
            &mut by.modes[..set.loads.modes],
        );
        for swirl in &mut by.swirl[..set.loads.swirl] {
            swirl.across.turning /= distance;
        }
    }
}

/// [`shrink_slopes`](super::shrink_slopes) of what is tabulated of unlike radii.
pub(in crate::tabulated) fn shrink_slopes_of_each(
    mobility: &MobilityOfEach,
    slopes: &mut MobilityOfEach,
    set: MobilitySet,
    gap: Gap,
    distance: f64,
) {
    let by_distance = gap.eps() / distance;
    let LoadSet { modes, swirl, .. } = set.loads;
    for (by, slope) in mobility.by.iter().zip(&mut slopes.by) {
        super::shrink_slopes(
            gap,
            distance,
            (&by.pair, &by.modes[..modes]),
            (&mut slope.pair, &mut slope.modes[..modes]),
        );
        for (of_mode, slope) in by.swirl[..swirl].iter().zip(&mut slope.swirl) {
            slope.across.turning =
                slope.across.turning / distance - by_distance * of_mode.across.turning;
        }
    }
}
