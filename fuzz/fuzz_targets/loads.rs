//! Any gap, ratio and set of loads has finite loads or one line that says why not; naming the spheres the other way round gives the same loads.

#![no_main]

use std::sync::LazyLock;

use arbitrary::Arbitrary;
use exact::Exact;
use fuzz::{Number, finite, one_line};
use libfuzzer_sys::fuzz_target;
use lt::{Form, Lubrication, UnlikeLubrication};
use scene::{ActiveLoads, Gap, Hydrodynamics, LoadSet, SceneError};

#[derive(Arbitrary, Debug)]
struct Input {
    gap: Number,
    ratio: Number,
    modes: u8,
    swirl: u8,
    many: Option<usize>,
    parts: [bool; 5],
    published: bool,
    exact: bool,
}

/// Fitted once.
static EQUAL: LazyLock<Exact> = LazyLock::new(Exact::new);

fn set(input: &Input) -> LoadSet {
    let mut set = LoadSet::all(input.many.unwrap_or(usize::from(input.modes % 10)));
    set = set.with_swirl(usize::from(input.swirl % 10));
    let [a, b, c, d, twist] = input.parts;
    (set.axial.sum, set.axial.difference) = (a, b);
    (set.transverse.sum, set.transverse.difference) = (c, d);
    set.twist = twist;
    set
}

fn of_each(model: &dyn Hydrodynamics, eps: f64, set: LoadSet) -> Option<[ActiveLoads; 2]> {
    let gap = Gap::new(eps).map_err(|error| one_line(&error)).ok()?;
    let told = |error: SceneError| one_line(&error);
    if let Err(error) = model.loads(gap, set) {
        told(error);
    }
    if let Err(error) = model.error_estimate(gap, set) {
        told(error);
    }
    let loads = model.interacting_loads_of_each(gap, set);
    let loads = loads.map_err(told).ok()?;
    for (loads, active) in loads.iter().zip([1, 2]) {
        for (name, value) in loads.named(active) {
            finite(&name, value);
        }
    }
    Some(loads)
}

/// Checks that the loads of one sphere are those of the other one in a pair that is named the other way round.
fn same(one: &ActiveLoads, other: &ActiveLoads, tolerance: f64) {
    for ((name, value), (_, found)) in one.named(1).into_iter().zip(other.named(1)) {
        let scale = value.abs().max(found.abs()).max(1.0);
        assert!(
            (value - found).abs() <= tolerance * scale,
            "{name} = {value:e} and {found:e}"
        );
    }
}

fuzz_target!(|input: Input| {
    let (set, eps, ratio) = (set(&input), input.gap.value(), input.ratio.value());
    let form = if input.published {
        Form::Published
    } else {
        Form::Corrected
    };
    of_each(&Lubrication::new(form), eps, set);
    let model = UnlikeLubrication::new(form, ratio);
    let swapped = UnlikeLubrication::new(form, 1.0 / ratio);
    match (model, swapped) {
        (Ok(model), Ok(swapped)) => {
            let loads = of_each(&model, eps, set);
            let other = of_each(&swapped, eps / ratio, set);
            // Where the gap keeps its digits.
            if (1e-300..1e300).contains(&eps)
                && let (Some([one, two]), Some([second, first])) = (loads, other)
            {
                same(&one, &first, 1e-11);
                same(&two, &second, 1e-11);
            }
        }
        (model, _) => {
            if let Err(error) = model {
                one_line(&error);
            }
        }
    }
    if !input.exact {
        return;
    }
    of_each(&*EQUAL, eps, set);
    match Exact::of_ratio(ratio) {
        Err(error) => one_line(&error),
        // Series of few terms: the limiting forms are fitted anew for each ratio, which takes long.
        Ok(model) if (0.1..=10.0).contains(&eps) && (0.1..=10.0).contains(&ratio) => {
            let loads = of_each(&model, eps, set);
            let swapped = Exact::of_ratio(1.0 / ratio).expect("an inverse within the range");
            let other = of_each(&swapped, eps / ratio, set);
            if let (Some([one, two]), Some([second, first])) = (loads, other) {
                same(&one, &first, 1e-8);
                same(&two, &second, 1e-8);
            }
        }
        Ok(_) => {}
    }
});
