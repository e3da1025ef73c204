//! Prints the loads at the gaps given, with error estimate, residual and time:
//! `cargo run --release -p squirmers-exact --example loads -- 2 0.1 1e-3`.

use std::time::Instant;

use exact::Exact;
use scene::{Gap, Hydrodynamics, LoadSet};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let exact = Exact::new();
    for argument in std::env::args().skip(1) {
        let gap = Gap::new(argument.parse()?)?;
        for modes in [2, 8] {
            let start = Instant::now();
            let loads = exact.loads(gap, LoadSet::all(modes))?;
            let seconds = start.elapsed().as_secs_f64();
            println!(
                "gap {argument}, {modes} modes: {:.3} ms, error estimate {:.1e}, residual {:.1e}",
                1e3 * seconds,
                exact
                    .error_estimate(gap, LoadSet::all(modes))?
                    .unwrap_or(f64::NAN),
                exact.residual(gap, LoadSet::all(modes)).unwrap_or(f64::NAN),
            );
            if modes == 2 {
                for (name, value) in loads.named() {
                    println!("  {name:6} {value:.12}");
                }
            }
        }
    }
    Ok(())
}
