//! Lubrication theory of spheres of unlike radii.

use scene::{
    ActiveLoads, Gap, Hydrodynamics, LoadSet, ModelDescription, PairLoads, SceneError, SwirlLoads,
    checked_ratio, singular,
};

use crate::{CUTOFF, Form, RANGE};

/// Lubrication theory for two spheres of given radii.
///
/// ```
/// use lt::{Form, UnlikeLubrication};
/// use scene::{Gap, Hydrodynamics, LoadSet};
/// let model = UnlikeLubrication::new(Form::Corrected, 2.0)?;
/// let [small, _] = model.interacting_loads_of_each(Gap::new(0.1)?, LoadSet::all(2))?;
/// assert!((small.pair.modes()[1].xf.own() - 16.0 / 3.0 * 10f64.ln()).abs() < 1e-13);
/// # Ok::<(), scene::SceneError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnlikeLubrication {
    axial_squirming: f64,
    ratio: f64,
}

impl UnlikeLubrication {
    /// In the given form, for spheres whose radii are in the given `ratio`, that of sphere 2 over that of sphere 1.
    ///
    /// # Errors
    /// [`SceneError::NotPositive`] for a ratio that is not a positive number, [`SceneError::Radius`] outside 0.01 to 100: powers of some
    /// ratios are no numbers.
    pub fn new(form: Form, ratio: f64) -> Result<Self, SceneError> {
        if !(ratio > 0.0 && ratio.is_finite()) {
            return Err(SceneError::NotPositive {
                what: "radius ratio",
                value: ratio,
            });
        }
        Ok(Self {
            axial_squirming: form.axial_squirming(),
            ratio: checked_ratio(ratio)?,
        })
    }
}

impl Hydrodynamics for UnlikeLubrication {
    fn description(&self) -> ModelDescription<'_> {
        ModelDescription {
            ratio: self.ratio,
            cutoff: Some(CUTOFF * self.ratio.min(1.0)),
            ..ModelDescription::smooth(RANGE)
        }
    }

    fn error_estimate(&self, gap: Gap, set: LoadSet) -> Result<Option<f64>, SceneError> {
        self.interacting_loads(gap, set).map(|_| None)
    }

    fn fingerprint(&self) -> String {
        let Self {
            axial_squirming,
            ratio,
        } = self;
        format!("lubrication, axial squirming {axial_squirming}, radii 1 to {ratio:?}")
    }

    fn interacting_loads(&self, gap: Gap, set: LoadSet) -> Result<PairLoads, SceneError> {
        let [one, _] = self.interacting_loads_of_each(gap, set)?;
        Ok(one.pair)
    }

    fn interacting_loads_with_swirl(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<(PairLoads, SwirlLoads), SceneError> {
        let [one, _] = self.interacting_loads_of_each(gap, set)?;
        Ok((one.pair, one.swirl))
    }

    fn interacting_loads_of_each(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<[ActiveLoads; 2], SceneError> {
        set.check()?;
        RANGE.check(gap)?;
        let mut loads = singular::of_each(gap, self.ratio, set, self.axial_squirming);
        let alone = ActiveLoads::isolated(set);
        for of in &mut loads {
            of.pair += &alone.pair;
            of.swirl += &alone.swirl;
        }
        Ok(loads)
    }
}
