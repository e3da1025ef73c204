//! Compares constant, linear and quadratic densities at equal numbers of unknowns.
//!
//! `cargo run --release -p squirmers-bem --example elements`
//!
//! Errors against `exact` as in the example `referee`.

use std::f64::consts::PI;

use bem::mesh::{Grading, MeshFamily};
use exact::Exact;
use scene::{Gap, Hydrodynamics, LoadSet};

type Failure = Box<dyn std::error::Error>;

fn report<const H: usize>(name: &str, eps: f64, panels: &[f64]) -> Result<(), Failure> {
    let gap = Gap::new(eps)?;
    let truth = Exact::new().loads(gap, LoadSet::all(2))?;
    for panels in panels {
        let law = Grading {
            scale: PI / panels,
            far: 2.5,
            slope: 0.5,
            core: 0.5,
            width: f64::INFINITY,
            gap: eps,
        };
        let family = MeshFamily::<H>::new(law, 0.5 * eps, 2.0 * eps)?;
        let solution = bem::pair::solve(&family, eps, LoadSet::all(2))?;
        let (_, error) = solution.loads.worst_error(&truth);
        let seconds = solution.seconds.assembly + solution.seconds.solve;
        println!(
            "{eps:5} {name:9} {:5} nodes {error:8.1e} {seconds:6.3} s",
            solution.nodes
        );
    }
    Ok(())
}

fn main() -> Result<(), Failure> {
    for eps in [0.1, 0.01] {
        report::<1>("constant", eps, &[4.2, 6.0, 8.4])?;
        report::<3>("linear", eps, &[6.0, 8.5, 12.0])?;
        report::<6>("quadratic", eps, &[3.0, 4.25, 6.0])?;
    }
    Ok(())
}
