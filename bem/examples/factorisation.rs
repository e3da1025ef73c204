//! Times the factorisation of the symmetry classes, of the unsplit system, and matrix products.
//!
//! `cargo run --release -p squirmers-bem --example factorisation [gap] [level]`
//!
//! Factorisation by blocks with partial pivoting is `2/3 n³` operations, a product `2 n³`.

use std::time::Instant;

use bem::Bem;
use faer::linalg::solvers::PartialPivLu;
use faer::{Mat, Par};
use scene::{Gap, LoadSet};

fn matrix(n: usize) -> Mat<f64> {
    // Nothing special, and far from singular.
    Mat::from_fn(n, n, |i, j| {
        let spread = ((i * n + j) as f64 * 0.618_033_988_749_894_9).fract() - 0.5;
        if i == j { n as f64 } else { spread }
    })
}

/// The shortest of three times, in seconds.
fn seconds(mut work: impl FnMut()) -> f64 {
    (0..3)
        .map(|_| {
            let start = Instant::now();
            work();
            start.elapsed().as_secs_f64()
        })
        .fold(f64::INFINITY, f64::min)
}

fn factorisation(n: usize, par: Par) -> f64 {
    faer::set_global_parallelism(par);
    let a = matrix(n);
    seconds(|| {
        std::hint::black_box(PartialPivLu::new(a.as_ref()));
    })
}

fn product(n: usize, par: Par) -> f64 {
    faer::set_global_parallelism(par);
    let a = matrix(n);
    seconds(|| {
        std::hint::black_box(&a * &a);
    })
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let gap = Gap::new(arguments.next().map_or(Ok(0.1), |s| s.parse())?)?;
    let level = arguments
        .next()
        .map_or(Ok(Bem::DEFAULT_LEVEL), |s| s.parse())?;
    let model = Bem::new(level)?;
    let solution = model.solve(gap, LoadSet::all(2))?;
    let whole = 6 * solution.nodes;
    let part = whole / 8;
    let many = Par::rayon(0);
    let cube = |n: usize| (n as f64).powi(3);
    let rate = |operations: f64, seconds: f64| operations / seconds * 1e-9;
    let peak = [(Par::Seq, "1 thread"), (many, "all threads")].map(|(par, threads)| {
        let rate = rate(2.0 * cube(1536), product(1536, par));
        println!("product of n = 1536, {threads}: {rate:.1} GFLOP/s");
        rate
    });
    let split = 6.0 * factorisation(part, Par::Seq);
    println!(
        "six classes of n = {part} one after the other, 1 thread: {split:.3} s, {:.1} GFLOP/s, {:.0} % of the product's",
        rate(4.0 * cube(part), split),
        100.0 * rate(4.0 * cube(part), split) / peak[0]
    );
    println!(
        "solve of the model, side by side: {:.3} s",
        solution.seconds.solve
    );
    let unsplit = factorisation(whole, many);
    println!(
        "unsplit system of n = {whole}, all threads: {unsplit:.3} s, {:.1} GFLOP/s, {:.0} % of the product's",
        rate(2.0 / 3.0 * cube(whole), unsplit),
        100.0 * rate(2.0 / 3.0 * cube(whole), unsplit) / peak[1]
    );
    println!("unsplit over split: {:.0}", unsplit / split);
    Ok(())
}
