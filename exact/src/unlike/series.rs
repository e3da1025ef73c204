//! All loads of an unlike pair from the bispherical series: both spheres active in turn, by one factorisation.

use std::f64::consts::SQRT_2;

use scene::{ActiveLoads, LoadSet, SelfOther};

use super::across::{Across, Formula};
use super::geometry::Pair;
use super::lone::{self, Lone};
use super::residual::residual;
use super::system::{Charge, NOMINAL, PairSeries, PairSystem};
use super::tail::Tail;
use super::twist;
use crate::ExactError;
use crate::error::check;
use crate::field::SurfacePoint;
use crate::system::Field;
use crate::{axial, transverse};

/// The solved problems of one gap.
pub struct Solved {
    pair: Pair,
    set: LoadSet,
    axial: PairSeries,
    transverse: Option<PairSeries>,
}

/// The rows of all cases of both active spheres, those of the second one last: nothing on the active sphere.
fn cases(rows: impl Fn(usize) -> Vec<Vec<f64>>) -> Vec<[Vec<f64>; 2]> {
    let of = |active: usize| {
        rows(active).into_iter().map(move |on_other| {
            let at_rest = vec![0.0; on_other.len()];
            if active == 0 {
                [at_rest, on_other]
            } else {
                [on_other, at_rest]
            }
        })
    };
    of(0).chain(of(1)).collect()
}

impl Solved {
    /// Solves at the gap `eps` for radii in the given `ratio`, with `factor` times the terms that reach rounding.
    pub fn new(eps: f64, ratio: f64, set: LoadSet, factor: f64) -> Result<Self, ExactError> {
        check(set)?;
        let pair = Pair::new(eps, ratio, set.modes.max(set.swirl), factor)?;
        let across = set.transverse.any() || set.swirl > 0;
        Ok(Self {
            pair,
            set: set.of_any_pair(),
            axial: solve_axial(pair, set)?,
            transverse: across
                .then(|| solve_transverse(pair, set, factor))
                .transpose()?,
        })
    }

    /// The loads, of either active sphere.
    pub fn loads(&self) -> [ActiveLoads; 2] {
        [0, 1].map(|active| self.loads_of(active, Formula::First))
    }

    /// The same by a second formula where there is one.
    pub fn loads_by_second_formula(&self) -> [ActiveLoads; 2] {
        [0, 1].map(|active| self.loads_of(active, Formula::Second))
    }

    /// Largest difference between the solved flows and their boundary velocities (of order 1) at `2 count` points of either sphere,
    /// none of which the solution knows of. What lies beyond the highest degree is not counted in.
    pub fn residual(&self, count: usize) -> f64 {
        let fields = axial::Fields::new(NOMINAL);
        let flows: Vec<Lone> = lone::axial_flows(self.set.modes).collect();
        let answer = |sphere: usize, point: &SurfacePoint, case: usize| {
            let sum = |field: Field| point.sum_of(field.order, self.axial.jet(sphere, field, case));
            point.axial_velocity(&fields, sum).0
        };
        let along = residual(&self.pair, count, &flows, answer, |flow, at| at.axial(flow));
        let Some(series) = &self.transverse else {
            return along;
        };
        let fields = transverse::Fields::new(1, NOMINAL);
        let flows: Vec<Lone> = lone::transverse_flows(self.set).collect();
        let answer = |sphere: usize, point: &SurfacePoint, case: usize| {
            let sum = |field: Field| point.sum_of(field.order, series.jet(sphere, field, case));
            point.transverse_velocity(&fields, sum).0
        };
        along.max(residual(&self.pair, count, &flows, answer, |flow, at| {
            at.transverse(flow)
        }))
    }

    fn loads_of(&self, active: usize, formula: Formula) -> ActiveLoads {
        let mut loads = ActiveLoads::isolated(self.set);
        self.add_axial(active, &mut loads);
        if let Some(series) = &self.transverse {
            Across::new(&self.pair, series, (active, self.set), formula).add_to(&mut loads);
        }
        loads
    }

    fn add_axial(&self, active: usize, loads: &mut ActiveLoads) {
        let field = axial::Fields::new(NOMINAL).axial;
        let scale = 8.0 * SQRT_2 * self.pair.spheres[active].sinh;
        let force = |case: usize| {
            let case = active * (1 + self.set.modes) + case;
            // Along the direction from each sphere to the other one.
            let of = |sphere| scale * self.axial.charge(sphere, field, case, Charge::Force);
            SelfOther::new(of(active), -of(1 - active))
        };
        // Both moving as one along `d` of the active sphere, the force on it: by the reciprocal theorem the sum of the forces on both by
        // one. It has no part that diverges at contact.
        let both = 2 * (1 + self.set.modes);
        let together = scale * self.axial.charge(active, field, both, Charge::Force);
        let together = if active == 0 { together } else { -together };
        let drag = SelfOther {
            sum: together,
            ..force(0)
        };
        loads.pair.xa += times(-1.0 / 6.0, drag);
        for (k, mode) in (1..).zip(loads.pair.modes_mut()) {
            mode.xf += force(k);
        }
        let twists = twist::answers(&self.pair, active, self.set.swirl.max(1));
        if self.set.twist {
            loads.pair.xc += times(-1.0 / 8.0, twists[0]);
        }
        for (mode, twist) in loads.swirl.modes_mut().iter_mut().zip(twists) {
            mode.xtc += twist;
        }
    }
}

fn solve_axial(pair: Pair, set: LoadSet) -> Result<PairSeries, ExactError> {
    let mut system = PairSystem::new(pair, axial::FIELDS, None);
    axial::assemble(&mut system, NOMINAL, &axial::Fields::new(NOMINAL));
    let mut cases = cases(|active| lone::axial_rows(&pair, active, set.modes));
    let [second, first] = [&cases[1 + set.modes][0], &cases[0][1]];
    cases.push([second.iter().map(|v| -v).collect(), first.clone()]);
    system.solve(&cases)
}

fn solve_transverse(pair: Pair, set: LoadSet, factor: f64) -> Result<PairSeries, ExactError> {
    let mut system = PairSystem::new(pair, transverse::FIELDS, Tail::of(&pair, factor));
    transverse::assemble(&mut system, NOMINAL, &transverse::Fields::new(1, NOMINAL));
    system.solve(&cases(|active| lone::transverse_rows(&pair, active, set)))
}

/// A multiple of both.
pub fn times(factor: f64, of: SelfOther) -> SelfOther {
    SelfOther {
        sum: factor * of.sum,
        difference: factor * of.difference,
    }
}

#[cfg(test)]
mod tests {
    use super::super::columns::columns;
    use super::*;
    use crate::fit::relative_distance;

    const SET: LoadSet = LoadSet::all(8).with_swirl(8);

    /// Loads by a sphere's own singular parts, and by the reciprocal theorem where that is taken.
    fn assert_formulas_agree(ratio: f64, gap: f64, tolerance: f64) {
        let solved = Solved::new(gap * ratio.min(1.0), ratio, SET, 1.0).unwrap();
        let by_charges = [0, 1].map(|active| solved.loads_of(active, Formula::Charges));
        for (name, loads) in [
            ("first", solved.loads()),
            ("second", solved.loads_by_second_formula()),
        ] {
            let error = relative_distance(&columns(&loads), &columns(&by_charges));
            println!("ratio {ratio}, gap {gap:e}, {name}: {error:.1e}");
            assert!(error < tolerance, "{ratio}, {gap:e}, {name}: {error:e}");
        }
    }

    #[test]
    fn loads_by_the_reciprocal_theorem_are_those_by_singular_parts() {
        for ratio in [0.1, 0.3, 0.5, 2.0, 3.0, 10.0] {
            for gap in [0.01, 0.1, 1.0, 10.0, 100.0] {
                assert_formulas_agree(ratio, gap, 1e-10);
            }
        }
        assert_formulas_agree(100.0, 0.01, 2e-8);
        assert_formulas_agree(100.0, 10.0, 1e-10);
    }

    #[test]
    fn the_flow_keeps_its_boundary_values_at_points_that_were_not_fitted() {
        for ratio in [0.5, 0.9, 3.0] {
            // Loads are off by the square of this.
            for (gap, tolerance) in [(20.0, 1e-11), (1.0, 1e-8), (0.1, 1e-6), (0.01, 1e-6)] {
                let solved = Solved::new(gap, ratio, SET, 1.0).unwrap();
                let residual = solved.residual(12);
                println!("ratio {ratio}, gap {gap}: {residual:.1e}");
                assert!(residual < tolerance, "{ratio}, {gap}: {residual:e}");
            }
        }
    }

    #[test]
    fn like_spheres_have_the_loads_of_their_parities() {
        for eps in [1e-4, 1e-3, 0.01, 0.1, 1.0, 10.0, 100.0] {
            let solved = Solved::new(eps, 1.0, SET, 1.0).unwrap();
            let equal = crate::series::Solved::new(eps, SET, 1.0).unwrap();
            let expected = ActiveLoads::of_equal(equal.loads(), equal.swirl_loads());
            let expected = columns(&[expected; 2]);
            for loads in [solved.loads(), solved.loads_by_second_formula()] {
                let error = relative_distance(&columns(&loads), &expected);
                println!("gap {eps:e}: {error:.1e}");
                assert!(error < 1e-10, "{eps}: {error:e}");
            }
        }
    }
}
