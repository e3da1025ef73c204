//! What a solve takes for all loads, in a plane, and for pairs with a symmetry.

use std::time::Instant;

use bem::Bem;
use scene::{Gap, LoadSet};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("level,gap,set,classes,assembly_s,solve_s,all_s");
    let point = LoadSet::planar(2).point_symmetric();
    let facing = LoadSet::axial(2).mirror_symmetric();
    for level in [1, 3] {
        let model = Bem::new(level)?;
        for eps in [0.01, 0.1] {
            for set in [
                LoadSet::all(2),
                LoadSet::planar(2),
                point,
                LoadSet::axial(2),
                facing,
            ] {
                let gap = Gap::new(eps)?;
                model.solve(gap, set)?;
                let started = Instant::now();
                let solved = model.solve(gap, set)?;
                let all = started.elapsed().as_secs_f64();
                println!(
                    "{level},{eps},\"{set}\",{},{:.3},{:.3},{all:.3}",
                    solved.solves, solved.seconds.assembly, solved.seconds.solve
                );
            }
        }
    }
    Ok(())
}
