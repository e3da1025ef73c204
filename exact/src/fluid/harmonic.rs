//! Harmonic functions about two spheres, summed from bispherical series.
//!
//! ```text
//! f = s^(1/2) Σ_m sin^m(eta) Σ_n [up_n e^(nu (xi' - h)) + down_n e^(-nu (xi' + h))] P_n^(m)(mu) {cos, sin}(m phi),
//! ```
//!
//! `nu = n + 1/2`, `xi' = xi - (alpha_1 - alpha_2)/2`, `h = (alpha_1 + alpha_2)/2`: the spheres are `xi' = +-h`, and nothing overflows
//! between them. Lengths are in units of the focal length. Derivatives along the three axes are series of the same kind, since each
//! operator couples neighbouring degrees ([`crate::stencil`]):
//!
//! ```text
//! d/dx (C cos m phi) = [ (d/drho + m/rho) C cos((m-1) phi) + (d/drho - m/rho) C cos((m+1) phi) ] / 2.
//! ```

use nalgebra::Vector3;

use crate::stencil::{Stencil, axial_derivative, lowering_derivative, raising_derivative};
use crate::unlike::Pair;

/// The two factors of a degree: singular within the upper sphere, and within the lower one.
pub type Factors = [f64; 2];

/// Which of the two functions of the azimuth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// `cos(m phi)`.
    Cos,
    /// `sin(m phi)`.
    Sin,
}

/// A harmonic function: for each azimuthal order, the factors of its cosine and of its sine by degree, or nothing.
#[derive(Clone, Debug, Default)]
pub struct Harmonic(Vec<[Vec<Factors>; 2]>);

impl Harmonic {
    /// Adds `weight` times a series.
    pub fn add(&mut self, order: usize, phase: Phase, weight: f64, series: &[Factors]) {
        // The sine of no angle is nothing, and neither are its derivatives.
        if weight == 0.0 || (order == 0 && phase == Phase::Sin) {
            return;
        }
        if self.0.len() <= order {
            self.0.resize_with(order + 1, Default::default);
        }
        let into = &mut self.0[order][phase as usize];
        if into.len() < series.len() {
            into.resize(series.len(), [0.0; 2]);
        }
        for (into, of) in into.iter_mut().zip(series) {
            into[0] += weight * of[0];
            into[1] += weight * of[1];
        }
    }

    fn parts(&self) -> impl Iterator<Item = (usize, Phase, &[Factors])> {
        let orders = self.0.iter().enumerate();
        orders
            .flat_map(|(order, [cos, sin])| {
                [(order, Phase::Cos, &cos[..]), (order, Phase::Sin, &sin[..])]
            })
            .filter(|(_, _, series)| !series.is_empty())
    }

    /// The derivatives along the three axes, each once more a harmonic function.
    pub fn gradient(&self, pair: &Pair) -> [Self; 3] {
        let alphas = pair.spheres.map(|sphere| sphere.alpha);
        let mut gradient: [Self; 3] = Default::default();
        for (order, phase, series) in self.parts() {
            let along = derived(series, order, order, alphas, -1.0, |n| {
                axial_derivative(n, order)
            });
            gradient[2].add(order, phase, 1.0, &along);
            let raised = derived(series, order, order + 1, alphas, 1.0, |_| {
                raising_derivative()
            });
            // Of order 0 both halves are the same.
            let half = if order == 0 { 1.0 } else { 0.5 };
            let (other, sign) = match phase {
                Phase::Cos => (Phase::Sin, 1.0),
                Phase::Sin => (Phase::Cos, -1.0),
            };
            gradient[0].add(order + 1, phase, half, &raised);
            gradient[1].add(order + 1, other, sign * half, &raised);
            if order > 0 {
                let lowered = derived(series, order, order - 1, alphas, 1.0, |n| {
                    lowering_derivative(n, order - 1)
                });
                gradient[0].add(order - 1, phase, 0.5, &lowered);
                gradient[1].add(order - 1, other, -sign * 0.5, &lowered);
            }
        }
        gradient
    }
}

/// An operator's series, of the order `to`; it has one degree more. The factors `down` take `sign` besides.
fn derived(
    series: &[Factors],
    from: usize,
    to: usize,
    [upper, lower]: [f64; 2],
    sign: f64,
    stencil: impl Fn(usize) -> Stencil,
) -> Vec<Factors> {
    let entry = |n: usize| series.get(n).copied().unwrap_or_default();
    let grow = [upper.exp(), lower.exp()];
    let signs = [1.0, sign];
    (0..=series.len())
        .map(|n| {
            if n < to {
                return [0.0; 2];
            }
            let Stencil { below, at, above } = stencil(n);
            let before = if n > from { entry(n - 1) } else { [0.0; 2] };
            let (now, after) = (if n < from { [0.0; 2] } else { entry(n) }, entry(n + 1));
            [0, 1].map(|k| {
                signs[k] * (below * grow[k] * before[k] + at * now[k] + above / grow[k] * after[k])
            })
        })
        .collect()
}

/// A point between the spheres, as the series see it.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// `xi'`.
    xi: f64,
    /// `h`.
    half_width: f64,
    /// `cos(eta)` and `sin(eta)`.
    mu: f64,
    sine: f64,
    /// `cosh(xi) - mu`.
    denominator: f64,
    /// Cosine and sine of the azimuth.
    azimuth: [f64; 2],
}

impl Place {
    /// The point at a position in units of the focal length, from the middle between the poles. Within a sphere it is moved to its surface.
    pub fn new(pair: &Pair, position: &Vector3<f64>) -> Self {
        let (rho, z) = (position.x.hypot(position.y), position.z);
        let squared = position.norm_squared();
        let product = rho.hypot(z - 1.0) * rho.hypot(z + 1.0);
        let xi = (2.0 * z / (1.0 + squared)).atanh() - pair.shift;
        let half_width = pair.half_width();
        let azimuth = if rho > 0.0 {
            [position.x / rho, position.y / rho]
        } else {
            [1.0, 0.0]
        };
        Self {
            xi: xi.clamp(-half_width, half_width),
            half_width,
            mu: ((squared - 1.0) / product).clamp(-1.0, 1.0),
            sine: 2.0 * rho / product,
            denominator: 2.0 / product,
            azimuth,
        }
    }
}

/// Several harmonic functions, laid out to be summed at one point together.
#[derive(Clone, Debug, Default)]
pub struct Harmonics<const K: usize> {
    orders: Vec<Order>,
}

/// All series of one azimuthal order.
#[derive(Clone, Debug)]
struct Order {
    order: usize,
    /// The function and the phase that each series belongs to.
    columns: Vec<(usize, Phase)>,
    /// By degree from `order` on, then by column.
    factors: Vec<Factors>,
    /// `P_(n+1)^(m) = a mu P_n^(m) - b P_(n-1)^(m)` for each degree: divisions would take half of the time.
    recurrence: Vec<[f64; 2]>,
    /// For every stretch of degrees, how much it and those after it can bring at most where the exponentials are 1.
    bounds: Vec<Factors>,
}

/// Degrees between two looks at what is still to come.
const STRETCH: usize = 16;
/// What is left out of a sum: far below rounding of velocities of order 1.
const NEGLIGIBLE: f64 = 1e-18;

impl<const K: usize> Harmonics<K> {
    /// Of these functions.
    pub fn new(functions: [&Harmonic; K]) -> Self {
        let highest = functions.iter().map(|of| of.0.len()).max().unwrap_or(0);
        let orders = (0..highest).filter_map(|order| {
            let of_order = |(k, function): (usize, &'_ &Harmonic)| {
                let parts = function.parts().filter(move |part| part.0 == order);
                parts
                    .map(move |(_, phase, series)| ((k, phase), series.to_vec()))
                    .collect::<Vec<_>>()
            };
            let all: Vec<_> = functions.iter().enumerate().flat_map(of_order).collect();
            let length = all.iter().map(|(_, series)| series.len()).max()?;
            let factors = (order..length).flat_map(|n| {
                let at = move |series: &Vec<Factors>| series.get(n).copied().unwrap_or_default();
                all.iter()
                    .map(move |(_, series)| at(series))
                    .collect::<Vec<_>>()
            });
            let factors: Vec<Factors> = factors.collect();
            Some(Order {
                order,
                recurrence: (order..length).map(|n| recurrence(order, n)).collect(),
                bounds: bounds(order, all.len(), &factors),
                factors,
                columns: all.iter().map(|(column, _)| *column).collect(),
            })
        });
        Self {
            orders: orders.collect(),
        }
    }

    /// All of them at a point.
    pub fn at(&self, place: &Place) -> [f64; K] {
        let mut values = [0.0; K];
        let mut sums = [0.0; 64];
        for of in &self.orders {
            let sums = &mut sums[..of.columns.len()];
            sums.fill(0.0);
            let front = place.denominator.sqrt() * place.sine.powi(of.order as i32);
            of.sum(place, NEGLIGIBLE / front.max(NEGLIGIBLE), sums);
            let [cos, sin] = multiple(place.azimuth, of.order);
            for (&(k, phase), sum) in of.columns.iter().zip(sums) {
                let angular = match phase {
                    Phase::Cos => cos,
                    Phase::Sin => sin,
                };
                values[k] += front * angular * *sum;
            }
        }
        values
    }
}

impl Order {
    /// The sums over the degrees, each series by itself, to the accuracy `negligible`.
    fn sum(&self, place: &Place, negligible: f64, sums: &mut [f64]) {
        let m = self.order as f64;
        let reach = [place.half_width - place.xi, place.half_width + place.xi];
        let steps = reach.map(|reach| (-reach).exp());
        let mut decays = reach.map(|reach| (-(m + 0.5) * reach).exp());
        let (mut below, mut legendre) = (
            0.0,
            (1..=self.order)
                .map(|j| (2 * j - 1) as f64)
                .product::<f64>(),
        );
        let degrees = self.factors.chunks_exact(sums.len()).zip(&self.recurrence);
        for (index, (factors, [a, b])) in degrees.enumerate() {
            if index.is_multiple_of(STRETCH) {
                let [up, down] = self.bounds[index / STRETCH];
                if up * decays[0] + down * decays[1] < negligible {
                    return;
                }
            }
            let weights = decays.map(|decay| decay * legendre);
            for (sum, [up, down]) in sums.iter_mut().zip(factors) {
                *sum += up * weights[0] + down * weights[1];
            }
            (below, legendre) = (legendre, a * place.mu * legendre - b * below);
            decays = [decays[0] * steps[0], decays[1] * steps[1]];
        }
    }
}

fn recurrence(order: usize, degree: usize) -> [f64; 2] {
    let (m, n) = (order as f64, degree as f64);
    [2.0 * n + 1.0, n + m].map(|factor| factor / (n - m + 1.0))
}

/// Sums of the largest factors of each degree times `P_n^(m)(1)`, from each stretch of degrees on.
fn bounds(order: usize, columns: usize, factors: &[Factors]) -> Vec<Factors> {
    let mut largest = (1..=order).map(|j| (2 * j - 1) as f64).product::<f64>();
    let of_degrees: Vec<Factors> = (factors.chunks_exact(columns).enumerate())
        .map(|(index, factors)| {
            let of = [0, 1].map(|k| factors.iter().map(|f| f[k].abs()).fold(0.0, f64::max));
            let bound = of.map(|f| f * largest);
            // P_(n+1)^(m)(1) by P_n^(m)(1).
            let n = (order + index) as f64;
            largest *= (n + 1.0 + order as f64) / (n + 1.0 - order as f64);
            bound
        })
        .collect();
    let mut sum = [0.0; 2];
    let mut bounds: Vec<Factors> = (of_degrees.chunks(STRETCH).rev())
        .map(|stretch| {
            for bound in stretch {
                sum = [sum[0] + bound[0], sum[1] + bound[1]];
            }
            sum
        })
        .collect();
    bounds.reverse();
    bounds
}

/// Cosine and sine of `m` times an angle.
fn multiple([cos, sin]: [f64; 2], m: usize) -> [f64; 2] {
    let turn = |[c, s]: [f64; 2]| [c * cos - s * sin, c * sin + s * cos];
    (0..m).fold([1.0, 0.0], |angle, _| turn(angle))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_of_harmonic_functions_are_those_by_differences() {
        let pair = Pair::resolving_velocities(0.4, 0.7, 2, 1.0).unwrap();
        let point = Vector3::new(0.3, -0.2, 0.1);
        for order in 0..4 {
            for (phase, factors) in [
                (Phase::Cos, [1.0, 0.0]),
                (Phase::Sin, [0.0, 1.0]),
                (Phase::Sin, [0.3, -0.8]),
            ] {
                let mut function = Harmonic::default();
                let series: Vec<Factors> = (0..order + 4)
                    .map(|n| if n < order { [0.0; 2] } else { factors })
                    .collect();
                function.add(order, phase, 1.0, &series);
                let value = |of: &Harmonic, at| Harmonics::new([of]).at(&Place::new(&pair, &at))[0];
                for (axis, derivative) in function.gradient(&pair).iter().enumerate() {
                    let step = Vector3::ith(axis, 1e-5);
                    let difference =
                        value(&function, point + step) - value(&function, point - step);
                    let found = value(derivative, point);
                    let error = (found - difference / 2e-5).abs() / found.abs().max(1.0);
                    assert!(error < 1e-8, "{order} {phase:?} {axis}: {error:e}");
                }
            }
        }
    }

    #[test]
    fn the_inverse_distance_from_a_pole_is_one_series_of_one_term() {
        let pair = Pair::resolving_velocities(0.4, 1.0, 2, 1.0).unwrap();
        let mut function = Harmonic::default();
        let front = std::f64::consts::SQRT_2 * (0.5 * pair.half_width()).exp();
        function.add(0, Phase::Cos, front / 2.0, &[[1.0, 0.0]]);
        let point = Vector3::new(0.3, -0.2, 0.1);
        let found = Harmonics::new([&function]).at(&Place::new(&pair, &point))[0];
        let distance = (point - Vector3::z()).norm();
        assert!((found * distance - 1.0).abs() < 1e-14, "{found} {distance}");
    }
}
