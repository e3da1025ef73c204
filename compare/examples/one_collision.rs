//! One collision by two models: `cargo run --release -p squirmers-compare --example one_collision`.

use compare::{Method, Model, ModelOptions};
use scene::{Pose, Repulsion, RunOptions, Scene, Squirmer};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Two strong pullers on opposed paths one radius apart: Fig. 6 of the paper.
    let puller = Squirmer::with_beta(1.0, 5.0)?;
    let start = [
        Pose::planar(-0.5, 5.0, -90.0),
        Pose::planar(0.5, -5.0, 90.0),
    ];
    let scene = Scene::new([puller; 2], start, Some(Repulsion::PAPER), None)?;
    // A single collision does not repay a table of loads.
    let options = ModelOptions {
        direct: true,
        ..ModelOptions::default()
    };
    for method in [Method::Lt, Method::Exact] {
        let run = Model::set_up(method, &options)?.run(&scene, &RunOptions::default())?;
        let [first, second] = run.deflections_rad().map(f64::to_degrees);
        println!("{}: {first:.3} and {second:.3} degrees", method.title());
    }
    Ok(())
}
