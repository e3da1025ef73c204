//! The reciprocal theorem between rigid motions and slip, by quadrature over the sphere.
//!
//! Held still, a sphere with tangential slip `u_s` feels `F.U = ∫ u_s.f dS`, where `f` is the
//! traction in the same pair's rigid motion `U` (Stone & Samuel, *Phys. Rev. Lett.* 77 (1996)
//! 4102). On a rigid surface the tangential traction is `du/dn`, less `omega x n` when it turns.
//! With `dn = -c dxi/S` and `dS = c^2/S^2 dmu dphi` the loads need only `du/dxi` of the rigid flow:
//! none of the slip problem's own series.

use gauss_quad::legendre::GaussLegendre;

use scene::LoadSet;

use crate::axial::Axial;
use crate::field::{SurfacePoint, Velocity};
use crate::geometry::{Geometry, Parity};
use crate::transverse::{ROTATION, TRANSLATION, Transverse};

fn dot(a: Velocity, b: Velocity) -> f64 {
    a.axial * b.axial + a.radial * b.radial + a.azimuthal * b.azimuthal
}

/// Points of the sphere and their weights in `∫ dmu`.
fn quadrature(geometry: Geometry) -> Vec<(SurfacePoint, f64)> {
    let rule = GaussLegendre::new((geometry.degree + 20).try_into().unwrap());
    let rule = rule.iter();
    rule.map(|(mu, weight)| (SurfacePoint::new(geometry, *mu), *weight))
        .collect()
}

fn assert_reciprocal(name: &str, eps: f64, direct: f64, by_traction: f64, tolerance: f64) {
    let error = (direct - by_traction).abs() / direct.abs().max(1.0);
    assert!(
        error < tolerance,
        "{name} at {eps}: {direct} by the slip problem, {by_traction} by traction ({error:.1e})"
    );
}

fn check(eps: f64, modes: usize, tolerance: f64) {
    let set = LoadSet::all(modes).with_swirl(modes);
    let geometry = Geometry::new(eps, modes, 1.0).unwrap();
    let c = geometry.sinh;
    let points = quadrature(geometry);
    // `∫ integrand dmu` of what depends on the point, `cosh(alpha) - mu` and the slope of a rigid flow there.
    let integral = |slopes: &[Velocity],
                    integrand: &dyn Fn(&SurfacePoint, f64, Velocity) -> f64| {
        let values = points.iter().zip(slopes);
        let values = values.map(|((point, weight), slope)| {
            weight * integrand(point, geometry.cosh - point.mu, *slope)
        });
        values.sum::<f64>()
    };
    let slopes = |flow: &dyn Fn(&SurfacePoint) -> (Velocity, Velocity)| -> Vec<Velocity> {
        points.iter().map(|(point, _)| flow(point).1).collect()
    };
    for parity in [Parity::Even, Parity::Odd] {
        let axial = Axial::solve(geometry, parity, modes).unwrap();
        let along = slopes(&|point| point.axial_flow(&axial, 0));
        for k in 1..=modes {
            let force = integral(&along, &|point, s, slope| {
                -2.0 * c * dot(point.axial_boundary(k), slope) / s
            });
            assert_reciprocal("XF", eps, axial.force(k), force, tolerance);
        }
        let transverse = Transverse::solve(geometry, parity, set).unwrap();
        let [across, turning] = [TRANSLATION, ROTATION]
            .map(|motion| slopes(&|point| point.transverse_flow(&transverse, motion)));
        let swirl = transverse.swirl(1);
        for case in ROTATION..=ROTATION + 2 * modes {
            let force = integral(&across, &|point, s, slope| {
                -c * dot(point.transverse_boundary(case, swirl), slope) / s
            });
            assert_reciprocal("YF", eps, transverse.force(case), force, tolerance);
            let torque = integral(&turning, &|point, s, slope| {
                let rigid = point.transverse_boundary(ROTATION, swirl);
                let slip = point.transverse_boundary(case, swirl);
                -c * (dot(slip, slope) + c * dot(slip, rigid) / s) / s
            });
            assert_reciprocal("YT", eps, transverse.torque(case), torque, tolerance);
        }
    }
}

#[test]
fn slip_loads_equal_the_slip_weighted_with_the_traction_of_rigid_motion() {
    check(2.0, 8, 1e-10);
    check(0.1, 8, 1e-10);
    check(0.01, 3, 1e-10);
    check(1e-3, 2, 1e-8);
}
