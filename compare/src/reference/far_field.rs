//! The coefficients of motion far apart, in closed form.
//!
//! By Faxen's laws, with one reflection from the other sphere, whose stresslet is `20 pi/3` times the strain in which it lies
//! (Kim & Karrila, *Microhydrodynamics* (2005), chapters 3, 8 and 11). A squirmer's own flow is that of Lighthill and Blake: a potential
//! dipole by the first mode, and by the second a stresslet with a degenerate quadrupole.

use serde::Serialize;

use crate::columns::columns;

columns! {
    /// A row for each term of each coefficient of motion of two equal spheres far apart, `coefficient r^-power`, where `r` is the distance of the
    /// centres. Names are those of mobilities.csv.
    #[derive(Clone, Debug, PartialEq, Serialize)]
    pub struct FarFieldRow {
        /// Effect, cause and squirming mode.
        #[unit = "-"]
        pub name: String,
        /// What the coefficient of motion is multiplied by: `1`, or `gap`. The opening is a rate of the logarithm of the gap; times
        /// the gap it is a velocity.
        #[unit = "-"]
        pub times: &'static str,
        /// Power of the inverse distance.
        #[unit = "-"]
        pub power: u32,
        /// The term's coefficient as a fraction.
        #[unit = "-"]
        pub fraction: String,
        /// The same as a number, in units of a and mu.
        #[unit = "varies"]
        pub coefficient: f64,
        /// Power of the inverse distance with which the sum of the terms left out falls, at least.
        #[unit = "-"]
        pub next_power: u32,
    }
}

/// A coefficient of motion: effect and cause, mode or 0, what it is multiplied by, the power of the first term left out, and powers with
/// numerators and denominators.
type Series = (
    &'static str,
    u32,
    &'static str,
    u32,
    &'static [(u32, i32, i32)],
);

const OPENING: &str = "opening, d(ln eps)/dt by q1 + q2";
const AXIAL: &str = "mean velocity along d by q1 - q2";
const ACROSS: &str = "mean velocity across d by s1 + s2";
const COUNTER: &str = "half the difference of the spins across d by s1 + s2";
const TURNING: &str = "turning of d by s1 - s2";
const SPIN: &str = "mean spin across d by s1 - s2";

#[rustfmt::skip]
const SERIES: [Series; 19] = [
    ("opening, d(ln eps)/dt by f", 0, "gap", 6, &[(0, 1, 3), (1, -1, 2), (3, 1, 3), (4, -5, 4)]),
    (OPENING, 1, "gap", 8, &[(0, -2, 3), (3, 2, 3), (6, 5, 1)]),
    (OPENING, 2, "gap", 7, &[(2, -1, 1), (4, 2, 1), (5, -5, 1)]),
    (AXIAL, 1, "1", 8, &[(0, 1, 3), (3, 1, 3), (6, -5, 2)]),
    (AXIAL, 2, "1", 7, &[(2, -1, 2), (4, 1, 1), (5, 5, 2)]),
    (ACROSS, 1, "1", 8, &[(0, 1, 3), (3, -1, 6)]),
    (ACROSS, 2, "1", 7, &[(4, -1, 1)]),
    (COUNTER, 1, "1", 9, &[(7, 5, 4)]),
    (COUNTER, 2, "1", 8, &[(3, -3, 4), (6, -15, 8)]),
    (TURNING, 1, "1", 9, &[(1, -2, 3), (4, -1, 3)]),
    (TURNING, 2, "1", 8, &[(5, -2, 1)]),
    (SPIN, 1, "1", 9, &[(7, 5, 4)]),
    (SPIN, 2, "1", 8, &[(3, 3, 4), (6, -15, 8)]),
    ("mean velocity across d by t1 - t2", 0, "1", 7, &[(2, 1, 16)]),
    ("half the difference of the spins across d by t1 - t2", 0, "1", 8, &[(0, 1, 16), (3, 1, 32), (6, -15, 64)]),
    ("turning of d by t1 + t2", 0, "1", 8, &[(3, 1, 8)]),
    ("mean spin across d by t1 + t2", 0, "1", 8, &[(0, 1, 16), (3, -1, 32), (6, -15, 64)]),
    ("mean spin about d by (T1 + T2) . d", 0, "1", 8, &[(0, 1, 16), (3, 1, 16)]),
    ("half the difference of the spins about d by (T1 - T2) . d", 0, "1", 8, &[(0, 1, 16), (3, -1, 16)]),
];

/// The terms of all coefficients.
#[must_use]
pub fn far_field() -> Vec<FarFieldRow> {
    let of = |&(name, mode, times, next_power, terms): &Series| {
        let name = match mode {
            0 => name.to_owned(),
            mode => format!("{name}, mode {mode}"),
        };
        let row = move |&(power, over, under): &(u32, i32, i32)| FarFieldRow {
            name: name.clone(),
            times,
            power,
            fraction: match under {
                1 => over.to_string(),
                under => format!("{over}/{under}"),
            },
            coefficient: f64::from(over) / f64::from(under),
            next_power,
        };
        terms.iter().map(row)
    };
    SERIES.iter().flat_map(of).collect()
}
