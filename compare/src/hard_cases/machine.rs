//! What the machine can do to the numbers: inputs at the ends of the number range, and threads.

use std::sync::Arc;

use bem::Bem;
use rayon::{ThreadPool, ThreadPoolBuilder};
use scene::mobility::MobilitySet;
use scene::{
    Gap, Gravity, Hydrodynamics, LoadSet, Orientation, Pose, Repulsion, RunOptions, Scene,
    SceneError, Squirmer, TableOptions, Tabulated,
};

use super::{Bench, READ, Rows, until};
use crate::{Approach, Case, CompareError, Model};

/// In the column `method`: the row is about all of them.
const ALL: &str = "all";

pub(super) fn cases(bench: &Bench, rows: &mut Rows) {
    for model in bench.models() {
        rows.attempt(model.method().name(), "extremes", |rows| {
            extremes(model, rows)
        });
    }
    for model in bench.models() {
        rows.attempt(model.method().name(), "read beside", |rows| {
            read_beside(model, rows)
        });
    }
    rows.attempt(ALL, "threads", |rows| threads(bench, rows));
}

/// A pair without any symmetry, whose centres are about `2 half` apart.
fn pair(
    squirmer: Squirmer,
    repulsion: Option<Repulsion>,
    gravity: Option<Gravity>,
    half: f64,
) -> Result<Scene, SceneError> {
    let pose = |x: f64, y: f64, angle: f64| Pose {
        position: [x, y, 0.0].into(),
        orientation: Orientation::Radians(angle),
    };
    Scene::new(
        [squirmer; 2],
        [pose(-half, 0.0, 0.4), pose(half, 0.1, 2.0)],
        repulsion,
        gravity,
    )
}

/// Finite inputs at the ends of the number range: each is refused by a typed error, or the results are finite.
fn extremes(model: &Model, rows: &mut Rows) -> Result<(), CompareError> {
    let mut wrong = Vec::new();
    for eps in [
        f64::from_bits(1),
        1e-310,
        f64::MIN_POSITIVE,
        1e-200,
        1e200,
        f64::MAX,
    ] {
        let gap = Gap::new(eps)?;
        if let Ok(loads) = model.loads(gap, LoadSet::all(2))
            && !loads.columns().all(f64::is_finite)
        {
            wrong.push(format!("loads at gap {eps:e}"));
        }
        if let Ok(mobility) = model.mobility(gap, READ)
            && !mobility
                .named(READ)
                .iter()
                .all(|(_, value)| value.is_finite())
        {
            wrong.push(format!("mobilities at gap {eps:e}"));
        }
    }
    let options = RunOptions {
        max_steps: 20_000,
        ..until(10.0, 1e-8)
    };
    let plain = Squirmer::with_beta(1.0, 1.0)?;
    let paper = Some(Repulsion::PAPER);
    let tiny = f64::from_bits(1);
    let scenes = [
        (
            "speed 1e150",
            pair(Squirmer::with_beta(1e150, 1.0)?, paper, None, 1.1),
        ),
        (
            "speed 1e300",
            pair(Squirmer::with_beta(1e300, 1.0)?, paper, None, 1.1),
        ),
        (
            "speed 5e-324",
            pair(Squirmer::with_beta(tiny, 1.0)?, paper, None, 1.1),
        ),
        (
            "beta 1e300",
            pair(Squirmer::with_beta(1.0, 1e300)?, paper, None, 1.1),
        ),
        (
            "kappa1 1e300",
            pair(plain, Some(Repulsion::new(1e300, 100.0)?), None, 1.1),
        ),
        (
            "kappa2 1e300",
            pair(plain, Some(Repulsion::new(10.0, 1e300)?), None, 1.1),
        ),
        (
            "kappa2 1e-300",
            pair(plain, Some(Repulsion::new(10.0, 1e-300)?), None, 1.1),
        ),
        (
            "kappa1 5e-324",
            pair(plain, Some(Repulsion::new(tiny, 100.0)?), None, 1.1),
        ),
        (
            "G 1e300",
            pair(plain.bottom_heavy(1e300)?, paper, Some(Gravity::DOWN), 1.1),
        ),
        (
            "G 5e-324",
            pair(plain.bottom_heavy(tiny)?, paper, Some(Gravity::DOWN), 1.1),
        ),
        ("distance 1e150", pair(plain, paper, None, 5e149)),
        ("distance 1e300", pair(plain, paper, None, 5e299)),
        ("distance 3e308", pair(plain, paper, None, 1.5e308)),
    ];
    for (what, scene) in scenes {
        let Ok(scene) = scene else { continue };
        if let Ok(run) = model.run(&scene, &options) {
            let positions = run.end.positions();
            let finite = positions
                .iter()
                .flat_map(|p| p.iter())
                .chain(&run.end.angles_rad)
                .all(|v| v.is_finite());
            if !finite || run.end_time.is_nan() {
                wrong.push(what.to_owned());
            }
        }
    }
    let mut measure =
        "extreme inputs that are not refused and give numbers that are not finite".to_owned();
    if !wrong.is_empty() {
        measure = format!("{measure}: {}", wrong.join(", "));
    }
    rows.add(
        model.method().name(),
        measure,
        (0.0, "a typed error or finite numbers"),
        wrong.len() as f64,
    );
    Ok(())
}

/// Each mobility has the same bits whatever is read beside it: sums of several columns of a table run side by side in the lanes of the processor.
fn read_beside(model: &Model, rows: &mut Rows) -> Result<(), CompareError> {
    let sets = [
        LoadSet::axial(1),
        LoadSet::axial(2),
        LoadSet::planar(0),
        LoadSet::planar(1),
        LoadSet::planar(2),
    ];
    let (mut differ, mut count) = (0_u32, 0_u32);
    for k in 0..20 {
        let gap = Gap::from_ln(4.0 - 0.45 * f64::from(k));
        if model.range().check(gap).is_err() {
            continue;
        }
        let whole = model.mobility(gap, READ)?.named(READ);
        for loads in sets {
            for torque in [false, true] {
                let read = MobilitySet { loads, torque };
                for (name, value) in model.mobility(gap, read)?.named(read) {
                    let same = whole.iter().any(|(of_whole, of_it)| {
                        *of_whole == name && of_it.to_bits() == value.to_bits()
                    });
                    differ += u32::from(!same);
                    count += 1;
                }
            }
        }
    }
    rows.add(
        model.method().name(),
        format!("of {count} mobilities read with few others: those whose bits differ from those read with all"),
        (
            0.0,
            "each is one sum in one order, alone or beside others in the lanes of the processor",
        ),
        f64::from(differ),
    );
    Ok(())
}

/// A pool of threads apart from the common one.
fn pool(threads: usize) -> Result<ThreadPool, CompareError> {
    (ThreadPoolBuilder::new().num_threads(threads).build())
        .map_err(|error| CompareError::input("threads", threads, error.to_string()))
}

/// Mobilities at some gaps, bit by bit.
fn bits(model: &dyn Hydrodynamics, loads: LoadSet) -> Result<Vec<u64>, CompareError> {
    let mut bits = Vec::new();
    let read = MobilitySet {
        loads,
        torque: true,
    };
    for k in 0..20 {
        let gap = Gap::from_ln(0.35_f64.ln() + 0.4 * f64::from(k));
        let named = model.mobility(gap, read)?.named(read);
        bits.extend(named.into_iter().map(|(_, value)| value.to_bits()));
    }
    Ok(bits)
}

/// The same bits by one thread and by two, and by two threads twice.
fn threads(bench: &Bench, rows: &mut Rows) -> Result<(), CompareError> {
    let options = TableOptions {
        set: LoadSet::planar(1),
        tolerance: 1e-4,
        smallest_gap: 0.3,
    };
    let build = |threads: usize| -> Result<Vec<u64>, CompareError> {
        pool(threads)?.install(|| {
            let set = options.set;
            let mut all = bits(
                &Tabulated::build(Arc::new(Bem::new(1)?), options, &|_| {})?,
                set,
            )?;
            all.extend(bits(&exact::Exact::new(), set)?);
            let case = Case {
                approach: Approach::HeadOn,
                beta: 5.0,
                dx: 1.0,
                dz: 0.1,
            };
            for model in bench.models() {
                let run = model.run(&case.scene()?, &until(200.0, 1e-8))?;
                all.extend(
                    run.end
                        .orientations
                        .iter()
                        .flat_map(|p| p.iter().map(|v| v.to_bits())),
                );
            }
            Ok(all)
        })
    };
    let (one, two, again) = (build(1)?, build(2)?, build(2)?);
    let differ = |other: &[u64]| one.iter().zip(other).filter(|(a, b)| a != b).count() as f64;
    let why = (0.0, "every sum is formed in one fixed order");
    let count = one.len();
    rows.add(
        ALL,
        format!("of {count} numbers: those whose bits differ between 1 and 2 threads"),
        why,
        differ(&two),
    );
    rows.add(
        ALL,
        format!("of {count} numbers: those whose bits differ when 2 threads run again"),
        why,
        differ(&again),
    );
    Ok(())
}
