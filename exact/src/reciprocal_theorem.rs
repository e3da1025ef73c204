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

/// `∫ integrand dmu` over the sphere.
fn integral(geometry: Geometry, integrand: impl Fn(&SurfacePoint, f64) -> f64) -> f64 {
    GaussLegendre::new((geometry.degree + 20).try_into().unwrap())
        .iter()
        .map(|(mu, weight)| {
            let point = SurfacePoint::new(geometry, *mu);
            weight * integrand(&point, geometry.cosh - mu)
        })
        .sum()
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
    for parity in [Parity::Even, Parity::Odd] {
        let axial = Axial::solve(geometry, parity, modes).unwrap();
        let transverse = Transverse::solve(geometry, parity, set).unwrap();
        for k in 1..=modes {
            let force = integral(geometry, |point, s| {
                let slope = point.axial_flow(&axial, 0).1;
                -2.0 * c * dot(point.axial_boundary(k), slope) / s
            });
            assert_reciprocal("XF", eps, axial.force(k), force, tolerance);
        }
        for case in ROTATION..=ROTATION + 2 * modes {
            let force = integral(geometry, |point, s| {
                let slope = point.transverse_flow(&transverse, TRANSLATION).1;
                -c * dot(point.transverse_boundary(case, transverse.swirl(1)), slope) / s
            });
            assert_reciprocal("YF", eps, transverse.force(case), force, tolerance);
            let torque = integral(geometry, |point, s| {
                let slope = point.transverse_flow(&transverse, ROTATION).1;
                let rigid = point.transverse_boundary(ROTATION, transverse.swirl(1));
                let slip = point.transverse_boundary(case, transverse.swirl(1));
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
