//! The pictures that a command writes, with their file names.

use crate::error::CommandError;
use crate::figures::{self, FigureError, GrowthMap};
use compare::judge::LeaderRow;
use compare::numbers::written;
use compare::study::cargo::CargoRow;
use compare::study::encounters::Drawn;
use compare::study::kinetics::KineticsRow;
use compare::study::maps::{FateRow, Pair, ScatterRow, TrustRow, TrustShares};
use compare::study::panels::PanelRun;
use compare::study::ratios::RatioRow;
use compare::study::sensitivity::SensitivityCase;
use compare::study::stress::StressRow;
use compare::{Approach, Encounter, Method, OffsetRow};

/// A picture and the name of its file.
pub(crate) struct Picture {
    pub(crate) file_name: String,
    pub(crate) svg: String,
}

/// Pictures of the trajectories and deflections of one approach, as far as `drawn` allows; none without runs.
pub(crate) fn of_encounters(
    approach: Approach,
    encounters: &[Encounter],
    drawn: Drawn,
) -> Result<Vec<Picture>, CommandError> {
    let named = |name: &str, svg| picture(format!("{approach}-{name}.svg"), svg);
    let mut pictures = Vec::new();
    if drawn == Drawn::Paths {
        pictures.extend(named("trajectories", figures::trajectories(encounters))?);
    }
    if drawn != Drawn::Nothing {
        pictures.extend(named("deflection", figures::deflection(encounters))?);
    }
    Ok(pictures)
}

/// Picture of the changes by an offset out of the plane; none without runs.
pub(crate) fn of_offsets(rows: &[OffsetRow]) -> Result<Option<Picture>, CommandError> {
    picture("offset.svg".to_owned(), figures::offset(rows))
}

/// Picture of the offsets out of the plane at which headings turn; none without cases.
pub(crate) fn of_sensitivity(cases: &[SensitivityCase]) -> Result<Option<Picture>, CommandError> {
    picture("sensitivity.svg".to_owned(), figures::sensitivity(cases))
}

/// Picture of the trajectories under gravity; none without runs.
pub(crate) fn of_bottom_heavy(runs: &[PanelRun]) -> Result<Option<Picture>, CommandError> {
    of_panels("bottom-heavy.svg", "Bottom-heavy squirmers", runs)
}

/// Picture of trajectories with a panel for each start; none without runs.
pub(crate) fn of_panels(
    file_name: &str,
    title: &str,
    runs: &[PanelRun],
) -> Result<Option<Picture>, CommandError> {
    picture(file_name.to_owned(), figures::panels(runs, title))
}

/// Leaves out an empty picture. A figure is [`FigureError::Empty`] if there are no runs, or if their paths were not
/// kept. If all runs failed, there is a picture with "no data" in each panel. It replaces the picture of an earlier
/// command.
fn picture(
    file_name: String,
    svg: Result<String, FigureError>,
) -> Result<Option<Picture>, CommandError> {
    match svg {
        Ok(svg) => Ok(Some(Picture { file_name, svg })),
        Err(FigureError::Empty { .. }) => Ok(None),
        Err(error) => Err(error.into()),
    }
}

/// One map for each method, beta and bottom-heaviness.
pub(crate) fn of_scatter(rows: &[ScatterRow]) -> Result<Vec<Picture>, CommandError> {
    let same = |a: &ScatterRow, b: &ScatterRow| {
        let key = |row: &ScatterRow| (row.beta.to_bits(), row.g.to_bits());
        a.method == b.method && key(a) == key(b)
    };
    let drawn = rows.chunk_by(same).map(|map| {
        let svg = figures::scatter(map);
        let ScatterRow {
            method, beta, g, ..
        } = map[0];
        picture(map_name("scatter", method, Pair { beta, g, dz: 0.0 }), svg)
    });
    drawn.filter_map(Result::transpose).collect()
}

/// Picture of the shares as a function of beta or of the bottom-heaviness.
pub(crate) fn of_fates(rows: &[FateRow]) -> Result<Vec<Picture>, CommandError> {
    let drawn = picture("fates.svg".to_owned(), figures::fates(rows))?;
    Ok(drawn.into_iter().collect())
}

/// One map for each method and pair.
pub(crate) fn of_trust(rows: &[TrustRow]) -> Result<Vec<Picture>, CommandError> {
    let drawn = rows.chunk_by(compare::study::maps::same_map).map(|map| {
        let svg = figures::trust(map);
        let TrustRow {
            method,
            beta,
            g,
            dz,
            ..
        } = map[0];
        picture(map_name("trust", method, Pair { beta, g, dz }), svg)
    });
    drawn.filter_map(Result::transpose).collect()
}

/// One picture of the shares as a function of the offset, for each method and bottom-heaviness with several offsets.
pub(crate) fn of_trust_against_offset(
    shares: &[TrustShares],
) -> Result<Vec<Picture>, CommandError> {
    let mut shares = shares.to_vec();
    shares.sort_by(|a, b| a.method.cmp(&b.method).then(a.g.total_cmp(&b.g)));
    let same =
        |a: &TrustShares, b: &TrustShares| a.method == b.method && a.g.total_cmp(&b.g).is_eq();
    let drawn = shares.chunk_by(same).map(|alike| {
        let name = format!(
            "trust-dz-{}{}.svg",
            alike[0].method,
            suffix("g", alike[0].g)
        );
        picture(name, figures::trust_against_offset(alike))
    });
    drawn.filter_map(Result::transpose).collect()
}

/// Picture of the growth of an offset out of the plane, in radii, with a panel for each map; none without maps.
pub(crate) fn of_growth(maps: &[GrowthMap], offset: f64) -> Result<Option<Picture>, CommandError> {
    picture("growth.svg".to_owned(), figures::growth(maps, offset))
}

/// Picture of scores against time; none if no model has both.
pub(crate) fn of_scores(rows: &[LeaderRow]) -> Result<Option<Picture>, CommandError> {
    let name = "score-against-time.svg".to_owned();
    picture(name, figures::score_against_time(rows))
}

/// One picture of the shares against the ratio of the radii for each method.
pub(crate) fn of_ratios(rows: &[RatioRow]) -> Result<Vec<Picture>, CommandError> {
    let drawn = (rows.chunk_by(|a, b| a.method == b.method)).map(|alike| {
        let name = format!("ratios-{}.svg", alike[0].method);
        picture(name, figures::ratios(alike))
    });
    drawn.filter_map(Result::transpose).collect()
}

/// One picture of the displacements of cargo for each swimmer.
pub(crate) fn of_cargo(rows: &[CargoRow]) -> Result<Vec<Picture>, CommandError> {
    let mut rows = rows.to_vec();
    rows.sort_by(|a, b| a.beta.total_cmp(&b.beta));
    let same = |a: &CargoRow, b: &CargoRow| a.beta.total_cmp(&b.beta).is_eq();
    let drawn = rows.chunk_by(same).map(|alike| {
        let name = format!("cargo-beta{}.svg", written(alike[0].beta));
        picture(name, figures::cargo(alike))
    });
    drawn.filter_map(Result::transpose).collect()
}

/// Picture of collision integrals; none without rows.
pub(crate) fn of_kinetics(rows: &[KineticsRow]) -> Result<Option<Picture>, CommandError> {
    picture("kinetics.svg".to_owned(), figures::kinetics(rows))
}

/// Stresslets and rates of work against the gap, one picture for each ratio of the radii with several gaps.
pub(crate) fn of_stress(rows: &[StressRow]) -> Result<Vec<Picture>, CommandError> {
    let mut rows = rows.to_vec();
    rows.sort_by(|a, b| a.ratio.total_cmp(&b.ratio));
    let drawn = (rows.chunk_by(|a, b| a.ratio.total_cmp(&b.ratio).is_eq())).map(|alike| {
        let ratio = alike[0].ratio;
        let name = if ratio.total_cmp(&1.0).is_eq() {
            "stress.svg".to_owned()
        } else {
            format!("stress-ratio{}.svg", written(ratio))
        };
        picture(name, figures::stress_by_gap(alike))
    });
    drawn.filter_map(Result::transpose).collect()
}

/// File name of a map. Its numbers are short, and different numbers give different names.
fn map_name(name: &str, method: Method, Pair { beta, g, dz }: Pair) -> String {
    let beta = written(beta);
    let (gravity, offset) = (suffix("g", g), suffix("dz", dz));
    format!("{name}-{method}-beta{beta}{gravity}{offset}.svg")
}

fn suffix(name: &str, value: f64) -> String {
    if value == 0.0 {
        String::new()
    } else {
        format!("-{name}{}", written(value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_maps_are_short_and_differ_where_their_numbers_do() {
        // The least and the largest numbers, those with most digits, and neighbours.
        let values = [
            0.0,
            5.0,
            0.1,
            0.1_f64.next_up(),
            1e-300,
            1e-300_f64.next_up(),
            -2.225_073_858_507_201_4e-308,
            f64::from_bits(1),
            999_999.999_999_999_9,
            1e6,
            f64::MAX,
            f64::MIN,
        ];
        let mut names = Vec::new();
        for beta in values {
            for g in values {
                let pair = Pair { beta, g, dz: beta };
                let name = map_name("scatter", Method::LtCorrected, pair);
                // Three numbers of 24 characters at most, and the words.
                assert!(name.len() <= 106, "{name}");
                assert!(!names.contains(&name), "{name}");
                names.push(name);
            }
        }
        let tiny = Pair {
            beta: 1e-300,
            g: 0.0,
            dz: 0.0,
        };
        assert_eq!(
            map_name("trust", Method::Lt, tiny),
            "trust-lt-beta1e-300.svg"
        );
        let usual = Pair {
            beta: -2.5,
            g: 30.0,
            dz: 0.0,
        };
        assert_eq!(
            map_name("scatter", Method::Lt, usual),
            "scatter-lt-beta-2.5-g30.svg"
        );
    }
}
