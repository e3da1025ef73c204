//! Prints errors against `exact` by gap and level, with the observed order in the size of panels.
//!
//! `cargo run --release -p squirmers-bem --example referee [highest level] [gap,gap,...]`
//!
//! The error is the largest over the 22 loads of modes 1 and 2, relative to the larger of the load and
//! 1, thrusts XF1_1 and YF1_1 to the larger of the load and 4.

use bem::Bem;
use exact::Exact;
use scene::{Gap, Hydrodynamics, LoadSet};

type Failure = Box<dyn std::error::Error>;

fn main() -> Result<(), Failure> {
    let mut arguments = std::env::args().skip(1);
    let highest = arguments.next().map_or(Ok(5), |s| s.parse())?;
    let gaps = arguments.next().map_or_else(
        || Ok(vec![1.0, 0.1, 0.01, 0.001]),
        |s| {
            s.split(',')
                .map(str::parse)
                .collect::<Result<Vec<f64>, _>>()
        },
    )?;
    let exact = Exact::new();
    println!("    eps level nodes aspect    error  order estimate assembly  solve  worst");
    for eps in gaps {
        let gap = Gap::new(eps)?;
        let truth = exact.loads(gap, LoadSet::all(2))?;
        let mut before: Option<(f64, f64)> = None;
        for level in 1..=highest {
            let model = Bem::new(level)?;
            if let Err(error) = model.check(gap) {
                println!("{error}");
                continue;
            }
            let solution = model.solve(gap, LoadSet::all(2))?;
            let (name, error) = solution.loads.worst_error(&truth);
            let nodes = solution.nodes as f64;
            let order = before.map_or(f64::NAN, |(e, n)| 2.0 * (e / error).ln() / (nodes / n).ln());
            before = Some((error, nodes));
            println!(
                "{eps:7.0e} {level:5} {nodes:5} {:6.2} {error:8.1e} {order:6.1} {:8.1e} {:8.3} {:6.3}  {name}",
                model.family(gap).at(eps).worst_aspect_ratio(),
                model
                    .error_estimate(gap, LoadSet::all(2))?
                    .unwrap_or(f64::NAN),
                solution.seconds.assembly,
                solution.seconds.solve,
            );
        }
    }
    Ok(())
}
