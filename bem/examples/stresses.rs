//! Rates of work that are known from loads, against those of `exact`, with asymmetry of the others and the time that they take.
//!
//! `cargo run --release -p squirmers-bem --example stresses -- [LEVEL]`

use std::f64::consts::PI;
use std::time::Instant;

use bem::Bem;
use exact::Exact;
use scene::stress::{Block, Cause};
use scene::{Fluid, Gap, Hydrodynamics, LoadSet};

const MODES: usize = 4;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let level = std::env::args().nth(1).map_or(Ok(3), |l| l.parse())?;
    let bem = Bem::new(level)?;
    for gap in [1e4, 10.0, 1.0, 0.3, 0.1, 0.05, 0.01] {
        let gap = Gap::new(gap)?;
        let set = LoadSet::all(MODES).with_swirl(MODES);
        let start = Instant::now();
        bem.interacting_loads(gap, set)?;
        let loads_s = start.elapsed().as_secs_f64();
        let start = Instant::now();
        let found = bem.stresses(gap, MODES, MODES)?;
        let stresses_s = start.elapsed().as_secs_f64();
        let (loads, swirl) = Exact::default().interacting_loads_with_swirl(gap, set)?;
        let mut worst = [0.0f64; 2];
        let mut asymmetry: f64 = 0.0;
        for of in &found.blocks {
            asymmetry = asymmetry.max((&of.work - of.work.transpose()).amax() / of.work.amax());
            let count = of.causes.len();
            let mut check = |row: usize, on: usize, column: usize, expected: f64| {
                for (a, b) in [(on * count + row, column), (column, on * count + row)] {
                    let error = (of.work[(a, b)] - expected).abs() / expected.abs().max(PI);
                    let rigid = column < 2
                        && matches!(of.causes[column], Cause::Translation | Cause::Rotation);
                    let slot = usize::from(!rigid);
                    worst[slot] = worst[slot].max(error);
                }
            };
            for (j, cause) in of.causes.iter().enumerate() {
                match (of.block, cause) {
                    (Block::Order(0), Cause::Translation) => {
                        check(0, 0, j, 6.0 * PI * loads.xa.own());
                        check(0, 1, j, -6.0 * PI * loads.xa.other());
                    }
                    (Block::Order(1), Cause::Translation) => {
                        check(0, 0, j, 6.0 * PI * loads.ya.own());
                        check(0, 1, j, 6.0 * PI * loads.ya.other());
                    }
                    (Block::Order(1), Cause::Rotation) => {
                        check(1, 0, j, 8.0 * PI * loads.yc.own());
                        check(1, 1, j, -8.0 * PI * loads.yc.other());
                    }
                    (Block::Order(0), Cause::Squirming(n)) => {
                        check(0, 0, j, -PI * loads.mode(n - 1).xf.own());
                        check(0, 1, j, PI * loads.mode(n - 1).xf.other());
                    }
                    (Block::Order(1), Cause::Squirming(n)) => {
                        check(0, 0, j, -PI * loads.mode(n - 1).yf.own());
                        check(0, 1, j, -PI * loads.mode(n - 1).yf.other());
                        check(1, 0, j, -PI * loads.mode(n - 1).yt.own());
                        check(1, 1, j, PI * loads.mode(n - 1).yt.other());
                    }
                    (Block::Twist, Cause::Swirl(n)) => {
                        check(0, 0, j, -PI * swirl.modes()[n - 1].xtc.own());
                        check(0, 1, j, PI * swirl.modes()[n - 1].xtc.other());
                    }
                    _ => {}
                }
            }
        }
        println!(
            "gap {:7}: rigid {:.1e}, slip {:.1e}, asymmetry {asymmetry:.1e}; loads {loads_s:.2} s, stresses {stresses_s:.2} s",
            gap.eps(),
            worst[0],
            worst[1]
        );
    }
    Ok(())
}
