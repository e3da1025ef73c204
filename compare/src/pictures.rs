//! The pictures that a command writes, by their file names.

use crate::figures::{self, FigureError};
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
