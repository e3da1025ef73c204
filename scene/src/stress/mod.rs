//! Stresslets and rates of work of a pair by each cause at one gap.
//!
//! A cause is a unit motion of one sphere, or a unit of one slip mode on it, while the other sphere is at rest. Causes of different azimuthal
//! order about the line of centres do not interact, so that they come in blocks. With `d_j` from the active sphere `j` to the other one and
//! axes `e1`, `e2` across it, common to both, causes have complex amplitudes ([`amplitudes`]):
//!
//! ```text
//! twist      omega_j . d_j,   C_n P_n(c_j)
//! order 0    U_j . d_j,       B_n P_n(c_j)
//! order 1    U_j,             (omega_j x d_j),      B_n W_n(c_j) p_j,       C_n W_n(c_j) d_j x p_j       v = v.e1 + i v.e2
//! order m    B_n 2 (n-m)!/(n+m)! P_n^(m)(c_j) p_j^m,    the same with C_n (+i for sphere 1, -i for sphere 2)
//! ```
//!
//! so that `B_n 2/(n(n+1)) P_n(p.n)` is `B_n 2/(n(n+1)) Σ_m Re[A_m conj(s^m)] P_n^(m)(x)/B_n`, `s` the part of the normal across `d`.
//!
//! The stresslet of a sphere is, after Batchelor, *J. Fluid Mech.* 41 (1970) 545, with the fluid's traction `f` on it,
//!
//! ```text
//! S = ∫ [ (f x + x f)/2 - (f.x) I/3 - mu (u n + n u) ] dS,
//! ```
//!
//! symmetric, without trace; the bulk stress of a suspension has `n <S>` of it. A lone squirmer has `S = 4 pi mu a^2 B_2 (p p - I/3)`: positive
//! along `p` for a puller, which pulls fluid in along its axis, negative for a pusher (Ishikawa, Simmonds & Pedley, *J. Fluid Mech.* 568 (2006)
//! 119). By each cause, in the axes of the active sphere,
//!
//! ```text
//! order 0: S = s A (d d - I/3),   order 1: S = s (d v + v d),   order 2: S = s [Re A (e1 e1 - e2 e2) + Im A (e1 e2 + e2 e1)].
//! ```
//!
//! The rate of work of both surfaces on the fluid, which is what the fluid dissipates, is
//! `P = -Σ_spheres ∫ u.f dS = Σ_blocks Re Σ_ij conj(A_i) W_ij A_j`, and `W` is symmetric by the reciprocal theorem.

mod lone;
pub mod named;
mod table;

pub use lone::{drag_power, lone_power, lone_stresslet};
pub use table::StressTable;

use nalgebra::{Complex, DMatrix, DVector, Matrix3, Vector3};

use crate::{Gap, MovingPair};

/// A kind of cause.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// Velocity.
    Translation,
    /// Angular velocity.
    Rotation,
    /// A squirming mode, counted from 1.
    Squirming(usize),
    /// A swirl mode, counted from 1.
    Swirl(usize),
}

/// Causes that interact: those of one azimuthal order about the line of centres.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Block {
    /// Order 0, about the line of centres.
    Twist,
    /// An order, without what turns about the line of centres.
    Order(usize),
}

impl Block {
    /// All blocks that squirmers with so many squirming and swirl modes have.
    pub fn all(modes: usize, swirl: usize) -> impl Iterator<Item = Self> {
        let orders = (0..=modes.max(swirl).max(1)).map(Self::Order);
        std::iter::once(Self::Twist).chain(orders)
    }

    /// The causes of one sphere.
    #[must_use]
    pub fn causes(self, modes: usize, swirl: usize) -> Vec<Cause> {
        let squirming = |from: usize| (from.max(1)..=modes).map(Cause::Squirming);
        let swirls = |from: usize| (from.max(1)..=swirl).map(Cause::Swirl);
        match self {
            Self::Twist => [Cause::Rotation].into_iter().chain(swirls(1)).collect(),
            Self::Order(0) => [Cause::Translation]
                .into_iter()
                .chain(squirming(1))
                .collect(),
            Self::Order(1) => [Cause::Translation, Cause::Rotation]
                .into_iter()
                .chain(squirming(1))
                .chain(swirls(1))
                .collect(),
            Self::Order(m) => squirming(m).chain(swirls(m)).collect(),
        }
    }
}

/// Stresslets and rates of work by the causes of one block.
#[derive(Clone, Debug, PartialEq)]
pub struct BlockStresses {
    /// Which block.
    pub block: Block,
    /// The causes of either sphere, those of sphere 1 before those of sphere 2 in rows and columns.
    pub causes: Vec<Cause>,
    /// `W`: rate of work on the fluid of the velocities of the row's cause against the tractions by the column's.
    pub work: DMatrix<f64>,
    /// Stresslet of each sphere by each cause; empty beyond order 2 and for the twist, which have none.
    pub stresslets: [DVector<f64>; 2],
}

/// Stresslets and rates of work by all causes at one gap, in units of viscosity 1 and lengths in radii of sphere 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Stresses {
    /// The gap.
    pub gap: Gap,
    /// Squirming modes, 1 to this.
    pub modes: usize,
    /// Swirl modes, 1 to this.
    pub swirl: usize,
    /// By block, in the order of [`Block::all`].
    pub blocks: Vec<BlockStresses>,
}

/// Stresslets and power of a moving pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairStress {
    /// Stresslet of each squirmer, in the laboratory's axes.
    pub stresslets: [Matrix3<f64>; 2],
    /// Rate of work of each squirmer's slip on the fluid.
    pub slip_power: [f64; 2],
    /// What the fluid dissipates: the rate of work of both surfaces.
    pub dissipation: f64,
}

impl Stresses {
    /// All numbers in a fixed order.
    pub fn columns(&self) -> impl Iterator<Item = f64> + '_ {
        let of = |block: &'_ BlockStresses| {
            let stresslets = block.stresslets.iter().flat_map(|of| of.iter().copied());
            (block.work.iter().copied().chain(stresslets)).collect::<Vec<_>>()
        };
        self.blocks.iter().flat_map(of)
    }

    /// The same with other numbers, in the order of [`Self::columns`], at another gap.
    #[must_use]
    pub fn with_columns(&self, gap: Gap, columns: &[f64]) -> Self {
        let mut stresses = Self {
            gap,
            ..self.clone()
        };
        let mut columns = columns.iter().copied();
        for block in &mut stresses.blocks {
            let stresslets = block.stresslets.iter_mut().flat_map(|of| of.iter_mut());
            for (slot, value) in block.work.iter_mut().chain(stresslets).zip(&mut columns) {
                *slot = value;
            }
        }
        stresses
    }

    /// Those of a pair that moves at this gap. Modes that are not held here are left out.
    #[must_use]
    pub fn of(&self, pair: &MovingPair) -> PairStress {
        let axes = Axes::of(pair);
        let mut stress = PairStress {
            stresslets: [Matrix3::zeros(); 2],
            slip_power: [0.0; 2],
            dissipation: 0.0,
        };
        for of in &self.blocks {
            let amplitudes = amplitudes(pair, &axes, of.block, &of.causes);
            for (row, amplitude) in amplitudes.iter().enumerate() {
                let traction: Complex<f64> = (amplitudes.iter().enumerate())
                    .map(|(column, by)| by * of.work[(row, column)])
                    .sum();
                let power = (amplitude.conj() * traction).re;
                stress.dissipation += power;
                let (sphere, cause) = (row / of.causes.len(), row % of.causes.len());
                if matches!(of.causes[cause], Cause::Squirming(_) | Cause::Swirl(_)) {
                    stress.slip_power[sphere] += power;
                }
            }
            let Block::Order(order) = of.block else {
                continue;
            };
            for (on, by_cause) in of.stresslets.iter().enumerate() {
                for (index, (s, amplitude)) in by_cause.iter().zip(&amplitudes).enumerate() {
                    let active = index / of.causes.len();
                    stress.stresslets[on] += axes.stresslet(active, order, amplitude * *s);
                }
            }
        }
        stress
    }
}

/// Axes of a pair: across the line of centres, common to both, and along it.
#[derive(Clone, Copy, Debug)]
pub struct Axes {
    /// Across the line of centres.
    pub e1: Vector3<f64>,
    /// `d x e1`, with `d` from the first centre to the second.
    pub e2: Vector3<f64>,
    /// From the first centre to the second.
    pub d: Vector3<f64>,
}

impl Axes {
    /// Of a pair; `e1` is any direction across.
    #[must_use]
    pub fn of(pair: &MovingPair) -> Self {
        let d = pair.configuration.line;
        // Across the axis that is furthest from d.
        let aside = Vector3::ith(d.iamin(), 1.0);
        let e1 = (aside - d * d.dot(&aside)).normalize();
        Self {
            e1,
            e2: d.cross(&e1),
            d,
        }
    }

    /// `v.e1 + i v.e2`.
    #[must_use]
    pub fn across(&self, v: &Vector3<f64>) -> Complex<f64> {
        Complex::new(v.dot(&self.e1), v.dot(&self.e2))
    }

    /// From the sphere to the other one.
    #[must_use]
    pub fn towards_other(&self, sphere: usize) -> Vector3<f64> {
        if sphere == 0 { self.d } else { -self.d }
    }

    /// The stresslet by an amplitude of the active sphere in an order from 0 to 2; none beyond.
    fn stresslet(&self, active: usize, order: usize, amplitude: Complex<f64>) -> Matrix3<f64> {
        let Complex { re, im } = amplitude;
        let d = self.towards_other(active);
        let both = |a: Vector3<f64>, b: Vector3<f64>| a * b.transpose() + b * a.transpose();
        match order {
            0 => (d * d.transpose() - Matrix3::identity() / 3.0) * re,
            1 => both(d, self.e1 * re + self.e2 * im),
            2 => {
                let stretch = self.e1 * self.e1.transpose() - self.e2 * self.e2.transpose();
                stretch * re + both(self.e1, self.e2) * im
            }
            _ => Matrix3::zeros(),
        }
    }
}

/// Amplitudes of the causes of a block, those of squirmer 1 first.
#[must_use]
pub fn amplitudes(
    pair: &MovingPair,
    axes: &Axes,
    block: Block,
    causes: &[Cause],
) -> Vec<Complex<f64>> {
    let of = |sphere: usize| {
        causes.iter().map(move |cause| {
            let d = axes.towards_other(sphere);
            let velocity = pair.velocities[sphere];
            let spin = pair.angular_velocities[sphere];
            let of = &pair.squirmers[sphere];
            let side = if sphere == 0 { 1.0 } else { -1.0 };
            match (block, *cause) {
                (Block::Twist, Cause::Rotation) => spin.dot(&d).into(),
                (Block::Order(0), Cause::Translation) => velocity.dot(&d).into(),
                (_, Cause::Translation) => axes.across(&velocity),
                (_, Cause::Rotation) => axes.across(&spin.cross(&d)),
                (_, Cause::Squirming(n)) => angular(pair, axes, sphere, block, n) * of.mode(n - 1),
                (Block::Twist, Cause::Swirl(n)) => {
                    angular(pair, axes, sphere, block, n) * strength(of.swirl(), n)
                }
                (_, Cause::Swirl(n)) => {
                    let turned = Complex::new(0.0, side * strength(of.swirl(), n));
                    angular(pair, axes, sphere, block, n) * turned
                }
            }
        })
    };
    of(0).chain(of(1)).collect()
}

fn strength(modes: &[f64], n: usize) -> f64 {
    modes.get(n - 1).copied().unwrap_or(0.0)
}

/// `P_n(c)` of order 0, `2 (n-m)!/(n+m)! P_n^(m)(c) p^m` of the others.
fn angular(pair: &MovingPair, axes: &Axes, sphere: usize, block: Block, n: usize) -> Complex<f64> {
    let p = pair.configuration.orientations[sphere];
    let c = p.dot(&axes.towards_other(sphere));
    let order = match block {
        Block::Twist => 0,
        Block::Order(order) => order,
    };
    let derivative = legendre_derivative(n, order, c);
    if order == 0 {
        return derivative.into();
    }
    let among: f64 = (n - order + 1..=n + order).map(|k| k as f64).product();
    axes.across(&p).powu(order as u32) * (2.0 / among * derivative)
}

/// The derivative of `P_n` of the given order, which is at most `n`, at `c`.
#[must_use]
pub fn legendre_derivative(n: usize, order: usize, c: f64) -> f64 {
    let m = order as f64;
    let (mut below, mut value) = (
        0.0,
        (1..=order).map(|j| (2 * j - 1) as f64).product::<f64>(),
    );
    for k in order..n {
        let k = k as f64;
        let next = ((2.0 * k + 1.0) * c * value - (k + m) * below) / (k - m + 1.0);
        (below, value) = (value, next);
    }
    value
}

#[cfg(test)]
mod tests;
