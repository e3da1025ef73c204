//! Parities of a vector field under the mirrors x, y and the swap of the spheres.
//!
//! A field of parity s under a mirror R satisfies `f(R y) = s R f(y)`. A translation along x has
//! parity -1 under `x -> -x`, and so has a rotation about y or z.

use nalgebra::Vector3;
use scene::LoadSet;

use crate::mesh::Image;

/// What sphere 1 does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// Translation along the line of centres, z, and slip of even azimuthal order that goes as `cos mφ`.
    Axial,
    /// Translation along x and rotation about y, and slip of odd order that goes as `cos mφ`.
    Transverse,
    /// Rotation about the line of centres, and slip of even order that goes as `sin mφ`.
    Twist,
    /// [`Motion::Transverse`] a quarter turn on: translation along y, rotation about x, slip of odd order that goes as `sin mφ`.
    Sideways,
}

impl Motion {
    /// All kinds whose loads are solved for; those of [`Motion::Sideways`] are the same as of [`Motion::Transverse`].
    pub const ALL: [Self; 3] = [Self::Axial, Self::Transverse, Self::Twist];

    /// All kinds: any velocity of a surface is a sum of one of each.
    pub const COMPLETE: [Self; 4] = [Self::Axial, Self::Transverse, Self::Twist, Self::Sideways];

    /// Whether a set of loads calls for it, of whatever sphere.
    pub(crate) fn is_in(self, set: LoadSet) -> bool {
        let slip = set.swirl > 0;
        match self {
            Self::Axial => set.axial.any(),
            Self::Transverse => set.transverse.any() || slip,
            Self::Twist => set.twist || slip,
            Self::Sideways => false,
        }
    }

    /// Signs under the mirrors x and y.
    fn mirrors(self) -> [f64; 2] {
        match self {
            Self::Axial => [1.0, 1.0],
            Self::Transverse => [-1.0, 1.0],
            Self::Twist => [-1.0, -1.0],
            Self::Sideways => [1.0, -1.0],
        }
    }

    /// The part of a field that has this symmetry, at a point: the mean over the mirrors x, y and both, with their signs.
    pub(crate) fn part(
        self,
        field: impl Fn(&Vector3<f64>) -> Vector3<f64>,
        point: &Vector3<f64>,
    ) -> Vector3<f64> {
        let [x, y] = self.mirrors();
        let images = [
            (1.0, [1.0, 1.0]),
            (x, [-1.0, 1.0]),
            (y, [1.0, -1.0]),
            (x * y, [-1.0, -1.0]),
        ];
        let image = |(sign, [along_x, along_y]): (f64, [f64; 2])| {
            let mirror = Vector3::new(along_x, along_y, 1.0);
            field(&point.component_mul(&mirror)).component_mul(&mirror) * sign
        };
        images.into_iter().map(image).sum::<Vector3<f64>>() * 0.25
    }

    /// Signs of the three components of the field at an image, relative to the representative.
    pub(crate) fn signs(self, image: &Image) -> [f64; 3] {
        let [x, y] = self.mirrors();
        let mut signs = [1.0; 3];
        for (mirrored, axis, parity) in [(image.mirror_x, 0, x), (image.mirror_y, 1, y)] {
            if mirrored {
                signs = signs.map(|s| s * parity);
                signs[axis] = -signs[axis];
            }
        }
        signs
    }

    /// Which components may differ from zero at a point on the planes `x = 0` or `y = 0`.
    pub(crate) fn allowed(self, on_x: bool, on_y: bool) -> [bool; 3] {
        let [x, y] = self.mirrors();
        let mut allowed = [true; 3];
        for (on_plane, axis, parity) in [(on_x, 0, x), (on_y, 1, y)] {
            if on_plane {
                for (component, keep) in allowed.iter_mut().enumerate() {
                    // An even field has no normal component there, an odd one only that.
                    *keep &= (component == axis) == (parity < 0.0);
                }
            }
        }
        allowed
    }
}

/// What sphere 2 does: the mirror image of what sphere 1 does, or its opposite.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Swap {
    /// The mirror image.
    Mirrored,
    /// Minus the mirror image.
    Opposite,
}

/// A symmetry class of the pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Parity {
    /// What sphere 1 does.
    pub motion: Motion,
    /// What sphere 2 does.
    pub swap: Swap,
}

impl Parity {
    /// The six classes that carry load.
    pub const ALL: [Self; 6] = {
        use Motion::{Axial, Transverse, Twist};
        use Swap::{Mirrored, Opposite};
        [
            Self::of(Axial, Mirrored),
            Self::of(Axial, Opposite),
            Self::of(Transverse, Mirrored),
            Self::of(Transverse, Opposite),
            Self::of(Twist, Mirrored),
            Self::of(Twist, Opposite),
        ]
    };

    pub(crate) const fn of(motion: Motion, swap: Swap) -> Self {
        Self { motion, swap }
    }

    /// Whether a set of loads calls for it.
    pub(crate) fn is_in(self, set: LoadSet) -> bool {
        use Swap::{Mirrored, Opposite};
        let slip = set.swirl > 0;
        match (
            self.motion,
            self.swap,
            [set.axial.sum, set.axial.difference],
            [set.transverse.sum, set.transverse.difference],
        ) {
            // The mirror image of a motion along the line of centres is opposed.
            (Motion::Axial, Mirrored, [_, read], _) | (Motion::Axial, Opposite, [read, _], _) => {
                read
            }
            (Motion::Transverse, Mirrored, _, [read, _])
            | (Motion::Transverse, Opposite, _, [_, read]) => read || slip,
            (Motion::Twist, ..) => set.twist || slip,
            (Motion::Sideways, ..) => false,
        }
    }

    /// Signs of the three components on sphere 2, relative to the mirrored point of sphere 1.
    pub(crate) fn swap_signs(self) -> [f64; 3] {
        match self.swap {
            Swap::Mirrored => [1.0, 1.0, -1.0],
            Swap::Opposite => [-1.0, -1.0, 1.0],
        }
    }
}
