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
    /// Of unlike radii, for the causes of each squirmer: all along `d`, all across it, and all about it, with the modes 1 and 2.
    AxialOfEach,
    AcrossOfEach,
    AboutOfEach,
    /// A higher squirming mode of each.
    ModeOfEach(usize),
    /// A swirl mode of each.
    SwirlOfEach(usize),
}

/// A column: a kind of coefficient, and the mode, counted from 0, where it has one.
type Column = (&'static Coefficient, usize);

/// A column of unlike radii.
enum ColumnOfEach {
    /// By a cause of one of the squirmers.
    By(usize, Column),
    /// Mean axial velocity by repulsion, which equal spheres do not have.
    MeanAxialByRepulsion,
}

impl Group {
    /// The groups that a set of loads calls for, of `unlike` radii or equal ones.
    pub fn of(set: LoadSet, unlike: bool) -> Vec<Self> {
        if unlike {
            let blocks = [
                (set.axial.any(), Self::AxialOfEach),
                (set.transverse.any(), Self::AcrossOfEach),
                (set.twist, Self::AboutOfEach),
            ];
            let modes = BASE_MODES + 1..=set.modes;
            return (blocks.into_iter().filter(|(held, _)| *held))
                .map(|(_, group)| group)
                .chain(modes.map(Self::ModeOfEach))
                .chain((1..=set.swirl).map(Self::SwirlOfEach))
                .collect();
        }
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
            Self::AxialOfEach => LoadSet::axial(BASE_MODES),
            Self::AcrossOfEach => LoadSet {
                axial: crate::Parities::NONE,
                ..LoadSet::planar(BASE_MODES)
            },
            Self::AboutOfEach => Block::Twist.loads(BASE_MODES),
            Self::Mode(n) | Self::ModeOfEach(n) => LoadSet::planar(n),
            Self::Swirl(n) | Self::SwirlOfEach(n) => LoadSet {
                axial: crate::Parities::NONE,
                ..LoadSet::all(0).with_swirl(n)
            },
        }
    }

    /// Its columns, in the order in which a look-up reads them: mode by mode, then those by torque or repulsion; of unlike radii for the
    /// causes of one squirmer alone.
    fn columns(self) -> Vec<Column> {
        let of_modes = |kind: fn(&Of) -> bool, modes: std::ops::Range<usize>, blocks: &[Block]| {
            let of_mode = |n: usize| {
                (COEFFICIENTS.iter())
                    .filter(|c| kind(&c.of) && blocks.contains(&c.block))
                    .map(move |c| (c, n))
                    .collect::<Vec<_>>()
            };
            modes.flat_map(of_mode).collect::<Vec<_>>()
        };
        let of_blocks = |blocks: &[Block]| {
            let mut columns = of_modes(slip, 0..BASE_MODES, blocks);
            columns.extend(of_modes(pair, 0..1, blocks));
            columns
        };
        match self {
            Self::Block(block) => of_blocks(&[block]),
            Self::Mode(n) | Self::ModeOfEach(n) => of_modes(slip, n - 1..n, &Block::ALL),
            Self::Swirl(n) | Self::SwirlOfEach(n) => of_modes(swirl, n - 1..n, &Block::ALL),
            Self::AxialOfEach => of_modes(slip, 0..BASE_MODES, &[Block::Opening, Block::MeanAxial]),
            Self::AcrossOfEach => {
                let across = [Block::Turning, Block::MeanTransverse];
                of_modes(slip, 0..BASE_MODES, &across)
            }
            Self::AboutOfEach => of_modes(pair, 0..1, &[Block::Twist]),
        }
    }

    /// The columns of a group of unlike radii: by the causes of squirmer 1, by those of squirmer 2, then those by torque or repulsion.
    fn columns_of_each(self) -> Vec<ColumnOfEach> {
        let of_both = |columns: &[Column]| {
            [0, 1].map(|k| {
                columns
                    .iter()
                    .map(move |&column| ColumnOfEach::By(k, column))
                    .collect()
            })
        };
        let mut columns: Vec<ColumnOfEach> = of_both(&self.columns())
            .into_iter()
            .flat_map(|by: Vec<_>| by)
            .collect();
        let of_pair = |blocks: &[Block]| -> Vec<Column> {
            (COEFFICIENTS.iter())
                .filter(|c| pair(&c.of) && blocks.contains(&c.block))
                .map(|c| (c, 0))
                .collect()
        };
        match self {
            Self::AxialOfEach => {
                let repulsion = of_pair(&[Block::Opening]);
                columns.extend(
                    repulsion
                        .into_iter()
                        .map(|column| ColumnOfEach::By(0, column)),
                );
                columns.push(ColumnOfEach::MeanAxialByRepulsion);
            }
            Self::AcrossOfEach => {
                let torque = of_pair(&[Block::Turning, Block::MeanTransverse]);
                columns.extend(of_both(&torque).into_iter().flat_map(|by: Vec<_>| by));
            }
            _ => {}
        }
        columns
    }

    /// The groups for which a model is asked at once, because their loads are those of the same modes. What else is asked for
    /// changes no load.
    pub fn batches(groups: &[Self]) -> Vec<Vec<Self>> {
        let (blocks, others): (Vec<_>, Vec<_>) = (groups.iter()).partition(|group| group.is_base());
        let alone = others.into_iter().map(|group| vec![group]);
        (std::iter::once(blocks).chain(alone))
            .filter(|batch| !batch.is_empty())
            .collect()
    }

    /// Whether it holds the modes that nearly all scenes have.
    fn is_base(&self) -> bool {
        matches!(
            self,
            Self::Block(_) | Self::AxialOfEach | Self::AcrossOfEach | Self::AboutOfEach
        )
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
        if model.has_unlike_radii() {
            return Self::values_of_each(batch, model, (gap, far), set);
        }
        let mobility = model.interacting_mobilities(gap, set)?;
        let value = |(coefficient, n): Column| {
            let scale = if far { coefficient.far } else { FarScale::One };
            coefficient.value(n, &mobility) * scale.at(gap, gap.distance())
        };
        let of_group = |group: &Self| group.columns().into_iter().map(value).collect();
        Ok(batch.iter().map(of_group).collect())
    }

    /// The same of unlike radii.
    fn values_of_each(
        batch: &[Self],
        model: &dyn Hydrodynamics,
        (gap, far): (Gap, bool),
        set: MobilitySet,
    ) -> Result<Vec<Vec<f64>>, SceneError> {
        let mobility = model.interacting_mobility_of_each(gap, set)?;
        let distance = gap.distance_at_ratio(model.description().ratio);
        let value = |column: ColumnOfEach| match column {
            ColumnOfEach::By(k, (coefficient, n)) => {
                let scale = if far { coefficient.far } else { FarScale::One };
                coefficient.value(n, &mobility.by[k]) * scale.at(gap, distance)
            }
            ColumnOfEach::MeanAxialByRepulsion => mobility.mean_axial_by_repulsion,
        };
        let of_group = |group: &Self| group.columns_of_each().into_iter().map(value).collect();
        Ok(batch.iter().map(of_group).collect())
    }
}

fn slip(of: &Of) -> bool {
    matches!(of, Of::Mode(_))
}

fn swirl(of: &Of) -> bool {
    matches!(of, Of::Swirl(_))
}

fn pair(of: &Of) -> bool {
    matches!(of, Of::Pair(_) | Of::Torque(_))
}
