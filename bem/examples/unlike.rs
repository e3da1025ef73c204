//! Errors of spheres of unlike radii against `exact`, at random ratios and gaps, and what the model's own estimates are worth.
//!
//! `cargo run --release -p squirmers-bem --example unlike [level] [count] [largest ratio]`
//!
//! Ratios are spread log-uniformly between the largest one and its inverse (5 by default), gaps from 0.005 (0.02 at level 1) to 5 radii of the smaller sphere. The
//! loads are all those of modes 1 and 2, squirming and swirl, by either sphere; errors are relative to the larger of the load and 1.

use bem::{Bem, Estimates};
use exact::Exact;
use scene::{ActiveLoads, Gap, Hydrodynamics, LoadSet};

type Failure = Box<dyn std::error::Error>;

/// Estimates under the names of the loads.
fn named(of: &Estimates, active: usize) -> Vec<(String, f64)> {
    let as_loads = ActiveLoads {
        pair: of.loads,
        torque_on_other: of.torque_on_other,
        swirl: of.swirl,
    };
    as_loads.named(active)
}

/// For each load its name, its error and the estimate of that, both relative.
fn errors(model: &Bem, gap: Gap, set: LoadSet) -> Result<Vec<(String, f64, f64)>, Failure> {
    let truth = Exact::of_ratio(model.description().ratio)?.interacting_loads_of_each(gap, set)?;
    let (found, estimates) = model.solve_each_with_estimates(gap, set)?;
    let of_sphere = |k: usize| {
        let loads = (found.loads[k].named(k + 1).into_iter()).zip(truth[k].named(k + 1));
        (loads.zip(named(&estimates[k], k + 1))).map(|(((name, a), (_, b)), (_, estimate))| {
            let scale = b.abs().max(1.0);
            (name, (a - b).abs() / scale, estimate / scale)
        })
    };
    Ok(of_sphere(0).chain(of_sphere(1)).collect())
}

fn main() -> Result<(), Failure> {
    let mut arguments = std::env::args().skip(1);
    let level = arguments
        .next()
        .map_or(Ok(Bem::DEFAULT_LEVEL), |s| s.parse())?;
    let count: u32 = arguments.next().map_or(Ok(200), |s| s.parse())?;
    let unlike: f64 = arguments.next().map_or(Ok(5.0), |s| s.parse())?;
    let least: f64 = if level == 1 { 0.02 } else { 0.005 };
    let set = LoadSet::all(2).with_swirl(2);
    let (mut held, mut loads, mut over) = (0, 0, 0);
    let (mut worst, mut most) = ((String::new(), 0.0), (String::new(), 0.0));
    let mut pessimism = Vec::new();
    for k in 0..count {
        // Multiples of two irrational numbers fill the square evenly.
        let share = |of: f64| (f64::from(k + 1) * of).fract();
        let ratio = unlike.powf(2.0 * share(0.754_877_666_246_693) - 1.0);
        let gap = least * (5.0 / least).powf(share(0.569_840_290_998_053));
        let at = format!("ratio {ratio:.3}, gap {gap:.4} of the smaller radius");
        let model = Bem::of_ratio(level, ratio)?;
        let found = errors(&model, Gap::new(gap * ratio.min(1.0))?, set)?;
        let error = found.iter().map(|e| e.1).fold(0.0, f64::max);
        let estimate = found.iter().map(|e| e.2).fold(0.0, f64::max);
        held += u32::from(error <= estimate);
        pessimism.push(estimate / error);
        for (name, error, estimate) in found {
            loads += 1;
            over += u32::from(error > estimate);
            if error > worst.1 {
                worst = (format!("{name}, {at}"), error);
            }
            if error / estimate > most.1 {
                most = (
                    format!("{name} of error {error:.1e}, {at}"),
                    error / estimate,
                );
            }
        }
    }
    pessimism.sort_by(f64::total_cmp);
    println!("level {level}, {count} pairs");
    println!("worst error {:.1e}: {}", worst.1, worst.0);
    println!("largest error within the largest estimate: {held} of {count}");
    println!(
        "estimate over error, in the middle: {:.1}",
        pessimism[pessimism.len() / 2]
    );
    println!(
        "loads beyond their own estimate: {over} of {loads}, at most {:.2} times: {}",
        most.1, most.0
    );
    Ok(())
}
