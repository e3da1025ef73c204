//! What a share of a sweep is, beside its rows: enough to tell whether shares belong together.

use std::fs::File;
use std::io::Read;
use std::ops::Range;
use std::path::Path;

use scene::{Gap, Hydrodynamics, LoadSet, SceneError};
use serde::{Deserialize, Serialize};

use super::Share;
use crate::{CompareError, Model};

/// Longest manifest, in bytes.
const LONGEST: u64 = 1 << 26;

/// Gaps whose loads tell one table from another, in radii.
const GAPS: [f64; 4] = [0.02, 0.3, 1.5, 20.0];

/// Arguments of the functions whose bits tell one arithmetic from another.
const ARGUMENTS: u32 = 256;

/// The file `sweep.json` beside the rows of a share.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    /// What is the same for all shares of a sweep.
    pub sweep: SweepIdentity,
    /// Which share this is.
    pub share: Share,
    /// First row of the share and the one behind its last, counted from 0 over the whole sweep.
    pub rows: Range<usize>,
    /// Rows of the whole sweep.
    pub all_rows: usize,
    /// Rows of runs that failed.
    pub failed: usize,
    /// Length of the file of the rows, in bytes.
    pub bytes: u64,
    /// CRC-32 of that file.
    pub checksum: String,
    /// What its numbers were computed with; more than one only where shares were merged.
    pub arithmetic: Vec<Arithmetic>,
    /// Threads of the process that finished it.
    pub threads: usize,
    /// Wall-clock time of that process, in seconds.
    pub seconds: f64,
}

/// What the rows of a sweep depend on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SweepIdentity {
    /// Version of the program.
    pub version: String,
    /// Text of the family.
    pub family: String,
    /// What is varied, outermost first.
    pub axes: Vec<Axis>,
    /// The models, outermost of all.
    pub models: Vec<ManifestModel>,
    /// How each run is made.
    pub run: String,
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

/// A model of a sweep.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ManifestModel {
    /// Its name.
    pub name: String,
    /// What its answers depend on.
    pub fingerprint: String,
}

/// What numbers were computed with. Rows of one sweep have the same bits where this is the same.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Arithmetic {
    /// Kind of processor and system.
    pub machine: String,
    /// CRC-32 of the bits of elementary functions.
    pub functions: String,
    /// CRC-32 of the bits of each model's loads at some gaps.
    pub loads: Vec<String>,
}

impl Arithmetic {
    /// That of this machine, by these models.
    ///
    /// # Errors
    /// Those of the models.
    pub fn of(models: &[Model], set: LoadSet) -> Result<Self, SceneError> {
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
        let loads = (models.iter())
            .map(|model| {
                let mut bits = crc32fast::Hasher::new();
                for eps in GAPS {
                    // Gaps beyond a model's range have no loads.
                    if let Ok(loads) = model.loads(Gap::new(eps)?, set) {
                        for load in loads.columns() {
                            bits.update(&load.to_bits().to_le_bytes());
                        }
                    }
                    // Where each gap is a solve, one has to do.
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
            loads,
        })
    }
}

/// A checksum as it stands in manifests.
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
    /// Name of its file.
    pub const FILE: &'static str = "sweep.json";

    /// As JSON, for people too.
    ///
    /// # Errors
    /// [`CompareError::Json`].
    pub fn json(&self) -> Result<String, CompareError> {
        Ok(serde_json::to_string_pretty(self)? + "\n")
    }

    /// The manifest in a folder.
    ///
    /// # Errors
    /// [`CompareError::Share`] if there is none, or it is none.
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
        serde_json::from_str(&text).map_err(|error| torn(format!("it is no manifest: {error}")))
    }
}
