//! The pictures that a command writes, by their file names.

use crate::figures::{self, FigureError};
use crate::maps::{FateRow, ScatterRow, TrustRow};
use crate::{Approach, CompareError, Encounter, OffsetRow};

/// A picture and the name of its file.
pub(crate) struct Picture {
    pub(crate) file_name: String,
    pub(crate) svg: String,
}

/// Trajectories and deflections of one approach; none where no run has a result.
pub(crate) fn of_encounters(
    approach: Approach,
    encounters: &[Encounter],
) -> Result<Vec<Picture>, CompareError> {
    let drawn = [
        ("trajectories", figures::trajectories(encounters)),
        ("deflection", figures::deflection(encounters)),
    ];
    drawn
        .into_iter()
        .filter_map(|(name, svg)| picture(format!("{approach}-{name}.svg"), svg).transpose())
        .collect()
}

/// The offset sensitivity; none where no run has a result.
pub(crate) fn of_offsets(rows: &[OffsetRow]) -> Result<Option<Picture>, CompareError> {
    picture("offset.svg".to_owned(), figures::offset(rows))
}

/// A sweep of which nothing could be run has rows that say so, but no picture.
fn picture(
    file_name: String,
    svg: Result<String, FigureError>,
) -> Result<Option<Picture>, CompareError> {
    match svg {
        Ok(svg) => Ok(Some(Picture { file_name, svg })),
        Err(FigureError::Empty { .. }) => Ok(None),
        Err(error) => Err(error.into()),
    }
}

/// A picture for each method, beta and bottom-heaviness.
pub(crate) fn of_scatter(rows: &[ScatterRow]) -> Result<Vec<Picture>, CompareError> {
    let same = |a: &ScatterRow, b: &ScatterRow| {
        let key = |row: &ScatterRow| (row.beta.to_bits(), row.g.to_bits());
        a.method == b.method && key(a) == key(b)
    };
    let drawn = rows.chunk_by(same).map(|map| {
        let svg = figures::scatter(map);
        picture(
            map_name("scatter", &map[0].method, map[0].beta, map[0].g),
            svg,
        )
    });
    drawn.filter_map(Result::transpose).collect()
}

/// Shares against beta, or against bottom-heaviness.
pub(crate) fn of_fates(rows: &[FateRow]) -> Result<Vec<Picture>, CompareError> {
    let drawn = picture("fates.svg".to_owned(), figures::fates(rows))?;
    Ok(drawn.into_iter().collect())
}

/// A picture for each method, beta and bottom-heaviness.
pub(crate) fn of_trust(rows: &[TrustRow]) -> Result<Vec<Picture>, CompareError> {
    let drawn = rows.chunk_by(crate::maps::same_map).map(|map| {
        let svg = figures::trust(map);
        picture(
            map_name("trust", &map[0].method, map[0].beta, map[0].g),
            svg,
        )
    });
    drawn.filter_map(Result::transpose).collect()
}

fn map_name(name: &str, method: &str, beta: f64, g: f64) -> String {
    let gravity = if g == 0.0 {
        String::new()
    } else {
        format!("-g{g}")
    };
    format!("{name}-{method}-beta{beta}{gravity}.svg")
}
