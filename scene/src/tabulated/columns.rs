//! What is tabulated together: groups of columns, each with pieces of its own.
//!
//! A group is the same whatever else a table holds, and whichever scene called for it first, so that no look-up depends on what
//! was built before. The groups of the five blocks of the balance hold the modes 1 and 2, which nearly all scenes have; each
//! higher mode and each swirl mode is a group of its own.

use crate::mobility::{Block, COEFFICIENTS, Coefficient, FarScale, MobilitySet, Of};
use crate::{Gap, Hydrodynamics, LoadSet, SceneError};

/// Squirming modes in the groups of the blocks.
pub(super) const BASE_MODES: usize = 2;

/// Columns that are tabulated together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Group {
    /// A block of the balance, with the modes 1 and 2.
    Block(Block),
    /// A higher squirming mode, counted from 1.
    Mode(usize),
    /// A swirl mode, counted from 1.
    Swirl(usize),
}

/// A column: a kind of coefficient, and the mode, counted from 0, where it has one.
type Column = (&'static Coefficient, usize);

impl Group {
    /// The groups that a set of loads calls for.
    pub fn of(set: LoadSet) -> Vec<Self> {
        let blocks = Block::ALL.into_iter().filter(|block| block.is_in(set));
        let modes = BASE_MODES + 1..=set.modes;
        (blocks.map(Self::Block))
            .chain(modes.map(Self::Mode))
            .chain((1..=set.swirl).map(Self::Swirl))
            .collect()
    }

    /// The loads that its coefficients follow from.
    fn loads(self) -> LoadSet {
        match self {
            Self::Block(block) => block.loads(BASE_MODES),
            Self::Mode(n) => LoadSet::planar(n),
            Self::Swirl(n) => LoadSet {
                axial: crate::Parities::NONE,
                ..LoadSet::all(0).with_swirl(n)
            },
        }
    }

    /// Its columns, in the order in which a look-up reads them: mode by mode, then those by torque or repulsion.
    pub fn columns(self) -> Vec<Column> {
        let of_modes =
            |kind: fn(&Of) -> bool, modes: std::ops::Range<usize>, block: Option<Block>| {
                modes.flat_map(move |n| {
                    (COEFFICIENTS.iter())
                        .filter(move |c| kind(&c.of) && block.is_none_or(|block| c.block == block))
                        .map(move |c| (c, n))
                })
            };
        let slip = |of: &Of| matches!(of, Of::Mode(_));
        let swirl = |of: &Of| matches!(of, Of::Swirl(_));
        let pair = |of: &Of| matches!(of, Of::Pair(_) | Of::Torque(_));
        match self {
            Self::Block(block) => of_modes(slip, 0..BASE_MODES, Some(block))
                .chain(of_modes(pair, 0..1, Some(block)))
                .collect(),
            Self::Mode(n) => of_modes(slip, n - 1..n, None).collect(),
            Self::Swirl(n) => of_modes(swirl, n - 1..n, None).collect(),
        }
    }

    /// The groups for which a model is asked at once, because their loads are those of the same modes. What else is asked for
    /// changes no load.
    pub fn batches(groups: &[Self]) -> Vec<Vec<Self>> {
        let (blocks, others): (Vec<_>, Vec<_>) =
            (groups.iter()).partition(|group| matches!(group, Self::Block(_)));
        let alone = others.into_iter().map(|group| vec![group]);
        (std::iter::once(blocks).chain(alone))
            .filter(|batch| !batch.is_empty())
            .collect()
    }

    /// The values of the columns of each group of a batch, of a model at `gap`; with `far` times what keeps them bounded as the two
    /// part.
    pub fn values(
        batch: &[Self],
        model: &dyn Hydrodynamics,
        gap: Gap,
        far: bool,
    ) -> Result<Vec<Vec<f64>>, SceneError> {
        let loads = batch.iter().map(|group| group.loads());
        let set = MobilitySet {
            loads: loads.reduce(LoadSet::union).unwrap_or(LoadSet::axial(0)),
            torque: true,
        };
        let mobility = model.interacting_mobilities(gap, set)?;
        let value = |(coefficient, n): Column| {
            let scale = if far { coefficient.far } else { FarScale::One };
            coefficient.value(n, &mobility) * scale.at(gap)
        };
        let of_group = |group: &Self| group.columns().into_iter().map(value).collect();
        Ok(batch.iter().map(of_group).collect())
    }
}
