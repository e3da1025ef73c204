//! Lubrication theory of two squirming spheres: the loads in closed form, of equal spheres ([`Lubrication`]) and of unlike ones
//! ([`UnlikeLubrication`]).
//!
//! Isolated loads plus the parts that diverge at contact where `eps <= 1`, isolated loads beyond,
//! after Darveniza, Ishikawa, Pedley & Brumley, *Pairwise scattering and bound states of spherical
//! microorganisms* (2022). At `eps = 1` the loads jump: `1/(4 eps)` does not vanish there.
//!
//! ```
//! use lt::{Form, Lubrication};
//! use scene::{Gap, Hydrodynamics, LoadSet};
//! let loads = Lubrication::new(Form::Published).loads(Gap::new(0.1)?, LoadSet::all(2))?;
//! let log = 10f64.ln();
//! assert!((loads.xa.own() - (1.0 + 2.5 + 9.0 / 40.0 * log)).abs() < 1e-14);
//! assert!((loads.modes()[0].xf.own() - (4.0 + 9.0 / 4.0 * log)).abs() < 1e-14);
//! # Ok::<(), scene::SceneError>(())
//! ```

mod unlike;

pub use unlike::UnlikeLubrication;

use scene::mobility::{MobilitySet, ModeMobility, PairMobility};
use scene::singular::{self, Singular};
use scene::{
    Configuration, Gap, GapRange, Hydrodynamics, LoadSet, ModeLoads, ModelDescription, PairLoads,
    Plan, Rates, Run, RunOptions, Sample, SceneError, SelfOther, SwirlLoads, balance,
};

/// Gap up to which the spheres interact, in radii of the smaller sphere.
///
/// Lubrication theory asks for a gap that is small against both spheres, so that the smaller one decides. The paper, whose formulas hold for
/// unlike radii, cuts at `eps = 1` for equal ones.
pub const CUTOFF: f64 = 1.0;

/// Which coefficient the axial squirming force has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// `9/4`, as the paper prints it and as its figures were computed.
    Published,
    /// `3`, from zero net flux through the gap: the slope of exact solutions.
    Corrected,
}

impl Form {
    /// Coefficient of `ln(1/eps)` in `XF1_n = -XF2_n`.
    #[must_use]
    pub fn axial_squirming(self) -> f64 {
        match self {
            Self::Published => 9.0 / 4.0,
            Self::Corrected => singular::AXIAL_SQUIRMING,
        }
    }
}

/// Lubrication theory as a hydrodynamic model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lubrication {
    axial_squirming: f64,
}

impl Lubrication {
    /// Lubrication theory in the given form.
    #[must_use]
    pub fn new(form: Form) -> Self {
        Self {
            axial_squirming: form.axial_squirming(),
        }
    }
}

/// Gaps for which the closed form can be evaluated.
const RANGE: GapRange = GapRange::from(f64::MIN_POSITIVE);

impl Lubrication {
    /// Runs a plan and hands over its samples as they come: [`scene::run_monomorphic`], compiled once, here.
    ///
    /// # Errors
    /// As [`scene::run`].
    pub fn run(
        &self,
        plan: &Plan,
        options: &RunOptions,
        observe: &mut dyn FnMut(&Sample),
    ) -> Result<Run, SceneError> {
        scene::run_monomorphic(plan, self, options, observe)
    }

    /// The right-hand side of a plan, evaluated `times` times over: [`scene::rates_monomorphic`], compiled once, here.
    ///
    /// # Errors
    /// As [`scene::rates`].
    pub fn rates(
        &self,
        plan: &Plan,
        configuration: &Configuration,
        times: usize,
    ) -> Result<Rates, SceneError> {
        scene::rates_monomorphic(plan, self, configuration, times)
    }
}

/// The loads: resistance scalars `[xa, ya, yb, xc, yc]`, those of the first squirming mode, and those of any other.
struct Parts {
    rigid: [SelfOther; 5],
    first: ModeLoads,
    others: ModeLoads,
}

impl Parts {
    /// Loads of a mode, counted from 0.
    #[inline(always)]
    fn mode(&self, n: usize) -> ModeLoads {
        if n == 0 { self.first } else { self.others }
    }
}

impl Lubrication {
    /// The loads of spheres that interact.
    #[inline(always)]
    fn parts(&self, gap: Gap) -> Parts {
        let Singular {
            mut xa,
            mut ya,
            yb,
            mut yc,
            mode,
        } = Singular::at(gap, self.axial_squirming);
        let unit = SelfOther::new(1.0, 0.0);
        xa += unit;
        ya += unit;
        yc += unit;
        let mut first = mode;
        let thrust = SelfOther::new(4.0, 0.0);
        first.xf += thrust;
        first.yf += thrust;
        Parts {
            rigid: [xa, ya, yb, unit, yc],
            first,
            others: mode,
        }
    }
}

impl Hydrodynamics for Lubrication {
    fn description(&self) -> ModelDescription<'_> {
        ModelDescription {
            cutoff: Some(CUTOFF),
            ..ModelDescription::smooth(RANGE)
        }
    }

    fn error_estimate(&self, gap: Gap, set: LoadSet) -> Result<Option<f64>, SceneError> {
        set.check()?;
        RANGE.check(gap)?;
        Ok(None)
    }

    fn fingerprint(&self) -> String {
        format!("lubrication, axial squirming {}", self.axial_squirming)
    }

    #[inline]
    fn interacting_loads(&self, gap: Gap, set: LoadSet) -> Result<PairLoads, SceneError> {
        set.check()?;
        RANGE.check(gap)?;
        let parts = self.parts(gap);
        Ok(PairLoads::from_parts(parts.rigid, set, |n| parts.mode(n)))
    }

    #[inline(always)]
    fn interacting_mobility(
        &self,
        gap: Gap,
        set: MobilitySet,
        into: (&mut PairMobility, &mut [ModeMobility]),
    ) -> Result<(), SceneError> {
        set.loads.check()?;
        RANGE.check(gap)?;
        let parts = self.parts(gap);
        balance::solve_parts(gap, (parts.rigid, |n| parts.mode(n)), set, into);
        Ok(())
    }

    #[inline]
    fn interacting_loads_with_swirl(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<(PairLoads, SwirlLoads), SceneError> {
        let loads = self.interacting_loads(gap, set)?;
        let mut swirl = singular::swirl(gap, set);
        if let Some(first) = swirl.modes_mut().first_mut() {
            // The torque on a lone sphere.
            let torque = SelfOther::new(-8.0, 0.0);
            first.xtc += torque;
            first.ytc += torque;
        }
        Ok((loads, swirl))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::{assert_relative_eq, relative_eq};

    /// The published list, scalar by scalar, with either axial squirming: isolated plus singular where `eps <= 1`.
    fn listed(name: &str, log: f64, eps: f64, k: f64) -> f64 {
        let squeeze = 1.0 / (4.0 * eps) + 9.0 / 40.0 * log;
        match name {
            "X11A" => 1.0 + squeeze,
            "X12A" => -squeeze,
            "Y11A" => 1.0 + log / 6.0,
            "Y12A" => -log / 6.0,
            "Y11B" => -log / 4.0,
            "Y12B" => log / 4.0,
            "X11C" => 1.0,
            "X12C" => 0.0,
            "Y11C" => 1.0 + log / 5.0,
            "Y12C" => log / 20.0,
            "XF1_1" => 4.0 + k * log,
            "YF1_1" => 4.0 + log,
            _ if name.starts_with("XF1") => k * log,
            _ if name.starts_with("XF2") => -k * log,
            _ if name.starts_with("YF1") => log,
            _ if name.starts_with("YF2") => -log,
            _ if name.starts_with("YT1") => 1.6 * log,
            _ if name.starts_with("YT2") => 0.4 * log,
            _ => panic!("unknown load {name}"),
        }
    }

    #[test]
    fn val_both_forms_are_isolated_plus_singular() {
        for (form, k) in [(Form::Published, 9.0 / 4.0), (Form::Corrected, 3.0)] {
            for eps in [1.0, 0.3, 1e-2, 1e-5, 1e-12] {
                let gap = Gap::new(eps).unwrap();
                let loads = Lubrication::new(form).loads(gap, LoadSet::all(8)).unwrap();
                for (name, value) in loads.named() {
                    let expected = listed(&name, -eps.ln(), eps, k);
                    assert!(
                        relative_eq!(value, expected, max_relative = 4e-15, epsilon = 4e-15),
                        "{name} at gap {eps} is {value}, not {expected}"
                    );
                }
            }
        }
    }

    #[test]
    fn val_the_first_swirl_mode_has_the_loads_of_rigid_rotation() {
        let model = Lubrication::new(Form::Corrected);
        for eps in [3.0, 0.3, 1e-5] {
            let gap = Gap::new(eps).unwrap();
            let set = LoadSet::all(0).with_swirl(3);
            let (pair, swirl) = model.loads_with_swirl(gap, set).unwrap();
            let [first, second, third] = *swirl.modes() else {
                panic!("{swirl:?}")
            };
            for (of_swirl, unit, of_rotation) in [
                (first.xtc, -8.0, pair.xc),
                (first.yfc, -4.0, pair.yb),
                (first.ytc, -8.0, pair.yc),
            ] {
                assert_relative_eq!(of_swirl.sum, unit * of_rotation.sum, max_relative = 4e-15);
                let difference = unit * of_rotation.difference;
                assert_relative_eq!(of_swirl.difference, difference, max_relative = 4e-15);
            }
            assert_eq!(second, third, "the slip at the contact point is the same");
            assert_eq!(second.yfc, first.yfc);
        }
    }

    #[test]
    fn beyond_the_cut_squirmers_are_isolated() {
        let model = Lubrication::new(Form::Published);
        let loads = model
            .loads(Gap::new(1.0 + 1e-15).unwrap(), LoadSet::all(2))
            .unwrap();
        assert_eq!(loads, PairLoads::isolated(LoadSet::all(2)));
    }

    #[test]
    fn sum_of_squeeze_scalars_keeps_its_digits_at_contact() {
        let model = Lubrication::new(Form::Corrected);
        let loads = model
            .loads(Gap::new(1e-14).unwrap(), LoadSet::all(1))
            .unwrap();
        assert_relative_eq!(loads.xa.sum, 1.0, max_relative = 1e-15);
    }

    #[test]
    fn an_asymptotic_form_claims_no_error_but_refuses_what_it_has_no_loads_for() {
        let too_many = SceneError::TooManyModes {
            modes: 9,
            allowed: 8,
        };
        let models: [&dyn Hydrodynamics; 2] = [
            &Lubrication::new(Form::Corrected),
            &UnlikeLubrication::new(Form::Corrected, 2.0).unwrap(),
        ];
        for model in models {
            let near = Gap::new(0.1).unwrap();
            assert_eq!(model.error_estimate(near, LoadSet::all(8)), Ok(None));
            let refused = model.error_estimate(near, LoadSet::all(9));
            assert_eq!(refused, Err(too_many.clone()));
            let smallest = model.description().range.smallest;
            let nearer = Gap::new(smallest / 2.0).unwrap();
            let refused = model.error_estimate(nearer, LoadSet::all(1));
            let outside = SceneError::GapOutsideRange {
                eps: nearer.eps(),
                smallest,
                largest: f64::INFINITY,
            };
            assert_eq!(refused, Err(outside));
        }
    }

    #[test]
    fn models_have_one_fingerprint_only_if_they_have_the_same_loads() {
        let of = |form| Lubrication::new(form).fingerprint();
        let of_unlike = |form, ratio| {
            let model = UnlikeLubrication::new(form, ratio).unwrap();
            model.fingerprint()
        };
        let different = [
            of(Form::Published),
            of(Form::Corrected),
            of_unlike(Form::Published, 2.0),
            of_unlike(Form::Corrected, 2.0),
            of_unlike(Form::Corrected, 2.0f64.next_up()),
        ];
        for (k, one) in different.iter().enumerate() {
            assert!(!different[..k].contains(one), "{one}");
        }
    }

    #[test]
    fn nine_modes_are_refused() {
        let model = Lubrication::new(Form::Corrected);
        let refused = model.loads(Gap::new(0.1).unwrap(), LoadSet::all(9));
        assert_eq!(
            refused,
            Err(SceneError::TooManyModes {
                modes: 9,
                allowed: 8
            })
        );
    }
}
