//! How the time of a trajectory divides into its parts, and what one velocity of the pair costs at any gap.

use std::hint::black_box;

use exact::Exact;
use lt::{Form, Lubrication};
use scene::balance;
use scene::mobility::{
    External, Heading, MobilitySet, ModeMobility, PairMobility, PairVelocity, pair_velocity,
};
use scene::{Gap, Hydrodynamics, LoadSet, Repulsion, Run, RunOptions, Scene, SceneError, Squirmer};

use super::loads::REFEREE_TERMS;
use super::scaling::fig_6;
use super::tables::Tables;
use super::timing::timed;
use super::{CostRow, LOADS, Part, run_lubrication};
use crate::{CompareError, Method};

/// What a planar collision reads.
const READ: MobilitySet = MobilitySet {
    loads: LoadSet::planar(LOADS.modes),
    torque: false,
};

/// Logarithms of the gaps of a collision.
const LN_GAPS: [f64; 8] = [-5.3, -0.2, -3.1, -4.6, -1.7, -0.9, -2.4, -3.9];

/// Powers of ten of the gaps at which a velocity is timed: from gaps below the exact table, where its limiting form
/// applies, to gaps at which the squirmers hardly interact.
const DECADES: std::ops::RangeInclusive<i32> = -9..=4;

/// Smallest power of ten at which the series are fast enough: their number of terms grows as `1/sqrt(eps)`.
const SERIES_FROM: i32 = -6;

/// Angles of the two orientations from the direction to the other sphere, in radians.
const ANGLES: [[f64; 2]; 4] = [[0.3, 0.3], [1.2, -0.4], [2.0, 2.9], [-1.5, 0.9]];

/// Times per right-hand side: the mobilities alone; these with the sines and the sums over the causes; a whole collision
/// divided by its right-hand sides.
pub(super) fn right_hand_sides(
    tables: &Tables,
    rows: &mut Vec<CostRow>,
) -> Result<(), CompareError> {
    let lubrication = Lubrication::new(Form::Published);
    let lubrication_run = |scene: &_, options: &_| run_lubrication(scene, &lubrication, options);
    profile(Method::Lt.name(), &lubrication, &lubrication_run, rows)?;
    let exact = &tables.usual_exact().table;
    let exact_run = |scene: &_, options: &_| scene::run(scene, exact, options);
    profile("exact-table", exact, &exact_run, rows)?;
    for built in tables.usual_bem() {
        let run = |scene: &_, options: &_| scene::run(scene, &built.table, options);
        profile(&built.name, &built.table, &run, rows)?;
    }
    Ok(())
}

fn profile<M: Hydrodynamics>(
    name: &str,
    model: &M,
    run: &dyn Fn(&Scene, &RunOptions) -> Result<Run, SceneError>,
    rows: &mut Vec<CostRow>,
) -> Result<(), CompareError> {
    let squirmers = [Squirmer::with_beta(1.0, 5.0)?; 2];
    let mobilities = || {
        for ln_gap in LN_GAPS {
            let gap = Gap::from_ln(black_box(ln_gap));
            let (mut pair, mut modes) = <(PairMobility, [ModeMobility; LOADS.modes])>::default();
            let _ = model.interacting_mobility(gap, READ, (&mut pair, &mut modes));
            black_box((&pair, &modes));
        }
    };
    let velocities = || {
        for ln_gap in LN_GAPS {
            let gap = Gap::from_ln(black_box(ln_gap));
            let headings = [ln_gap, 1.0 - ln_gap].map(heading);
            let _ = black_box(&velocity(model, gap, &squirmers, headings));
        }
    };
    let mut push = |knob: &str, case: &str, seconds: f64, repeats: u64| {
        rows.push(CostRow {
            seconds,
            repeats,
            ..CostRow::new(Part::Profile, name, (knob, f64::NAN), case)
        });
    };
    let each = LN_GAPS.len() as f64;
    let (_, timing) = timed(mobilities);
    push(
        "mobilities",
        "collision",
        timing.seconds / each,
        timing.repeats,
    );
    let (_, timing) = timed(velocities);
    let per_velocity = timing.seconds / each;
    push("velocity", "collision", per_velocity, timing.repeats);
    let scene = fig_6(1.0).scene()?;
    let (found, timing) = timed(|| run(&scene, &RunOptions::default()));
    let loads = found?.counters.loads as f64;
    let case = "head-on beta 5 dx 1";
    push("trajectory", case, timing.seconds, timing.repeats);
    let per_right_hand_side = timing.seconds / loads;
    push(RIGHT_HAND_SIDE, case, per_right_hand_side, timing.repeats);
    Ok(())
}

fn heading(angle: f64) -> Heading<f64> {
    let (transverse, cosine) = angle.sin_cos();
    Heading { cosine, transverse }
}

fn velocity<M: Hydrodynamics>(
    model: &M,
    gap: Gap,
    squirmers: &[Squirmer; 2],
    headings: [Heading<f64>; 2],
) -> Result<PairVelocity<f64>, SceneError> {
    let (mut pair, mut modes) = <(PairMobility, [ModeMobility; LOADS.modes])>::default();
    model.interacting_mobility(gap, READ, (&mut pair, &mut modes))?;
    Ok(moved((&pair, &modes), gap, squirmers, headings))
}

#[inline]
fn moved(
    mobility: (&PairMobility, &[ModeMobility]),
    gap: Gap,
    squirmers: &[Squirmer; 2],
    headings: [Heading<f64>; 2],
) -> PairVelocity<f64> {
    let external = External {
        repulsion: Repulsion::PAPER.force(gap),
        torque: None,
    };
    pair_velocity(mobility, squirmers, &headings, &external)
}

/// Time and error of a velocity by the exact table, as the commands use it, also at gaps far below and above those in
/// the table. The error is the largest error of any component, in swimming speeds, against the series with more
/// terms, at gaps where the series are fast enough.
pub(super) fn velocities(tables: &Tables, rows: &mut Vec<CostRow>) -> Result<(), CompareError> {
    let table = &tables.usual_exact().table;
    let referee = Exact::with_terms(REFEREE_TERMS).map_err(SceneError::from)?;
    let squirmers = [
        Squirmer::with_beta(1.0, 1.0)?,
        Squirmer::with_beta(1.0, 5.0)?,
    ];
    for decade in DECADES {
        let gap = Gap::new(10.0_f64.powi(decade))?;
        let headings = ANGLES.map(|angles| angles.map(heading));
        let ((), timing) = timed(|| {
            for headings in headings {
                let gap = Gap::from_ln(black_box(gap.ln()));
                let _ = black_box(&velocity(table, gap, &squirmers, headings));
            }
        });
        let mut row = CostRow {
            seconds: timing.seconds / ANGLES.len() as f64,
            repeats: timing.repeats * ANGLES.len() as u64,
            ..CostRow::new(
                Part::Profile,
                "exact-table",
                (VELOCITY_AT_ANY_GAP, gap.eps()),
                format!("gap 1e{decade}"),
            )
        };
        if decade >= SERIES_FROM {
            let reference = referee.series_loads(gap, LOADS).map_err(SceneError::from)?;
            let reference = balance::solve(gap, &reference, READ);
            let mut error = 0.0_f64;
            for headings in headings {
                let found = velocity(table, gap, &squirmers, headings)?;
                let expected = moved(
                    (&reference.pair, &reference.modes[..LOADS.modes]),
                    gap,
                    &squirmers,
                    headings,
                );
                error = error.max(difference(&found, &expected, gap));
            }
            row.error = error;
        }
        rows.push(row);
    }
    Ok(())
}

/// Entry in the column `knob` of the rows of a right-hand side.
pub(super) const RIGHT_HAND_SIDE: &str = "right-hand side with its share of the step";

/// Entry in the column `knob` of the rows of [`velocities`].
pub(super) const VELOCITY_AT_ANY_GAP: &str = "velocity at gap";

/// Largest difference of any component, in swimming speeds.
fn difference(a: &PairVelocity<f64>, b: &PairVelocity<f64>, gap: Gap) -> f64 {
    let components = |v: &PairVelocity<f64>| {
        [
            v.opening * gap.eps(),
            v.mean_axial,
            v.mean_transverse,
            v.turning * gap.distance(),
            v.spin[0],
            v.spin[1],
        ]
    };
    (components(a).iter().zip(components(b)))
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max)
}
