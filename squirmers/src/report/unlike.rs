//! The sections on unlike radii: outcomes and trust against the ratio of the radii, and entrainment of a passive sphere.

use super::findings::{number, percent};
use super::written;
use crate::commands::unlike::{BETA, FAR, GRID, OFFSETS, RATIOS, SWIMMERS, cargoes};
use crate::error::CommandError;
use crate::page::{Section, Table};
use crate::pictures;
use compare::numbers::{rounded, size};
use compare::output::{OutputFolder, csv_text};
use compare::study::cargo::{Cargo, CargoRow, CargoSweep};
use compare::study::maps::Grid;
use compare::study::ratios::{RatioRow, Ratios, UnlikePair};
use compare::sweep::SweepOptions;
use compare::{CompareError, Method, Model, ModelOptions, SlopeRow, contact_slopes};

/// Tolerance of the integrator in the maps, as in the command `ratios`.
const TOLERANCE: f64 = 1e-7;

/// Squirmer parameters of a pair of unlike squirmers besides: a puller and a pusher.
const MIXED: [f64; 2] = [5.0, -5.0];

/// Ratios of the radii for which the coefficients of lubrication theory are compared with exact ones.
const SLOPES: [f64; 2] = [0.5, 2.0];

/// What is run of unlike radii, by lubrication theory as published and by exact hydrodynamics.
pub(super) struct UnlikeRadii<'a> {
    lubrication: Vec<Model>,
    exact: Model,
    pairs: Vec<UnlikePair>,
    cargoes: Vec<Cargo>,
    sweep: SweepOptions,
    out: &'a OutputFolder,
}

impl<'a> UnlikeRadii<'a> {
    /// None unless both models are asked for.
    pub(super) fn new(
        methods: &[Method],
        options: &ModelOptions,
        sweep: &SweepOptions,
        out: &'a OutputFolder,
    ) -> Result<Option<Self>, CommandError> {
        let asked = [Method::Lt, Method::Exact].map(|method| methods.contains(&method));
        if asked != [true; 2] {
            return Ok(None);
        }
        let of = |beta: [f64; 2]| RATIOS.map(|ratio| UnlikePair { beta, ratio });
        let alike = BETA.into_iter().flat_map(|beta| of([beta; 2]));
        let pairs: Vec<_> = alike.chain(of(MIXED)).collect();
        let cargoes = cargoes(&SWIMMERS, &RATIOS, &OFFSETS, FAR);
        let starts = pairs.iter().map(|pair| pair.scene(0.3, 0.4));
        let options = options
            .clone()
            .for_scenes(starts.chain(cargoes.iter().map(Cargo::scene)))?;
        let set_up = |method| Model::set_up(method, &options);
        Ok(Some(Self {
            lubrication: vec![set_up(Method::Lt)?],
            exact: set_up(Method::Exact)?,
            pairs,
            cargoes,
            sweep: *sweep,
            out,
        }))
    }

    fn ratios(&self) -> Result<Ratios<'_>, CompareError> {
        let mut options = self.sweep;
        options.run.tolerance = TOLERANCE;
        Ok(Ratios {
            judged: self.lubrication.iter().collect(),
            exact: &self.exact,
            pairs: &self.pairs,
            grid: Grid::new(GRID)?,
            options,
            out: self.out,
        })
    }

    /// Checks that no finished rows of another command would be deleted.
    pub(super) fn check(&self) -> Result<(), CommandError> {
        Ok(self.ratios()?.check()?)
    }

    /// Both sections.
    pub(super) fn sections(self) -> Result<Vec<Section>, CommandError> {
        Ok(vec![self.outcomes()?, self.entrainment()?])
    }

    fn outcomes(&self) -> Result<Section, CommandError> {
        let title = "Unlike radii: outcomes and trust".to_owned();
        let id = "ratios".to_owned();
        let Some(rows) = self.ratios()?.rows()? else {
            let prose = vec![
                "The time limit was reached. The same command continues from here.".to_owned(),
            ];
            return Ok(Section {
                id,
                title,
                prose,
                ..Section::default()
            });
        };
        let csv = csv_text(&rows)?;
        self.out.write("ratios.csv", &csv)?;
        let of_contact = contact_slopes(&SLOPES, 2)?;
        let slopes = csv_text(&of_contact)?;
        self.out.write("slopes.csv", &slopes)?;
        Ok(Section {
            id,
            title,
            finding: finding(&rows),
            prose: vec![
                held(&of_contact),
                format!(
                    "The second squirmer has another radius. The two start at a gap of one radius of the smaller one, where \
                 lubrication begins to act, from {GRID} by {GRID} incoming angles; repulsion scales with the smaller one, so \
                 that a pair and its inverse ratio, named the other way round, are the same."
                ),
            ],
            figures: written(pictures::of_ratios(&rows)?, self.out)?,
            tables: vec![
                Table::from_csv("Shares of the plane.", "ratios.csv", &csv)?,
                Table::from_csv(
                    "Factor of ln(1/ε) in the loads by squirming as the gap closes: fitted to exact loads, as the paper prints it, and \
                     with 12 in place of 9 in the axial force XF. Names have the numbers of the loaded sphere, of the squirming \
                     one, and of the mode.",
                    "slopes.csv",
                    &slopes,
                )?,
            ],
        })
    }

    fn entrainment(self) -> Result<Section, CommandError> {
        let models: Vec<Model> = self.lubrication.into_iter().chain([self.exact]).collect();
        let sweep = CargoSweep {
            models: &models,
            cargoes: &self.cargoes,
            options: self.sweep,
            out: self.out,
        };
        let mut rows = Vec::new();
        sweep.run(&mut |row| rows.push(row))?;
        let csv = csv_text(&rows)?;
        Ok(Section {
            id: "cargo".to_owned(),
            title: "A swimmer moves a passive sphere".to_owned(),
            finding: of_cargo(&rows),
            prose: vec![format!(
                "A swimmer passes a passive sphere of λ times its radius, on a path from infinity to infinity: what its far field \
                 moves the sphere beyond a distance of {FAR} radii of the larger one is added in closed form. Lubrication theory \
                 moves it in contact alone."
            )],
            figures: written(pictures::of_cargo(&rows)?, self.out)?,
            tables: vec![Table::from_csv(
                "Displacement of the passive sphere.",
                "cargo.csv",
                &csv,
            )?],
        })
    }
}

/// Which coefficients of lubrication theory hold.
fn held(rows: &[SlopeRow]) -> String {
    let off = |of: fn(&SlopeRow) -> f64, axial: bool| {
        (rows.iter())
            .filter(|row| row.name.starts_with("XF") == axial)
            .map(|row| (of(row) / row.exact - 1.0).abs())
            .fold(0.0, f64::max)
    };
    let across = off(|row| row.published, false);
    let [published, corrected] = [
        off(|row| row.published, true),
        off(|row| row.corrected, true),
    ];
    format!(
        "As the gap closes, the loads by squirming grow as ln(1/ε). The paper's factors hold for unlike radii across the line of \
         centres, within {}; along it the paper's 9λ²/(1 + λ)² is off by {}, and 12λ²/(1 + λ)² holds within {}.",
        size(across),
        percent(published),
        size(corrected)
    )
}

/// Whether two numbers are one and the same setting.
fn same(a: f64, b: f64) -> bool {
    a.total_cmp(&b).is_eq()
}

/// Over how much of the incoming angles lubrication theory gives another outcome, at the ratio at which it does worst and at equal radii.
fn finding(rows: &[RatioRow]) -> String {
    let wrong = |row: &RatioRow| row.other_outcome + row.beyond_45_deg;
    let Some(worst) = rows.iter().max_by(|a, b| wrong(a).total_cmp(&wrong(b))) else {
        return String::new();
    };
    let equal = (rows.iter()).find(|row| {
        same(row.beta1, worst.beta1) && same(row.beta2, worst.beta2) && same(row.ratio, 1.0)
    });
    let of_equal = equal.map_or(String::new(), |row| {
        format!(" (equal radii: {})", percent(wrong(row)))
    });
    format!(
        "Of unlike radii lubrication theory gives another outcome, or a deflection that is off by more than 45°, over up to {} \
         of the incoming angles, at β = {} and {} with a ratio of {}{of_equal}.",
        percent(wrong(worst)),
        number(worst.beta1),
        number(worst.beta2),
        number(worst.ratio)
    )
}

/// The largest displacement by lubrication theory next to the exact one.
fn of_cargo(rows: &[CargoRow]) -> String {
    let of = |method: Method| rows.iter().filter(move |row| row.method == method);
    let pushed = of(Method::Exact).filter(|row| row.along.is_finite());
    let Some(exact) = pushed.max_by(|a, b| a.along.total_cmp(&b.along)) else {
        return String::new();
    };
    let judged = of(Method::Lt).find(|row| {
        same(row.beta, exact.beta) && same(row.ratio, exact.ratio) && same(row.b, exact.b)
    });
    let by_lubrication = match judged {
        Some(row) if row.along.is_finite() => {
            format!("{} by lubrication theory", rounded(row.along, 2))
        }
        Some(row) => format!("the outcome by lubrication theory: {}", row.outcome),
        None => "not computed by lubrication theory".to_owned(),
    };
    format!(
        "A swimmer with β = {} that passes at {} radii pushes a sphere of {} times its radius farthest: {} radii along its path \
         ({by_lubrication}).",
        number(exact.beta),
        number(exact.b),
        number(exact.ratio),
        rounded(exact.along, 2)
    )
}
