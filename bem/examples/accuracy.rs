//! Prints errors against published tables and near-contact asymptotics, per level and gap.
//!
//! `cargo run --release -p bem --example accuracy [highest level]`

use bem::Bem;
use scene::{Gap, PairLoads};

/// Gap and X11A X12A Y11A Y12A Y11B Y12B X11C X12C Y11C Y12C; Townsend 2023, doi 10.1063/5.0175697.
const TABLE: [(f64, [f64; 10]); 8] = [
    (
        0.05,
        [
            6.6796509,
            -6.0316169,
            1.5031168,
            -0.77418245,
            -0.54318957,
            0.77304978,
            1.0362284,
            -0.12959754,
            1.3430591,
            0.13126187,
        ],
    ),
    (
        0.1,
        [
            4.0320976,
            -3.3811975,
            1.3930063,
            -0.65987526,
            -0.39450644,
            0.61714395,
            1.0283075,
            -0.11682955,
            1.2330279,
            0.10173991,
        ],
    ),
    (
        0.2,
        [
            2.6410486,
            -1.9844942,
            1.2880376,
            -0.54675096,
            -0.26187166,
            0.47073437,
            1.0187645,
            -0.09830028,
            1.1398069,
            0.074261004,
        ],
    ),
    (
        0.5,
        [
            1.7226671,
            -1.0497516,
            1.1648647,
            -0.40107891,
            -0.12414905,
            0.29703071,
            1.0070156,
            -0.064846795,
            1.0527378,
            0.041715395,
        ],
    ),
    (
        0.8,
        [
            1.4616681,
            -0.77324752,
            1.1130867,
            -0.32971927,
            -0.074806291,
            0.21908019,
            1.0031419,
            -0.045783909,
            1.0264207,
            0.027497726,
        ],
    ),
    (
        1.0,
        [
            1.3684796,
            -0.67017504,
            1.0921018,
            -0.29717586,
            -0.056746485,
            0.18538814,
            1.0019592,
            -0.037145353,
            1.0179857,
            0.021664665,
        ],
    ),
    (
        1.5,
        [
            1.2376722,
            -0.51623618,
            1.0605336,
            -0.24114588,
            -0.032157235,
            0.13082,
            1.000703,
            -0.023345294,
            1.0080819,
            0.012989044,
        ],
    ),
    (
        2.0,
        [
            1.1694701,
            -0.42721186,
            1.043303,
            -0.20447686,
            -0.02033142,
            0.098152276,
            1.0002964,
            -0.015630696,
            1.0042257,
            0.0084580237,
        ],
    ),
];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let highest = std::env::args().nth(1).map_or(Ok(5), |s| s.parse())?;
    println!("level     eps vertices aspect assembly   solve  worst error          of");
    for level in 1..=highest {
        let model = Bem::new(level)?;
        for (eps, values) in TABLE {
            report(&model, eps, |_| values.to_vec())?;
        }
        for eps in [0.01, 0.005, 0.001] {
            report(&model, eps, asymptotics)?;
        }
        // Far apart the spheres are alone.
        report(&model, 1e9, |_| {
            PairLoads::isolated(2)
                .named()
                .into_iter()
                .map(|r| r.1)
                .collect()
        })?;
    }
    Ok(())
}

fn report(
    model: &Bem,
    eps: f64,
    truth: impl Fn(f64) -> Vec<f64>,
) -> Result<(), Box<dyn std::error::Error>> {
    let gap = Gap::new(eps)?;
    let solution = model.solve(gap, 2)?;
    let mesh = model.family(gap).at(eps);
    let errors: Vec<(String, f64)> = solution
        .loads
        .named()
        .into_iter()
        .zip(truth(eps))
        .map(|((name, value), truth)| (name, (value - truth) / truth.abs().max(1.0)))
        .collect();
    let worst = errors.iter().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
    let (name, error) = worst.ok_or("no loads")?;
    println!(
        "{:5} {eps:7.0e} {:8} {:6.2} {:8.3} {:7.3} {error:12.2e} {name:>10}",
        model.level(),
        solution.nodes,
        mesh.worst_aspect_ratio(),
        solution.seconds.assembly,
        solution.seconds.solve,
    );
    if std::env::var_os("ALL_LOADS").is_some() {
        for (name, error) in &errors {
            print!(" {name} {error:.1e}");
        }
        println!();
    }
    Ok(())
}

/// Singular parts and next constants near contact; terms of order `eps ln(1/eps)` are left out.
fn asymptotics(eps: f64) -> Vec<f64> {
    let log = -eps.ln();
    let squeeze = 0.25 / eps + 9.0 / 40.0 * log;
    let mut values = vec![
        squeeze + 0.9954,
        -squeeze - 0.3502,
        log / 6.0 + 0.9983,
        -log / 6.0 - 0.2737,
        -log / 4.0 + 0.2389,
        log / 4.0 - 0.0016,
        1.0518,
        -0.1503,
        log / 5.0 + 0.7028,
        log / 20.0 - 0.0275,
    ];
    for constants in [
        [1.800, 0.920, 3.380, -0.653, -2.742, 0.766],
        [-4.767, 4.350, -1.646, 1.354, -4.429, 1.470],
    ] {
        let slopes = [3.0, -3.0, 1.0, -1.0, 1.6, 0.4];
        values.extend(slopes.iter().zip(constants).map(|(s, c)| s * log + c));
    }
    values
}
