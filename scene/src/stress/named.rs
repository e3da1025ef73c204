//! Names of stresslets and rates of work, for tables and files.
//!
//! Each name ends with the number of the loaded sphere and that of the sphere that moves or squirms. Names of equal spheres by slip have
//! the loaded sphere alone: sphere 1 squirms. With `d` from the active sphere `k` to the other one, `p_t` the part of its orientation across
//! `d`, `c = p.d` and `V_n = 8 P_n''/((n-1) n (n+1) (n+2))`:
//!
//! ```text
//! XG, YG    stresslet by velocity, per 4 pi mu a_1^2, with the signs of Kim & Karrila, Microhydrodynamics (2005), chapter 7:
//! YH        by angular velocity, per 8 pi mu a_1^3.   S(i) = -sum_k G(ik).U(k) + H(ik).omega(k)
//! XS_n      by squirming, per pi mu a_k^2 B_n:   XS P_n(c) (d d - I/3)
//! YS_n                                           YS W_n(c) (d p_t + p_t d)
//! ZS_n                                           ZS V_n(c) (p_t p_t - p_t^2 (I - d d)/2)
//! YSC_n     by swirl, per pi mu a_k^2 C_n:       YSC W_n(c) (d q + q d),   q = d x p_t
//! ZSC_n                                          ZSC V_n(c) (p_t q + q p_t)/2
//! XP_n_m    rate of work of slip on slip, both spheres still, per pi mu a B_n B_m, a the radius of the sphere named first:
//!                                                XP P_n(c) P_m(c')
//! YP_n_m                                         YP W_n(c) W_m(c') p_t.p_t'
//! ZP_n_m                                         ZP V_n(c) V_m(c') (2 (p_t.p_t')^2 - p_t^2 p_t'^2)
//! M3P_n_m   likewise of order 3 and higher:      2 (n-3)!/(n+3)! P_n'''(c), and Re[conj(p_t^3) p_t'^3] of p_t as a complex number
//! XPC, ...  of swirl on swirl, per C_n C_m
//! YPBC, ... of squirming n of the sphere named first on swirl m of the other one, per B_n C_m
//! ```
//!
//! Of swirl, a quarter turn about `d` goes with the angular factor: `d x p_t` in place of `p_t` in order 1, and `p_t^m` as a complex number times `i` for
//! sphere 1 and `-i` for sphere 2 in order `m`.
//!
//! Work on the same sphere has the number 1 of equal spheres, across the gap the number 2 (sphere 1 with mode `n`, sphere 2 with mode `m`). The power
//! of a pair of squirmers that are held is the sum over all pairs of modes: pairs of different ones count twice. Alone, a sphere has
//! `XS_2 = YS_2 = ZS_2 = 4`, and `XP_2_2 = 8/3`, `YP_2_2 = 8`, `ZP_2_2 = 2`.

use std::f64::consts::PI;

use super::{Block, BlockStresses, Cause, Stresses};
use crate::are_unlike;

impl BlockStresses {
    /// Place of a cause among the columns.
    fn place(&self, (sphere, cause): (usize, Cause)) -> Option<usize> {
        let place = self.causes.iter().position(|of| *of == cause)?;
        Some(sphere * self.causes.len() + place)
    }

    /// Stresslet of the sphere `on` (0 or 1) by a unit cause of the sphere `by.0`; `None` if the block has none.
    #[must_use]
    pub fn stresslet(&self, on: usize, by: (usize, Cause)) -> Option<f64> {
        self.stresslets.get(on)?.get(self.place(by)?).copied()
    }

    /// Rate of work of a unit cause of the sphere `of.0` against the tractions by one of the sphere `by.0`; `None` if the block has none.
    #[must_use]
    pub fn rate_of_work(&self, of: (usize, Cause), by: (usize, Cause)) -> Option<f64> {
        self.work.get((self.place(of)?, self.place(by)?)).copied()
    }
}

impl Stresses {
    /// The block of causes of one kind, if there is one.
    #[must_use]
    pub fn block(&self, block: Block) -> Option<&BlockStresses> {
        self.blocks.iter().find(|of| of.block == block)
    }

    /// Every number with its name, for spheres whose radii are in the given `ratio`, that of sphere 2 over that of sphere 1. The module's
    /// documentation defines the names; all numbers are pure.
    #[must_use]
    pub fn named(&self, ratio: f64) -> Vec<(String, f64)> {
        let naming = Naming {
            of: self,
            radii: [1.0, ratio],
            is_unlike: are_unlike(ratio),
        };
        let mut named = naming.by_motion();
        named.extend(naming.by_slip());
        named.extend(naming.of_work());
        named
    }
}

/// Letter of an azimuthal order.
fn letter(order: usize) -> String {
    match order {
        0 => "X".to_owned(),
        1 => "Y".to_owned(),
        2 => "Z".to_owned(),
        more => format!("M{more}"),
    }
}

struct Naming<'a> {
    of: &'a Stresses,
    radii: [f64; 2],
    is_unlike: bool,
}

impl Naming<'_> {
    /// XG, YG and YH.
    fn by_motion(&self) -> Vec<(String, f64)> {
        let loaded = if self.is_unlike { 0..2 } else { 0..1 };
        let kinds = [
            ("XG", 0, Cause::Translation, 4.0),
            ("YG", 1, Cause::Translation, 4.0),
            ("YH", 1, Cause::Rotation, 8.0),
        ];
        let mut named = Vec::new();
        for (kind, order, cause, unit) in kinds {
            for on in loaded.clone() {
                for by in [0, 1] {
                    // Here what moves has its own `d`; there `d` is that of sphere 1.
                    let sign = if by == 1 && cause == Cause::Translation {
                        1.0
                    } else {
                        -1.0
                    };
                    let block = self.of.block(Block::Order(order));
                    let found = block.and_then(|of| of.stresslet(on, (by, cause)));
                    named.extend(found.map(|found| {
                        let name = format!("{kind}{}{}", on + 1, by + 1);
                        (name, sign * found / (unit * PI))
                    }));
                }
            }
        }
        named
    }

    /// XS to ZSC.
    fn by_slip(&self) -> Vec<(String, f64)> {
        let active = if self.is_unlike { 0..2 } else { 0..1 };
        let squirming = (1..=self.of.modes).map(|n| (n, "", Cause::Squirming(n)));
        let swirl = (1..=self.of.swirl).map(|n| (n, "C", Cause::Swirl(n)));
        let mut named = Vec::new();
        for (n, kind, cause) in squirming.chain(swirl) {
            for order in 0..=2 {
                let Some(block) = self.of.block(Block::Order(order)) else {
                    continue;
                };
                // The amplitude of order 2 is V_n p_t^2/4, and p_t^2 stands for 2 (p_t p_t - p_t^2 (I - d d)/2).
                let share = if order == 2 { 0.5 } else { 1.0 };
                for by in active.clone() {
                    let unit = PI * self.radii[by].powi(2);
                    for on in [by, 1 - by] {
                        let numbers = if self.is_unlike {
                            format!("{}{}", on + 1, by + 1)
                        } else {
                            (on + 1).to_string()
                        };
                        let found = block.stresslet(on, (by, cause));
                        named.extend(found.map(|found| {
                            let name = format!("{}S{kind}{numbers}_{n}", letter(order));
                            (name, share * found / unit)
                        }));
                    }
                }
            }
        }
        named
    }

    /// XP and the others.
    fn of_work(&self) -> Vec<(String, f64)> {
        let highest = self.of.modes.max(self.of.swirl);
        let mut named = Vec::new();
        for order in 0..=highest {
            named.extend(self.pairs("", order, self.squirming(), self.squirming()));
            named.extend(self.pairs("C", order, self.swirl(), self.swirl()));
            if order > 0 {
                named.extend(self.pairs("BC", order, self.squirming(), self.swirl()));
            }
        }
        named
    }

    fn squirming(&self) -> impl Iterator<Item = (usize, Cause)> + Clone + use<> {
        (1..=self.of.modes).map(|n| (n, Cause::Squirming(n)))
    }

    fn swirl(&self) -> impl Iterator<Item = (usize, Cause)> + Clone + use<> {
        (1..=self.of.swirl).map(|n| (n, Cause::Swirl(n)))
    }

    /// Rates of work of one order between two kinds of modes.
    fn pairs(
        &self,
        kind: &str,
        order: usize,
        first: impl Iterator<Item = (usize, Cause)>,
        second: impl Iterator<Item = (usize, Cause)> + Clone,
    ) -> Vec<(String, f64)> {
        let block = match (order, kind) {
            (0, "C") => Block::Twist,
            _ => Block::Order(order),
        };
        let Some(block) = self.of.block(block) else {
            return Vec::new();
        };
        let mixed = kind == "BC";
        // Spheres of the first and the second mode, with their name. What one squirmer's slip does against its own swirl adds up to nothing.
        let spheres: &[(usize, usize, &str)] = match (self.is_unlike, mixed) {
            (false, false) => &[(0, 0, "1"), (0, 1, "2")],
            (false, true) => &[(0, 1, "2")],
            (true, false) => &[(0, 0, "11"), (1, 1, "22"), (0, 1, "12")],
            (true, true) => &[(0, 1, "12"), (1, 0, "21")],
        };
        // The amplitude of order 2 is V_n p_t^2/4.
        let share = if order == 2 { 1.0 / 16.0 } else { 1.0 };
        let mut named = Vec::new();
        for (n, one) in first {
            for (m, two) in second.clone() {
                for &(of, by, numbers) in spheres {
                    // The reciprocal theorem, and exchange of equal spheres.
                    let told = m < n && !mixed && (of == by || !self.is_unlike);
                    let found = block.rate_of_work((of, one), (by, two));
                    if let (false, Some(found)) = (told, found) {
                        let name = format!("{}P{kind}{numbers}_{n}_{m}", letter(order));
                        named.push((name, share * found / (PI * self.radii[of])));
                    }
                }
            }
        }
        named
    }
}

#[cfg(test)]
mod tests;
