//! Reads a load and its error from the package of reference numbers.

use std::error::Error;
use std::path::Path;

/// The load `name` at a gap, in radii of sphere 1, for a ratio of the radii, and how far it may be off.
pub fn load(
    folder: &Path,
    ratio: f64,
    gap: f64,
    name: &str,
) -> Result<Option<(f64, f64)>, Box<dyn Error>> {
    let text = std::fs::read_to_string(folder.join("loads.csv"))?;
    // The columns are ratio, gap, name, value and error_estimate.
    for line in text.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let [of_ratio, at, of_name, value, error] = cells[..] else {
            return Err(format!("not a row of five cells: {line}").into());
        };
        if of_name == name && of_ratio.parse() == Ok(ratio) && at.parse() == Ok(gap) {
            return Ok(Some((value.parse()?, error.parse()?)));
        }
    }
    Ok(None)
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1).unwrap_or_else(|| ".".to_owned());
    let (value, error) = load(Path::new(&folder), 1.0, 0.1, "X11A")?.ok_or("no such load")?;
    println!("X11A of equal spheres at a gap of 0.1 is {value} within {error}");
    Ok(())
}
