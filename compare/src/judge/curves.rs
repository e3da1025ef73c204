//! Errors against the gap, in a few groups: what a picture shows.

use super::Scorecard;
use super::points::{Item, Point};

/// What errors are put together for a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Group {
    /// `X11A, X12A`.
    Squeezing,
    /// The other resistance scalars.
    Shearing,
    /// Loads by slip.
    Slip,
    /// Mobilities, and velocities by slip.
    Velocities,
    /// Approach speeds.
    Approach,
}

impl Group {
    /// All groups.
    pub const ALL: [Self; 5] = [
        Self::Squeezing,
        Self::Shearing,
        Self::Slip,
        Self::Velocities,
        Self::Approach,
    ];

    /// In words.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Self::Squeezing => "Squeezing: X11A, X12A",
            Self::Shearing => "Shearing and turning: Y..A, Y..B, X..C, Y..C",
            Self::Slip => "Loads by slip",
            Self::Velocities => "Mobilities and velocities by slip",
            Self::Approach => "Approach speeds (relative)",
        }
    }

    fn of(item: Item) -> Self {
        match item {
            Item::Approach(_) => Self::Approach,
            Item::Quantity(quantity) if !quantity.is_load() => Self::Velocities,
            Item::Quantity(quantity) if quantity.mode().is_some() => Self::Slip,
            Item::Quantity(quantity)
                if quantity.name().starts_with('X') && quantity.name().ends_with('A') =>
            {
                Self::Squeezing
            }
            Item::Quantity(_) => Self::Shearing,
        }
    }
}

/// The largest error of a group at a gap.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorAt {
    /// Name of the model.
    pub model: String,
    /// The group.
    pub group: Group,
    /// Gap, in radii.
    pub gap: f64,
    /// The error, as [`Point::error`] has it, without sign.
    pub error: f64,
    /// Whether the gap lies between those of the submission.
    pub between: bool,
}

impl Scorecard {
    /// The largest errors of each group by rising gap.
    #[must_use]
    pub fn curves(&self) -> Vec<ErrorAt> {
        let mut curves: Vec<ErrorAt> = Vec::new();
        let mut take = |points: &[Point], between: bool| {
            for point in points {
                let (group, error) = (Group::of(point.item), point.error().abs());
                let same =
                    |at: &&mut ErrorAt| at.group == group && at.gap.total_cmp(&point.gap).is_eq();
                match curves.iter_mut().find(same) {
                    Some(at) => at.error = at.error.max(error),
                    None => curves.push(ErrorAt {
                        model: self.name.clone(),
                        group,
                        gap: point.gap,
                        error,
                        between,
                    }),
                }
            }
        };
        take(&self.points, false);
        take(&self.between, true);
        curves.sort_by(|a, b| a.group.cmp(&b.group).then(a.gap.total_cmp(&b.gap)));
        curves
    }
}

#[cfg(test)]
mod tests;
