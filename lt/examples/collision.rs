//! Fig. 6 of the paper by lubrication theory, timed: `cargo run --release -p squirmers-lt --example collision`.
//!
//! Two pullers (`beta = 5`) approach on opposed paths an offset `dx` apart. The least of many repeats is printed, from
//! the start of the scene to its verdict, free flights included; `bench/scipy` divides by it.

use std::hint::black_box;
use std::time::Instant;

use lt::{Form, Lubrication};
use scene::{Plan, Pose, Repulsion, RunOptions, Scene, SceneError, Squirmer};

const REPEATS: usize = 20_000;

fn main() -> Result<(), SceneError> {
    let squirmer = Squirmer::with_beta(1.0, 5.0)?;
    let model = Lubrication::new(Form::Published);
    let options = RunOptions::default();
    for dx in [1.0, 2.0] {
        let start = [
            Pose::planar(-0.5 * dx, 5.0, -90.0),
            Pose::planar(0.5 * dx, -5.0, 90.0),
        ];
        let scene = Scene::new([squirmer; 2], start, Some(Repulsion::PAPER), None)?;
        let run = |scene| model.run(&Plan::new(scene)?, &options, &mut |_| {});
        let mut found = run(&scene)?;
        let mut least = f64::INFINITY;
        for _ in 0..REPEATS {
            let began = Instant::now();
            found = black_box(run(black_box(&scene))?);
            least = least.min(began.elapsed().as_secs_f64());
        }
        let deflection = found.deflections_rad()[0].to_degrees();
        println!(
            "dx {dx}: {:.3} us, {} right-hand sides, deflection {deflection:.5} degrees",
            1e6 * least,
            found.counters.loads
        );
    }
    Ok(())
}
