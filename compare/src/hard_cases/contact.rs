//! Contact: loads, mobilities and velocities at gaps from 1e-1 to 1e-14.

use exact::Exact;
use scene::balance;
use scene::mobility::{External, Heading, MobilitySet, PairVelocity, pair_velocity};
use scene::{Gap, Hydrodynamics, LoadSet, PairLoads, Squirmer};
use serde::Deserialize;

use super::rows::larger;
use super::{Bench, ROUNDING, Rows};
use crate::{CompareError, Method, Model};

const LOADS: LoadSet = LoadSet::all(2);

/// Velocities by lubrication theory to 50 digits; the script that computed them is in the same folder.
const VELOCITIES: &str = fixtures::CONTACT_VELOCITIES;

/// Axial drags and torques by closed series to 50 digits; their script is there too.
const AXIAL_LOADS: &str = fixtures::CONTACT_LOADS;

pub(super) fn cases(bench: &Bench, rows: &mut Rows) {
    for model in bench.models() {
        rows.attempt(model.method().name(), "loads", |rows| loads(model, rows));
    }
    rows.attempt(Method::Exact.name(), "closed series", closed_series);
    for model in bench.only(&[Method::Lt, Method::LtCorrected]) {
        let name = model.method().name();
        rows.attempt(name, "50 digits", |rows| fifty_digits(model, rows));
    }
}

/// Those of the gaps `1e-1, 1e-2, ..., 1e-14` that are in the range of a model.
fn gaps(model: &Model) -> Result<Vec<Gap>, CompareError> {
    let all = (1..=14)
        .map(|decade| Gap::new(10f64.powi(-decade)))
        .collect::<Result<Vec<_>, _>>()?;
    Ok(all
        .into_iter()
        .filter(|&gap| model.range().check(gap).is_ok())
        .collect())
}

fn loads(model: &Model, rows: &mut Rows) -> Result<(), CompareError> {
    let name = model.method().name();
    let (mut not_finite, mut indefinite, mut most) = (0, 0, 0.0_f64);
    let (mut lost, mut worst) = (0.0_f64, 0.0_f64);
    let gaps = gaps(model)?;
    let count = gaps.len();
    for gap in gaps {
        let loads = model.loads(gap, LOADS)?;
        not_finite += loads.columns().filter(|load| !load.is_finite()).count();
        let of_gap = mobilities(&loads);
        indefinite += usize::from(!of_gap.iter().all(|&mobility| mobility > 0.0));
        most = of_gap.into_iter().fold(most, larger);
        for block in blocks(&loads) {
            let cancelled = block.cancellation();
            lost = larger(lost, cancelled.log10());
            let error = block.error(gap, &loads)?;
            worst = larger(worst, error / ((3.0 * cancelled + 8.0) * ROUNDING));
        }
    }
    rows.add(
        name,
        "loads that are not finite",
        (0.0, "all loads are finite at a positive gap"),
        not_finite as f64,
    );
    let from = "dissipation: any forces on the spheres do positive work";
    rows.add(
        name,
        format!("of {count} gaps: those at which the mobility is not positive definite"),
        (0.0, from),
        indefinite as f64,
    );
    let from = "least dissipation: a sphere's own mobility is at most that of a lone sphere, an eigenvalue of the pair's at most twice that";
    rows.add(
        name,
        "largest eigenvalue of the mobility, divided by the mobility of a lone sphere",
        (2.0, from),
        most,
    );
    let from =
        "2 x 2 force balance of the diverging parts: 1 + L/7 at L = ln(1e14), less than one digit";
    rows.add(
        name,
        "digits lost to cancellation in the force balance",
        (1.0, from),
        lost,
    );
    let from = "Cramer's rule: 3 roundings times the cancellation, plus 8 roundings";
    rows.add(
        name,
        "error of the velocities (from a residual with 106 bits), divided by what rounding allows",
        (1.0, from),
        worst,
    );
    Ok(())
}

/// Eigenvalues of the mobility matrix, divided by those of lone spheres.
fn mobilities(loads: &PairLoads) -> Vec<f64> {
    let single = [
        loads.xa.sum,
        loads.xa.difference,
        loads.xc.sum,
        loads.xc.difference,
    ];
    let mut all: Vec<_> = single.into_iter().map(|drag| 1.0 / drag).collect();
    for Block { a, b, c } in blocks(loads) {
        // Drags 6 a, 8 c and -4 b over 6, 8 and sqrt(48).
        let coupling = b * b / 3.0;
        let larger = 0.5 * (a + c) + (0.25 * (a - c) * (a - c) + coupling).sqrt();
        all.extend([1.0 / larger, larger / (a * c - coupling)]);
    }
    all
}

/// A block `[6a, -4b; -4b, 8c]` of the resistance matrix across the line of centres.
struct Block {
    a: f64,
    b: f64,
    c: f64,
}

/// The block of equal translations of both spheres, and that of opposite ones.
fn blocks(loads: &PairLoads) -> [Block; 2] {
    let PairLoads { ya, yb, yc, .. } = loads;
    [
        Block {
            a: ya.sum,
            b: yb.sum,
            c: yc.difference,
        },
        Block {
            a: ya.difference,
            b: yb.difference,
            c: yc.sum,
        },
    ]
}

impl Block {
    /// First term of the determinant, divided by the determinant: how much cancels in their difference.
    fn cancellation(&self) -> f64 {
        let first = 48.0 * self.a * self.c;
        first / (first - 16.0 * self.b * self.b)
    }

    /// Relative error of the velocities that [`pair_velocity`] finds for unit torque. The error is what one step of
    /// iterative refinement changes; the residual has twice the digits of a double.
    fn error(&self, gap: Gap, loads: &PairLoads) -> Result<f64, CompareError> {
        let opposed = self.a > loads.ya.sum || self.c < loads.yc.difference;
        let torque = if opposed { [0.5, 0.5] } else { [0.5, -0.5] };
        let velocity = torqued(gap, loads, torque)?;
        let (u, w) = if opposed {
            (
                -velocity.turning * gap.distance(),
                velocity.spin[0] + velocity.spin[1],
            )
        } else {
            (
                2.0 * velocity.mean_transverse,
                velocity.spin[0] - velocity.spin[1],
            )
        };
        let force = residual(0.0, [(-6.0 * self.a, u), (4.0 * self.b, w)]);
        let torque = residual(1.0, [(4.0 * self.b, u), (-8.0 * self.c, w)]);
        let inverse = 1.0 / (48.0 * self.a * self.c - 16.0 * self.b * self.b);
        let of_u = (8.0 * self.c * force + 4.0 * self.b * torque) * inverse;
        let of_w = (4.0 * self.b * force + 6.0 * self.a * torque) * inverse;
        Ok(larger(of_u.abs(), of_w.abs()) / u.abs().max(w.abs()))
    }
}

/// Motion of two passive spheres under torques, per `pi mu a^2`.
fn torqued(
    gap: Gap,
    loads: &PairLoads,
    torque: [f64; 2],
) -> Result<PairVelocity<f64>, CompareError> {
    let passive = Squirmer::new(&[])?;
    let ahead = Heading {
        cosine: 1.0,
        transverse: 0.0,
    };
    let external = External {
        repulsion: 0.0,
        torque: Some(torque),
    };
    let set = MobilitySet {
        loads: loads.set(),
        torque: true,
    };
    let mobility = balance::solve(gap, loads, set);
    Ok(pair_velocity(
        (&mobility.pair, &[]),
        &[passive; 2],
        &[ahead; 2],
        &external,
    ))
}

/// `start` plus two products; the rounding error of each operation is computed and added at the end.
fn residual(start: f64, products: [(f64, f64); 2]) -> f64 {
    let (mut sum, mut rest) = (start, 0.0);
    for (x, y) in products {
        let product = x * y;
        rest += x.mul_add(y, -product);
        let total = sum + product;
        let share = total - sum;
        rest += (sum - (total - share)) + (product - share);
        sum = total;
    }
    sum + rest
}

#[derive(Deserialize)]
struct AxialLoads {
    eps: f64,
    xa_sum: f64,
    xa_difference: f64,
    xc_sum: f64,
    xc_difference: f64,
}

/// Drags along and torques about the line of centres have closed series. The exact loads (below a gap of 1e-4 their
/// limiting form) are compared with 50 digits of these series.
fn closed_series(rows: &mut Rows) -> Result<(), CompareError> {
    let (name, model) = (Method::Exact.name(), Exact::new());
    let mut worst = 0.0_f64;
    for line in csv::Reader::from_reader(AXIAL_LOADS.as_bytes()).deserialize() {
        let truth: AxialLoads = line?;
        let gap = Gap::new(truth.eps)?;
        let loads = model.loads(gap, LOADS)?;
        let allowed = model.error_estimate(gap, LOADS)?.unwrap_or(f64::NAN);
        for (found, expected) in [
            (loads.xa.sum, truth.xa_sum),
            (loads.xa.difference, truth.xa_difference),
            (loads.xc.sum, truth.xc_sum),
            (loads.xc.difference, truth.xc_difference),
        ] {
            let error = (found - expected).abs() / expected.max(1.0);
            worst = larger(worst, error / allowed);
        }
    }
    rows.add(
        name,
        "error of X11A, X12A, X11C, X12C (from 50 digits), divided by its estimate, gaps 1e-1 to 1e-14",
        (1.0, "the error estimate that the model gives for all loads"),
        worst,
    );
    Ok(())
}

#[derive(Deserialize)]
struct Velocities {
    form: String,
    eps: f64,
    beta: f64,
    angle1: f64,
    angle2: f64,
    opening: f64,
    mean_axial: f64,
    mean_transverse: f64,
    turning: f64,
    spin1: f64,
    spin2: f64,
}

fn fifty_digits(model: &Model, rows: &mut Rows) -> Result<(), CompareError> {
    let name = model.method().name();
    let mut worst = 0.0_f64;
    for line in csv::Reader::from_reader(VELOCITIES.as_bytes()).deserialize() {
        let truth: Velocities = line?;
        if truth.form != name {
            continue;
        }
        let gap = Gap::new(truth.eps)?;
        let squirmer = Squirmer::with_beta(1.0, truth.beta)?;
        let heading = |angle: f64, side: f64| Heading {
            cosine: angle.cos(),
            transverse: side * angle.sin(),
        };
        let headings = [heading(truth.angle1, 1.0), heading(truth.angle2, -1.0)];
        let external = External {
            repulsion: 0.0,
            torque: None,
        };
        let set = MobilitySet {
            loads: LOADS,
            torque: false,
        };
        let mobility = model.mobility(gap, set)?;
        let found = pair_velocity(
            (&mobility.pair, &mobility.modes[..2]),
            &[squirmer; 2],
            &headings,
            &external,
        );
        let expected = [
            truth.opening,
            truth.mean_axial,
            truth.mean_transverse,
            truth.turning,
            truth.spin1,
            truth.spin2,
        ];
        let found = [
            found.opening,
            found.mean_axial,
            found.mean_transverse,
            found.turning,
            found.spin[0],
            found.spin[1],
        ];
        // Each axial velocity is relative to itself. The transverse ones solve one system: they are relative to the
        // largest of them.
        let across = expected[2..]
            .iter()
            .fold(0.0_f64, |most, v| most.max(v.abs()));
        for (k, (found, expected)) in found.into_iter().zip(expected).enumerate() {
            let scale = if k < 2 { expected.abs() } else { across };
            worst = larger(worst, (found - expected).abs() / scale);
        }
    }
    let from = "roundings of 1.1e-16: loads 6, sums over modes 10, Cramer's rule 3 x 6 + 8; together 42 (cancellation up to a factor of 6)";
    rows.add(
        name,
        "relative error of the velocities (from 50 digits), gaps 1e-1 to 1e-14",
        (42.0 * ROUNDING, from),
        worst,
    );
    Ok(())
}
