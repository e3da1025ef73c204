//! The ends of the number range, torn and shared files, and threads.

use std::path::Path;

use bem::Bem;
use rayon::ThreadPoolBuilder;
use scene::{
    Gap, Gravity, Hydrodynamics, LoadSet, Orientation, Pose, Repulsion, RunOptions, Scene,
    SceneError, Squirmer, TableOptions, Tabulated,
};

use super::{Bench, Rows, until};
use crate::output::OutputFolder;
use crate::{Approach, Case, CompareError, Method, Model};

/// For rows that no method has to do with.
const ALL: &str = "all";

pub(super) fn cases(bench: &Bench, rows: &mut Rows) {
    rows.attempt(ALL, "inputs", refused_inputs);
    for model in bench.models() {
        rows.attempt(model.method().name(), "extremes", |rows| {
            extremes(model, rows)
        });
    }
    rows.attempt(Method::Bem.name(), "damaged tables", damaged_tables);
    rows.attempt(Method::Bem.name(), "shared folders", shared_folders);
    rows.attempt(ALL, "threads", |rows| threads(bench, rows));
}

/// A pair in contact, nothing symmetric about it.
fn pair(
    squirmer: Squirmer,
    repulsion: Option<Repulsion>,
    gravity: Option<Gravity>,
    half: f64,
) -> Result<Scene, SceneError> {
    let pose = |x: f64, y: f64, angle: f64| Pose {
        position: [x, y, 0.0].into(),
        orientation: Orientation::Angle(angle),
    };
    Scene::new(
        [squirmer; 2],
        [pose(-half, 0.0, 0.4), pose(half, 0.1, 2.0)],
        repulsion,
        gravity,
    )
}

fn refused_inputs(rows: &mut Rows) -> Result<(), CompareError> {
    let plain = Squirmer::with_beta(1.0, 1.0)?;
    let mut accepted = Vec::new();
    let mut tell = |what: String, taken: bool| {
        if taken {
            accepted.push(what);
        }
    };
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        tell(format!("gap {bad}"), Gap::new(bad).is_ok());
        tell(format!("mode {bad}"), Squirmer::new(&[1.0, bad]).is_ok());
        tell(format!("swirl {bad}"), plain.with_swirl(&[bad]).is_ok());
        tell(format!("beta {bad}"), Squirmer::with_beta(1.0, bad).is_ok());
        tell(
            format!("speed {bad}"),
            Squirmer::with_beta(bad, 1.0).is_ok(),
        );
        tell(
            format!("bottom-heaviness {bad}"),
            plain.bottom_heavy(bad).is_ok(),
        );
        tell(format!("kappa1 {bad}"), Repulsion::new(bad, 1.0).is_ok());
        tell(format!("kappa2 {bad}"), Repulsion::new(1.0, bad).is_ok());
        tell(
            format!("gravity {bad}"),
            Gravity::new([bad, 0.0, 1.0].into()).is_ok(),
        );
        tell(
            format!("position {bad}"),
            pair(plain, None, None, bad).is_ok(),
        );
        for angle in [
            Orientation::Angle(bad),
            Orientation::Vector([bad, 0.0, 1.0].into()),
        ] {
            let mut start = pair(plain, None, None, 2.0)?.start;
            start[0].orientation = angle;
            tell(
                format!("orientation {bad}"),
                Scene::new([plain; 2], start, None, None).is_ok(),
            );
        }
    }
    for bad in [0.0, -0.0, -1.0] {
        tell(format!("gap {bad}"), Gap::new(bad).is_ok());
        tell(format!("kappa2 {bad}"), Repulsion::new(1.0, bad).is_ok());
    }
    tell(
        "gravity of no direction".to_owned(),
        Gravity::new([0.0; 3].into()).is_ok(),
    );
    let measure = format!(
        "NaN, infinite and negative inputs that are accepted ({})",
        accepted.join(", ")
    );
    rows.add(
        ALL,
        measure,
        (0.0, "each is refused by a typed error"),
        accepted.len() as f64,
    );
    Ok(())
}

/// Numbers at the ends of their range: a typed error, or a run whose numbers are finite.
fn extremes(model: &Model, rows: &mut Rows) -> Result<(), CompareError> {
    let name = model.method().name();
    let mut wrong = Vec::new();
    for eps in [
        f64::from_bits(1),
        1e-310,
        f64::MIN_POSITIVE,
        1e-200,
        1e200,
        f64::MAX,
    ] {
        if let Ok(loads) = model.loads(Gap::new(eps)?, LoadSet::all(2))
            && !loads.columns().all(f64::is_finite)
        {
            wrong.push(format!("loads at gap {eps:e}"));
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
                .chain(&run.end.angles)
                .all(|v| v.is_finite());
            if !finite || run.end_time.is_nan() {
                wrong.push(what.to_owned());
            }
        }
    }
    for bad in [f64::NAN, f64::INFINITY, 0.0, -1.0] {
        let scene = pair(plain, paper, None, 1.1)?;
        if model.run(&scene, &until(bad, 1e-8)).is_ok()
            || model.run(&scene, &until(1.0, bad)).is_ok()
        {
            wrong.push(format!("end time or tolerance {bad}"));
        }
    }
    let measure = format!(
        "extreme inputs that are neither refused nor answered by finite numbers ({})",
        wrong.join(", ")
    );
    rows.add(
        name,
        measure,
        (0.0, "a typed error or finite numbers"),
        wrong.len() as f64,
    );
    Ok(())
}

/// A table that is quick to build.
const QUICK: TableOptions = TableOptions {
    set: LoadSet::axial(1),
    tolerance: 1e-2,
    smallest_gap: 0.3,
};

fn table(folder: &Path) -> Result<Tabulated<Bem>, CompareError> {
    Ok(Tabulated::load_or_build(
        Bem::new(1)?,
        QUICK,
        folder,
        &|_| {},
    )?)
}

/// Its loads at some gaps, bit by bit.
fn bits(model: &dyn Hydrodynamics, set: LoadSet) -> Result<Vec<u64>, CompareError> {
    let mut bits = Vec::new();
    for k in 0..20 {
        let gap = Gap::from_ln(0.35_f64.ln() + 0.4 * f64::from(k));
        bits.extend(model.loads(gap, set)?.columns().map(f64::to_bits));
    }
    Ok(bits)
}

fn temporary() -> Result<tempfile::TempDir, CompareError> {
    tempfile::tempdir().map_err(|source| CompareError::Write {
        path: std::env::temp_dir(),
        source,
    })
}

/// The only file in a folder, if there is only one.
fn only_file(folder: &Path) -> Option<std::path::PathBuf> {
    let mut entries = std::fs::read_dir(folder).ok()?;
    let first = entries.next()?.ok()?.path();
    entries.next().is_none().then_some(first)
}

/// A kept table cut short, emptied, or with a bit turned over is built again, with the same bits.
fn damaged_tables(rows: &mut Rows) -> Result<(), CompareError> {
    let folder = temporary()?;
    let truth = bits(&table(folder.path())?, QUICK.set)?;
    let path = only_file(folder.path()).unwrap_or_default();
    let whole = std::fs::read(&path).unwrap_or_default();
    let turned = |at: usize| {
        let mut bytes = whole.clone();
        if let Some(byte) = bytes.get_mut(at) {
            *byte ^= 1;
        }
        bytes
    };
    let length = whole.len();
    let damages = [
        Vec::new(),
        whole[..length.min(3)].to_vec(),
        whole[..length / 2].to_vec(),
        whole[..length.saturating_sub(1)].to_vec(),
        turned(0),
        turned(length / 2),
        turned(length.saturating_sub(1)),
        vec![0xff; length],
    ];
    let (mut other, mut left) = (0, 0);
    for damaged in &damages {
        let failed = |source| CompareError::Write {
            path: path.clone(),
            source,
        };
        std::fs::write(&path, damaged).map_err(failed)?;
        other += usize::from(bits(&table(folder.path())?, QUICK.set)? != truth);
        left += usize::from(std::fs::read(&path).ok().as_ref() != Some(&whole));
    }
    let name = Method::Bem.name();
    let count = damages.len();
    let empty = f64::from(u8::from(whole.is_empty()));
    rows.add(
        name,
        format!("of {count} damages to a kept table: those that change a load"),
        (0.0, "a checksum over the whole file"),
        other as f64 + empty,
    );
    rows.add(
        name,
        format!("of {count} damages to a kept table: those not mended on disk"),
        (0.0, "what is built again is kept again"),
        left as f64 + empty,
    );
    Ok(())
}

/// Four at once on one cache folder and one output folder; then folders that cannot be written.
fn shared_folders(rows: &mut Rows) -> Result<(), CompareError> {
    let name = Method::Bem.name();
    let (cache, alone) = (temporary()?, temporary()?);
    let truth = bits(&table(alone.path())?, QUICK.set)?;
    let out = OutputFolder::open(cache.path().join("out").as_path())?;
    let tables = cache.path().join("tables");
    let text = "a,b\n1,2\n".repeat(10_000);
    let results: Vec<_> = std::thread::scope(|scope| {
        let work = || -> Result<bool, CompareError> {
            out.write("shared.csv", &text)?;
            Ok(bits(&table(&tables)?, QUICK.set)? == truth)
        };
        let threads: Vec<_> = (0..4).map(|_| scope.spawn(work)).collect();
        threads
            .into_iter()
            .map(std::thread::ScopedJoinHandle::join)
            .collect()
    });
    let failed = results
        .iter()
        .filter(|result| !matches!(result, Ok(Ok(true))))
        .count();
    rows.add(
        name,
        "of 4 at once on one cache and one output folder: those that fail or differ",
        (0.0, "files are written aside and renamed"),
        failed as f64,
    );
    let kept = only_file(&tables).and_then(|path| std::fs::read(path).ok());
    let expected = only_file(alone.path()).and_then(|path| std::fs::read(path).ok());
    let whole =
        kept.is_some() && kept == expected && out.read("shared.csv").as_ref() == Some(&text);
    rows.add(
        name,
        "files left other than one whole table and one whole CSV",
        (0.0, "files are written aside and renamed"),
        f64::from(u8::from(!whole)),
    );
    // Not even the superuser can make a folder below a file.
    let below = alone.path().join("file");
    std::fs::write(&below, "").map_err(|source| CompareError::Write {
        path: below.clone(),
        source,
    })?;
    let refused = matches!(
        OutputFolder::open(&below.join("out")),
        Err(CompareError::Write { .. })
    );
    rows.add(
        ALL,
        "output folders that cannot be written and are not refused",
        (0.0, "tried before anything is computed"),
        f64::from(u8::from(!refused)),
    );
    let built = bits(&table(&below.join("tables"))?, QUICK.set)? == truth;
    rows.add(
        name,
        "tables lost to a cache folder that cannot be written",
        (0.0, "the cache only saves time"),
        f64::from(u8::from(!built)),
    );
    Ok(())
}

/// The same bits by one thread and two, and twice in a row.
fn threads(bench: &Bench, rows: &mut Rows) -> Result<(), CompareError> {
    let options = TableOptions {
        set: LoadSet::planar(1),
        tolerance: 1e-4,
        smallest_gap: 0.3,
    };
    let build = |threads: usize| -> Result<Vec<u64>, CompareError> {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build();
        let pool =
            pool.map_err(|error| CompareError::input("threads", threads, error.to_string()))?;
        pool.install(|| {
            let set = options.set;
            let mut all = bits(&Tabulated::build(Bem::new(1)?, options, &|_| {})?, set)?;
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
    let why = (0.0, "every sum has one order");
    rows.add(
        ALL,
        format!(
            "of {} numbers: those whose bits differ between 1 and 2 threads",
            one.len()
        ),
        why,
        differ(&two),
    );
    rows.add(
        ALL,
        "those that differ from one run to the next",
        why,
        differ(&again),
    );
    Ok(())
}
