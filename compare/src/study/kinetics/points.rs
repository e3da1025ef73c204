//! Quasi-random points: Owen-scrambled Sobol sequences. Each seed is an independent randomisation, from which sampling errors follow.

use sobol_burley::sample;

/// Largest number of points of one randomisation. Further points come from the next one.
pub const MOST: usize = 1 << 16;

/// The point `index` of a randomisation in the unit cube, each coordinate from 0 to 1.
#[must_use]
pub fn point(index: usize, seed: u32) -> [f64; 3] {
    // The last bits that single precision leaves out are filled by another sequence of the same kind.
    let of = |dimension: u32| {
        let coarse = f64::from(sample((index % MOST) as u32, dimension, seed));
        let fine = f64::from(sample((index % MOST) as u32, dimension + 3, seed));
        coarse + fine / f64::from(1 << 24)
    };
    [of(0), of(1), of(2)]
}
