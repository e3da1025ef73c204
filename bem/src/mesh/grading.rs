//! How large panels may be at an angle θ from the contact point.
//!
//! ```text
//! 1/h(θ) = (1/h_far + 1/(slope (θ + core sqrt(eps))) + 1/(width (eps + θ²))) / scale
//! ```
//!
//! Near contact the loads live in a cap of angle `sqrt(eps)`, where the gap's width is
//! `eps + θ²`; beyond it the pressure falls algebraically, so panels may grow in proportion to θ.
//! The last term ties panels to the gap's width. The velocity across the gap is what is left after the
//! two spheres' shares cancel, and kinks of the density at the edges of panels spoil it once panels
//! are several times as wide as the gap. A cap that only shrinks as `sqrt(eps)` has that happen at small gaps.
//! `H(θ) = ∫ dθ/h` counts panels along a meridian.

/// A size law for the edges of a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grading {
    /// Common factor of all lengths, which falls with the level.
    pub scale: f64,
    /// Edge length far from contact, for `scale` 1.
    pub far: f64,
    /// Edge length per angle near contact, for `scale` 1.
    pub slope: f64,
    /// Angle over which panels hardly grow, relative to that of the cap, `sqrt(eps)`.
    pub core: f64,
    /// Edge length per width of the gap, for `scale` 1; infinity leaves the width out.
    pub width: f64,
    /// The gap, in radii; infinity for a uniform mesh.
    pub gap: f64,
}

impl Grading {
    fn cap(&self) -> f64 {
        self.core * self.gap.sqrt()
    }

    /// Edge length at the angle `theta` from the contact point, in radians.
    #[must_use]
    pub fn size(&self, theta: f64) -> f64 {
        let cap = 1.0 / (self.slope * (theta + self.cap()));
        let width = 1.0 / (self.width * (self.gap + theta * theta));
        self.scale / (1.0 / self.far + cap + width)
    }

    /// `H(θ) = ∫₀^θ dθ/h`, the number of panels between the contact point and the angle `theta`, in radians.
    #[must_use]
    pub fn panels(&self, theta: f64) -> f64 {
        let near = if self.gap.is_finite() {
            let root = self.gap.sqrt();
            (theta / self.cap()).ln_1p() / self.slope + (theta / root).atan() / (self.width * root)
        } else {
            0.0
        };
        (theta / self.far + near) / self.scale
    }

    /// The angle from the contact point, in radians, up to which the share `share` of all panels of a meridian lies.
    ///
    /// Newton's method from the contact point: `H` is concave and rising, so steps never overshoot.
    #[must_use]
    pub fn angle_of_share_rad(&self, share: f64) -> f64 {
        let target = share * self.panels(std::f64::consts::PI);
        let mut theta = 0.0;
        for _ in 0..100 {
            let step = (target - self.panels(theta)) * self.size(theta);
            theta += step;
            if step.abs() <= 1e-15 * theta {
                break;
            }
        }
        theta
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angle_of_share_inverts_the_count_of_panels() {
        let widths = [f64::INFINITY, 8.0];
        for (gap, width) in [1e-4, 0.1, f64::INFINITY]
            .into_iter()
            .flat_map(|gap| widths.map(|width| (gap, width)))
        {
            let law = Grading {
                scale: 0.7,
                far: 0.3,
                slope: 0.25,
                core: 0.5,
                width,
                gap,
            };
            for theta in [1e-3, 0.1, 1.0, 3.0] {
                let share = law.panels(theta) / law.panels(std::f64::consts::PI);
                approx::assert_relative_eq!(law.angle_of_share_rad(share), theta, epsilon = 1e-12);
            }
        }
    }
}
