//! The flow by series against what defines it: the Stokes equations, the surfaces' velocities, the far field.

use crate::pair::{free, lone_flow, pair};
use exact::Exact;
use scene::nalgebra::{Matrix3, Vector3};
use scene::{Flow, Fluid, Gap, MovingPair, SceneError};

const RATIOS: [f64; 3] = [1.0, 0.4, 3.0];
const GAPS: [f64; 5] = [0.01, 0.03, 0.1, 1.0, 10.0];

/// Fractions of 1, spread evenly, of the plastic number's multiples (M. Roberts 2018).
fn spread(k: usize) -> [f64; 3] {
    let g = 1.220_744_084_605_759_5_f64;
    [1, 2, 3].map(|power| (0.5 + k as f64 * g.powi(-power)).fract())
}

/// A unit vector from two fractions of 1.
fn direction(u: f64, v: f64) -> Vector3<f64> {
    let z = 1.0 - 2.0 * u;
    let (sin, cos) = (std::f64::consts::TAU * v).sin_cos();
    let radius = (1.0 - z * z).sqrt();
    Vector3::new(radius * cos, radius * sin, z)
}

fn flow(pair: &MovingPair) -> Box<dyn Flow> {
    let [one, two] = pair.configuration.radii;
    Exact::of_ratio(two / one).unwrap().flow(pair).unwrap()
}

/// Distance of a point of the fluid from the nearer surface.
fn distance(pair: &MovingPair, point: &Vector3<f64>) -> f64 {
    let centres = pair.configuration.positions();
    let from = |k: usize| (point - centres[k]).norm() - pair.configuration.radii[k];
    from(0).min(from(1))
}

/// Points of the fluid: every third one within the gap, the others about the pair.
fn points(pair: &MovingPair, count: usize) -> Vec<Vector3<f64>> {
    let c = &pair.configuration;
    let [one, _] = c.positions();
    let neck = one + c.line * (c.radii[0] + 0.5 * c.gap.eps());
    let of = |k: usize| {
        let [a, b, r] = spread(k);
        if k.is_multiple_of(3) {
            let across = direction(a, b).cross(&c.line) * c.gap.eps().sqrt();
            neck + across + c.line * (0.8 * c.gap.eps() * (r - 0.5))
        } else {
            c.midpoint + direction(a, b) * (5.0 * r * (c.radii[1] + 1.0))
        }
    };
    let all = (0..).map(of).filter(|point| distance(pair, point) > 1e-3);
    all.take(count).collect()
}

/// Derivative along an axis by central differences of sixth order.
fn derivative<T>(f: impl Fn(Vector3<f64>) -> T, at: &Vector3<f64>, axis: usize, h: f64) -> T
where
    T: std::ops::Sub<Output = T> + std::ops::Mul<f64, Output = T> + std::ops::Add<Output = T>,
{
    let difference = |k: f64| {
        let step = Vector3::ith(axis, k * h);
        f(at + step) - f(at - step)
    };
    (difference(1.0) * 45.0 + difference(2.0) * -9.0 + difference(3.0)) * (1.0 / (60.0 * h))
}

#[test]
fn val_the_flow_obeys_the_stokes_equations_at_a_thousand_points() {
    let (mut divergence, mut residual, mut slope) = (0.0_f64, 0.0_f64, 0.0_f64);
    for ratio in RATIOS {
        for gap in GAPS {
            let pair = pair(gap, ratio);
            let flow = flow(&pair);
            for point in points(&pair, 67) {
                let gradient = flow.gradient(&point);
                // What a derivative is made of: the flow changes over the distance to the surface.
                let near = distance(&pair, &point);
                let scale = 1.0 + gradient.norm();
                divergence = divergence.max(gradient.trace().abs() / scale);
                let h = near / 80.0;
                let velocity = |at: Vector3<f64>| flow.at(&at).velocity;
                let by_differences =
                    Matrix3::from_columns(&[0, 1, 2].map(|j| derivative(velocity, &point, j, h)));
                slope = slope.max((by_differences - gradient).norm() / scale);
                // div grad u - grad p, with one derivative taken by differences.
                let force = [0, 1, 2].map(|j| {
                    let pressure = derivative(|at| flow.at(&at).pressure, &point, j, h);
                    let bending = derivative(|at| flow.gradient(&at), &point, j, h);
                    bending.column(j).into_owned() - Vector3::ith(j, pressure)
                });
                let force: Vector3<f64> = force.into_iter().sum();
                residual = residual.max(force.norm() * near / scale);
            }
        }
    }
    println!("divergence {divergence:.1e}, Stokes equation {residual:.1e}, gradient {slope:.1e}");
    assert!(divergence < 1e-9 && residual < 1e-9 && slope < 1e-8);
}

#[test]
fn val_the_flow_has_the_velocity_of_both_surfaces_and_says_how_well() {
    for ratio in RATIOS {
        for gap in GAPS {
            let pair = pair(gap, ratio);
            let flow = flow(&pair);
            let mut worst = 0.0_f64;
            for k in 0..500 {
                let [u, v, _] = spread(k);
                let normal = direction(u, v);
                for sphere in [0, 1] {
                    let centre = pair.configuration.positions()[sphere];
                    let point = centre + normal * pair.configuration.radii[sphere];
                    let difference =
                        flow.at(&point).velocity - pair.surface_velocity(sphere, &normal);
                    worst = worst.max(difference.norm());
                }
            }
            assert!(worst < 1e-9, "ratio {ratio}, gap {gap}: {worst:e}");
            assert!(
                worst < 3.0 * flow.error_estimate(),
                "ratio {ratio}, gap {gap}: {worst:e}"
            );
        }
    }
}

#[test]
fn val_far_away_a_free_pair_is_the_sum_of_its_stresslets() {
    for (gap, ratio) in [(0.02, 1.0), (0.5, 1.0), (0.1, 0.4), (1.0, 3.0)] {
        let pair = free(gap, ratio);
        let flow = flow(&pair);
        let stresses = Exact::of_ratio(ratio)
            .unwrap()
            .stresses(Gap::new(gap).unwrap(), 2, 0);
        let [one, two] = stresses.unwrap().of(&pair).stresslets;
        let stresslet = one + two;
        let mut before = f64::INFINITY;
        for far in [1e2, 1e3, 1e4] {
            let mut worst = 0.0_f64;
            for k in 0..20 {
                let [u, v, _] = spread(k);
                let x = direction(u, v);
                let state = flow.at(&(pair.configuration.midpoint + x * far));
                let along = x.dot(&(stresslet * x));
                let pi = std::f64::consts::PI;
                let velocity = x * (-3.0 / (8.0 * pi) * along);
                let pressure = -3.0 / (4.0 * pi) * along;
                worst = worst.max((state.velocity * far * far - velocity).norm());
                worst = worst.max((state.pressure * far.powi(3) - pressure).abs());
            }
            println!("gap {gap}, ratio {ratio}, distance {far}: {worst:.1e}");
            // What comes next falls off by one power more.
            assert!(worst < 20.0 * (1.0 + ratio).powi(3) / far && worst < 0.2 * before);
            before = worst;
        }
    }
}

#[test]
fn val_a_distant_pair_moves_the_fluid_as_two_lone_squirmers_do() {
    let mut before = f64::INFINITY;
    for gap in [20.0, 40.0, 80.0] {
        let pair = free(gap, 1.0);
        let flow = flow(&pair);
        let mut worst = 0.0_f64;
        for k in 0..40 {
            let [u, v, r] = spread(k);
            let point = pair.configuration.positions()[0] + direction(u, v) * (1.0 + 3.0 * r);
            let expected = lone_flow(&pair, 0, &point) + lone_flow(&pair, 1, &point);
            worst = worst.max((flow.at(&point).velocity - expected).norm());
        }
        println!("gap {gap}: {worst:.1e}");
        // Each strains the fluid about the other as r^-3, which its sphere answers.
        assert!(worst < 60.0 / gap.powi(3) && worst < 0.2 * before);
        before = worst;
    }
}

#[test]
fn a_pair_of_other_radii_or_at_a_gap_without_digits_is_refused() {
    let model = Exact::of_ratio(0.5).unwrap();
    let refused = model.flow(&pair(0.1, 0.4)).err();
    assert!(
        matches!(refused, Some(SceneError::OtherRatio { .. })),
        "{refused:?}"
    );
    for gap in [4e-7, 2e4] {
        let refused = model.flow(&pair(gap, 0.5)).err();
        assert!(
            matches!(refused, Some(SceneError::GapOutsideRange { .. })),
            "{refused:?}"
        );
        assert!(model.stresses(Gap::new(gap).unwrap(), 2, 0).is_err());
    }
    let model = Exact::new();
    let many = model.stresses(Gap::new(1.0).unwrap(), scene::MAX_MODES + 1, 0);
    assert!(matches!(many, Err(SceneError::TooManyModes { .. })));
}
