//! The manifest of a share. It describes the sweep, so that shares of different sweeps are never merged.

use std::fs::File;
use std::io::Read;
use std::ops::Range;
use std::path::Path;
use std::time::Instant;

use scene::mobility::MobilitySet;
use scene::{Gap, LoadSet, SceneError};
use serde::{Deserialize, Serialize};

use super::Share;
use crate::output::OutputFolder;
use crate::submission::shown;
use crate::{CompareError, Model};

/// Largest size of a manifest, in bytes.
const LONGEST: u64 = 1 << 26;

/// Longest piece of a manifest that a message shows, in bytes.
const SHOWN: usize = 200;

/// Length of a checksum in a manifest.
const CHECKSUM: usize = 8;

/// Gaps, in radii. The bits of the mobilities at these gaps identify a table.
const GAPS: [f64; 4] = [0.02, 0.3, 1.5, 20.0];

/// Arguments of elementary functions. The bits of their values identify the arithmetic of a machine.
const ARGUMENTS: u32 = 256;

/// The manifest: the file `sweep.json` beside the rows of a share.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    /// Name of the file of the rows, one of [`Self::ROWS`].
    #[serde(
        default = "Manifest::usual",
        skip_serializing_if = "Manifest::is_usual"
    )]
    pub file: String,
    /// Description of the sweep, equal for all its shares.
    pub sweep: SweepIdentity,
    /// The number of this share, and the number of shares.
    pub share: Share,
    /// Range of rows of the share, counted from 0 over the whole sweep; the end is excluded.
    pub rows: Range<usize>,
    /// Number of rows of the whole sweep.
    pub all_rows: usize,
    /// Number of rows of failed runs.
    pub failed: usize,
    /// Length of the file of the rows, in bytes.
    pub bytes: u64,
    /// CRC-32 of the file of the rows.
    pub checksum: String,
    /// Machines and arithmetic that computed the rows. Only merged shares can have several.
    pub arithmetic: Vec<Arithmetic>,
    /// Threads of the process that finished the share.
    pub threads: usize,
    /// Wall-clock time of the process that finished the share, in seconds.
    pub seconds: f64,
}

/// Everything that the rows of a sweep depend on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SweepIdentity {
    /// Version of the program.
    pub version: String,
    /// Text of the family's scene file; for other sweeps what they are of, in words.
    pub family: String,
    /// The parameters that are varied; the first one is the outer loop.
    pub axes: Vec<Axis>,
    /// The models, which are the outermost loop.
    pub models: Vec<ManifestModel>,
    /// Options of each run.
    pub run: String,
}

impl SweepIdentity {
    /// Everything that the rows of a share depend on, in one line.
    pub(crate) fn key(
        &self,
        name: &str,
        share: Share,
        size: usize,
    ) -> Result<String, CompareError> {
        let mut checksum = crc32fast::Hasher::new();
        checksum.update(serde_json::to_string(self)?.as_bytes());
        Ok(format!(
            "{} {name} {:08x}, share {share}, {size} rows at a time",
            self.version,
            checksum.finalize(),
        ))
    }
}

/// A parameter and its values.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Axis {
    /// Name of the parameter.
    pub name: String,
    /// Its values, in order.
    pub values: Vec<f64>,
}

/// A hydrodynamic model of a sweep.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ManifestModel {
    /// Name of the model.
    pub name: String,
    /// Fingerprint of everything that its loads depend on.
    pub fingerprint: String,
}

impl ManifestModel {
    /// The models of a sweep.
    pub(crate) fn of(models: &[Model]) -> Vec<Self> {
        let of = |model: &Model| Self {
            name: model.method().to_string(),
            fingerprint: model.fingerprint(),
        };
        models.iter().map(of).collect()
    }
}

/// The machine and its arithmetic. Rows of one sweep have the same bits on machines with an equal `Arithmetic`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Arithmetic {
    /// Kind of processor and system.
    pub machine: String,
    /// CRC-32 of the bits of elementary functions.
    pub functions: String,
    /// CRC-32 of the bits of each model's mobilities at some gaps.
    pub mobilities: Vec<String>,
}

impl Arithmetic {
    /// The arithmetic of this machine with the given models, by mobilities that follow from the loads `read`: all of them are tabulated.
    ///
    /// # Errors
    /// The errors of the models.
    pub fn of(models: &[Model], read: LoadSet) -> Result<Self, SceneError> {
        let mut functions = crc32fast::Hasher::new();
        for k in 1..=ARGUMENTS {
            let x = f64::from(k) / 17.0;
            for value in [
                x.sin(),
                x.cos(),
                x.tan(),
                x.exp(),
                x.ln(),
                x.sqrt(),
                x.atan2(1.5),
                x.exp_m1(),
                x.ln_1p(),
                x.powf(0.37),
                x.sinh(),
                x.acos(),
                x.mul_add(x, -1.0 / x),
            ] {
                functions.update(&value.to_bits().to_le_bytes());
            }
        }
        let mobilities = (models.iter())
            .map(|model| {
                let read = MobilitySet {
                    loads: read.with_swirl(0),
                    torque: true,
                };
                let mut bits = crc32fast::Hasher::new();
                for eps in GAPS {
                    let gap = Gap::new(eps)?;
                    for of_ratio in model.of_each_ratio() {
                        // A model answers at no gap beyond its range.
                        let named = if of_ratio.has_unlike_radii() {
                            let mobility = of_ratio.interacting_mobility_of_each(gap, read);
                            mobility.map(|mobility| mobility.named(read))
                        } else {
                            of_ratio
                                .mobility(gap, read)
                                .map(|mobility| mobility.named(read))
                        };
                        for (_, value) in named.unwrap_or_default() {
                            bits.update(&value.to_bits().to_le_bytes());
                        }
                    }
                    // A model that solves for every gap is slow, so one gap must be enough.
                    if model.is_direct() {
                        break;
                    }
                }
                Ok(written(bits))
            })
            .collect::<Result<_, SceneError>>()?;
        let (system, architecture) = (std::env::consts::OS, std::env::consts::ARCH);
        Ok(Self {
            machine: format!("{architecture} {system}"),
            functions: written(functions),
            mobilities,
        })
    }
}

/// Why a file is not a manifest.
fn no_manifest(reason: &str) -> String {
    format!("it is no manifest: {reason}")
}

/// A checksum as manifests write it.
pub(super) fn written(checksum: crc32fast::Hasher) -> String {
    format!("{:08x}", checksum.finalize())
}

/// Length and checksum of a file.
pub(super) fn measured(path: &Path) -> std::io::Result<(u64, String)> {
    let mut file = File::open(path)?;
    let (mut bytes, mut checksum) = (0, crc32fast::Hasher::new());
    let mut buffer = vec![0; 1 << 20];
    loop {
        let read = file.read(&mut buffer)?;
        if read == 0 {
            return Ok((bytes, written(checksum)));
        }
        bytes += read as u64;
        checksum.update(&buffer[..read]);
    }
}

impl Manifest {
    /// Name of the manifest's file.
    pub const FILE: &'static str = "sweep.json";

    /// Names that the file of the rows may have; the first one is left out of a manifest.
    pub const ROWS: [&'static str; 2] = ["sweep.csv", "collisions.csv"];

    fn usual() -> String {
        Self::ROWS[0].to_owned()
    }

    fn is_usual(name: &str) -> bool {
        name == Self::ROWS[0]
    }

    /// Writes the manifest of a share whose rows are complete in the file `NAME.csv`.
    ///
    /// # Errors
    /// [`CompareError::Write`]; [`CompareError::Json`]; the errors of the models.
    pub(crate) fn write(
        (out, name): (&OutputFolder, &str),
        sweep: SweepIdentity,
        (share, all_rows, failed): (Share, usize, usize),
        (models, read): (&[Model], LoadSet),
        began: Instant,
    ) -> Result<(), CompareError> {
        let file = format!("{name}.csv");
        let path = out.path().join(&file);
        let (bytes, checksum) =
            measured(&path).map_err(|source| CompareError::Write { path, source })?;
        let manifest = Self {
            file,
            sweep,
            share,
            rows: share.units(all_rows),
            all_rows,
            failed,
            bytes,
            checksum,
            arithmetic: vec![Arithmetic::of(models, read)?],
            threads: rayon::current_num_threads(),
            seconds: began.elapsed().as_secs_f64(),
        };
        out.write(Self::FILE, &manifest.json()?)?;
        Ok(())
    }

    /// The manifest as JSON that people can read.
    ///
    /// # Errors
    /// [`CompareError::Json`].
    pub fn json(&self) -> Result<String, CompareError> {
        Ok(serde_json::to_string_pretty(self)? + "\n")
    }

    /// Reads the manifest in a folder.
    ///
    /// # Errors
    /// [`CompareError::Share`] if there is no manifest, or if the file is not a manifest.
    pub fn read(folder: &Path) -> Result<Self, CompareError> {
        let path = folder.join(Self::FILE);
        let torn = |reason: String| CompareError::Share {
            path: path.clone(),
            reason,
        };
        let file = File::open(&path)
            .map_err(|error| torn(format!("{error}: the share is not there, or not finished")))?;
        let mut text = String::new();
        file.take(LONGEST)
            .read_to_string(&mut text)
            .map_err(|error| torn(error.to_string()))?;
        // What the parser quotes of the file may have several lines.
        let unread = |error: serde_json::Error| shown(&error.to_string(), SHOWN);
        let manifest: Self =
            serde_json::from_str(&text).map_err(|error| torn(no_manifest(&unread(error))))?;
        // A name from outside is no path.
        if !Self::ROWS.contains(&manifest.file.as_str()) {
            let known = Self::ROWS.join(" or ");
            let file = shown(&manifest.file, SHOWN);
            return Err(torn(no_manifest(&format!(
                "its rows are in '{file}', not in {known}"
            ))));
        }
        manifest
            .check()
            .map_err(|reason| torn(no_manifest(&reason)))?;
        Ok(manifest)
    }

    /// Refuses numbers that no sweep writes: shares are listed, and counts are added up.
    fn check(&self) -> Result<(), String> {
        let Self {
            share,
            rows,
            failed,
            seconds,
            checksum,
            ..
        } = self;
        if !share.is_allowed() {
            return Err(format!("there is no share {share}"));
        }
        if *failed > rows.len() {
            return Err(format!("{failed} runs of {} rows failed", rows.len()));
        }
        if *seconds < 0.0 {
            return Err(format!("it took {seconds} seconds"));
        }
        let is_digit = |digit: char| digit.is_ascii_hexdigit();
        if checksum.len() != CHECKSUM || !checksum.chars().all(is_digit) {
            let checksum = shown(checksum, SHOWN);
            return Err(format!("'{checksum}' is no checksum"));
        }
        Ok(())
    }
}
