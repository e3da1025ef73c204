//! Published tables, from `fixtures` (sources in `fixtures/README.md`).

use serde::Deserialize;

/// Resistance scalars of two equal spheres at one centre distance.
#[derive(Clone, Debug, Deserialize)]
#[allow(non_snake_case, missing_docs)]
pub struct ResistanceRow {
    pub r_over_a: f64,
    pub X11A: f64,
    pub X12A: f64,
    pub Y11A: f64,
    pub Y12A: f64,
    pub Y11B: f64,
    pub Y12B: f64,
    pub X11C: f64,
    pub X12C: f64,
    pub Y11C: f64,
    pub Y12C: f64,
}

impl ResistanceRow {
    /// Gap `eps = r/a - 2`.
    #[must_use]
    pub fn eps(&self) -> f64 {
        self.r_over_a - 2.0
    }

    /// The scalars in the order in which loads are named.
    #[must_use]
    pub fn scalars(&self) -> [(&'static str, f64); 10] {
        [
            ("X11A", self.X11A),
            ("X12A", self.X12A),
            ("Y11A", self.Y11A),
            ("Y12A", self.Y12A),
            ("Y11B", self.Y11B),
            ("Y12B", self.Y12B),
            ("X11C", self.X11C),
            ("X12C", self.X12C),
            ("Y11C", self.Y11C),
            ("Y12C", self.Y12C),
        ]
    }
}

/// Townsend's table of resistance scalars.
///
/// # Panics
/// If the fixture does not parse.
#[must_use]
pub fn two_sphere_resistance() -> Vec<ResistanceRow> {
    let text = include_str!("../../fixtures/two_sphere_resistance.csv");
    csv::Reader::from_reader(text.as_bytes())
        .deserialize()
        .collect::<Result<_, _>>()
        .expect("the fixture holds one number in each cell")
}
