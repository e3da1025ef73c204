//! What the tests of the series share.

use std::collections::HashMap;
use std::sync::{LazyLock, Mutex, PoisonError};

use exact::Exact;
use scene::{Gap, Hydrodynamics, LoadSet, PairLoads};

/// All loads there are.
pub const EVERYTHING: LoadSet = LoadSet::all(8).with_swirl(8);

/// The model of equal spheres, its form near contact fitted once for all tests.
pub static EQUAL: LazyLock<Exact> = LazyLock::new(|| {
    let exact = Exact::new();
    exact.contact_constants(LoadSet::all(0)).expect("a fit");
    exact
});

/// The model of a ratio, the same one for all tests.
pub fn model(ratio: f64) -> &'static Exact {
    static MODELS: LazyLock<Mutex<HashMap<u64, &'static Exact>>> = LazyLock::new(Mutex::default);
    let mut models = MODELS.lock().expect("no test panics here");
    models
        .entry(ratio.to_bits())
        .or_insert_with(|| Box::leak(Box::new(Exact::of_ratio(ratio).expect("a ratio"))))
}

/// The model of a ratio with its form near contact for sets with swirl. Tests that ask for it at the same time wait for one fit.
pub fn fitted(ratio: f64) -> &'static Exact {
    static FITS: Mutex<()> = Mutex::new(());
    let model = model(ratio);
    let _one_at_a_time = FITS.lock().unwrap_or_else(PoisonError::into_inner);
    model
        .interacting_loads_of_each(at(1e-6 * f64::min(ratio, 1.0)), EVERYTHING)
        .expect("a fit");
    model
}

/// The gap `eps`.
pub fn at(eps: f64) -> Gap {
    Gap::new(eps).expect("a positive gap")
}

/// Largest difference of two sets of loads, relative to the larger of the load and 1.
pub fn distance(a: &PairLoads, b: &PairLoads) -> f64 {
    a.columns()
        .zip(b.columns())
        .map(|(a, b)| (a - b).abs() / b.abs().max(1.0))
        .fold(0.0, f64::max)
}
