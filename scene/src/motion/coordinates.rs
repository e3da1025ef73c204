//! The kinds of coordinates, a file for each.

mod axisymmetric;
mod mirror_symmetric;
mod planar;
mod point_symmetric;
mod spatial;

pub(super) use self::axisymmetric::Axisymmetric;
pub(super) use self::mirror_symmetric::MirrorSymmetric;
pub(crate) use self::planar::Planar;
pub(super) use self::point_symmetric::PointSymmetric;
pub(crate) use self::spatial::Spatial;
pub(super) use self::spatial::{along_line, spin_about};
