//! Prints errors against `exact` far apart, as solved and shifted to the lone sphere's closed form, by gap and level.
//!
//! `cargo run --release -p squirmers-bem --example far_field [highest level]`
//!
//! Each error is the largest over the 22 loads of modes 1 and 2, relative to the larger of the load and 1, with the load
//! that has it; that of the estimate is the largest of error over estimate, load by load.

use bem::Bem;
use exact::Exact;
use scene::{Gap, Hydrodynamics, LoadSet, PairLoads};

type Failure = Box<dyn std::error::Error>;

const GAPS: [f64; 9] = [1.0, 1.024, 1.0241, 1.1, 2.0, 5.0, 10.0, 30.0, 100.0];

fn worst(loads: &PairLoads, truth: &PairLoads) -> (String, f64) {
    let rows = loads.named().into_iter().zip(truth.named());
    rows.map(|((name, a), (_, b))| (name, (a - b).abs() / b.abs().max(1.0)))
        .max_by(|a, b| a.1.total_cmp(&b.1))
        .unwrap_or_default()
}

fn main() -> Result<(), Failure> {
    let highest = std::env::args().nth(1).map_or(Ok(3), |s| s.parse())?;
    let (exact, set) = (Exact::new(), LoadSet::all(2));
    println!("level      gap   as solved          shifted            error/estimate");
    for level in 1..=highest {
        let model = Bem::new(level)?;
        for eps in GAPS {
            let gap = Gap::new(eps)?;
            let truth = exact.loads(gap, set)?;
            let solved = bem::pair::solve(model.family(gap), eps, set)?.loads;
            let (shifted, estimates) = model.solve_with_estimates(gap, set)?;
            let (of_solved, as_solved) = worst(&solved, &truth);
            let (of_shifted, as_shifted) = worst(&shifted.loads, &truth);
            let rows = (shifted.loads.named().into_iter()).zip(truth.named());
            let (of_ratio, ratio) = (rows.zip(estimates.loads.named()))
                .map(|(((name, a), (_, b)), (_, e))| (name, (a - b).abs() / e))
                .max_by(|a, b| a.1.total_cmp(&b.1))
                .unwrap_or_default();
            println!(
                "{level:5} {eps:8} {as_solved:9.1e} {of_solved:7}  {as_shifted:9.1e} {of_shifted:7}  {ratio:7.2} {of_ratio}"
            );
        }
    }
    Ok(())
}
