//! Made-up models for tests: smooth loads with the true singular parts, cheap enough for any number of runs.

use crate::{
    ActiveLoads, Gap, GapRange, Hydrodynamics, LoadSet, ModelDescription, PairLoads, SceneError,
    SelfOther, SwirlLoads, singular,
};

/// A made-up model with the true singular parts, a seam at which it jumps, and stated noise.
#[derive(Clone)]
pub(crate) struct Made {
    pub seam: Option<f64>,
    pub noise: f64,
}

impl Hydrodynamics for Made {
    fn description(&self) -> ModelDescription<'_> {
        ModelDescription {
            ratio: 1.0,
            range: GapRange::from(1e-3),
            cutoff: None,
            seams: self.seam.as_slice(),
            noise: self.noise,
        }
    }

    fn interacting_loads(&self, gap: Gap, set: LoadSet) -> Result<PairLoads, SceneError> {
        self.range().check(gap)?;
        let (eps, r) = (gap.eps(), gap.distance());
        let mut loads = PairLoads::isolated(set);
        let jump = match self.seam {
            Some(seam) if eps > seam => 1e-3,
            _ => 0.0,
        };
        // Decays as 1/r far away, has the singular part and an eps ln eps term at contact.
        let fade = (2.0 / r).powi(3);
        let singular = singular::loads(gap, set, singular::AXIAL_SQUIRMING);
        loads.xa.difference += fade * (singular.xa.difference + eps * gap.ln()) - 1.5 / r;
        loads.ya += SelfOther::new(0.2 / (r * r) + jump, -0.7 / r);
        loads.yb += SelfOther::new(-0.1 / (r * r), 0.3 / (r * r));
        for (n, mode) in (1u8..).zip(loads.modes_mut()) {
            mode.xf.sum += f64::from(n) * fade;
            mode.yt.sum += f64::from(n) * fade * gap.log_inverse();
            mode.yf.sum += f64::from(n) * fade;
        }
        Ok(loads)
    }

    fn interacting_loads_with_swirl(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<(PairLoads, SwirlLoads), SceneError> {
        let mut swirl = singular::swirl(gap, set);
        let fade = (2.0 / gap.distance()).powi(3);
        for (n, mode) in (1u8..).zip(swirl.modes_mut()) {
            let smooth = SelfOther::new(f64::from(n), gap.eps() * gap.ln());
            for load in [&mut mode.xtc, &mut mode.yfc, &mut mode.ytc] {
                load.sum = fade * (load.sum + smooth.sum);
                load.difference = fade * (load.difference + smooth.difference);
            }
        }
        Ok((self.interacting_loads(gap, set)?, swirl))
    }

    fn error_estimate(&self, gap: Gap, _: LoadSet) -> Result<Option<f64>, SceneError> {
        Ok(Some(1e-6 / gap.eps()))
    }

    fn fingerprint(&self) -> String {
        format!("made {:?} {}", self.seam, self.noise)
    }
}

/// A made-up model of unlike radii, with the true singular parts, that fades far apart.
#[derive(Clone, Copy)]
pub(crate) struct Unlike(pub f64);

impl Hydrodynamics for Unlike {
    fn description(&self) -> ModelDescription<'_> {
        ModelDescription {
            ratio: self.0,
            ..ModelDescription::smooth(GapRange::from(1e-3))
        }
    }

    fn fingerprint(&self) -> String {
        format!("unlike {}", self.0)
    }

    fn interacting_loads(&self, gap: Gap, set: LoadSet) -> Result<PairLoads, SceneError> {
        Ok(self.interacting_loads_of_each(gap, set)?[0].pair)
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
        self.range().check(gap)?;
        let touching = 1.0 + self.0;
        let fade = (touching / gap.distance_at_ratio(self.0)).powi(4);
        let mut loads = singular::of_each(gap, self.0, set, singular::AXIAL_SQUIRMING);
        for (k, of) in loads.iter_mut().enumerate() {
            let faded = |s: &mut SelfOther, more: f64| {
                s.sum = fade * (s.sum + more);
                s.difference = fade * (s.difference - 0.5 * more);
            };
            // By what a sphere is, not by where it is named.
            let more = 0.35
                + if (k == 0) == (self.0 < 1.0) {
                    0.05
                } else {
                    -0.05
                };
            for scalar in [
                &mut of.pair.xa,
                &mut of.pair.ya,
                &mut of.pair.yb,
                &mut of.pair.yc,
            ] {
                faded(scalar, 0.2 * more);
            }
            for mode in of.pair.modes_mut() {
                for load in [&mut mode.xf, &mut mode.yf, &mut mode.yt] {
                    faded(load, more);
                }
            }
            for mode in of.swirl.modes_mut() {
                for load in [&mut mode.xtc, &mut mode.yfc, &mut mode.ytc] {
                    faded(load, more);
                }
            }
            let alone = ActiveLoads::isolated(set);
            of.pair += &alone.pair;
            of.swirl += &alone.swirl;
        }
        Ok(loads)
    }

    fn error_estimate(&self, _: Gap, _: LoadSet) -> Result<Option<f64>, SceneError> {
        Ok(None)
    }
}

/// A made-up model that ends at a gap.
#[derive(Clone)]
pub(crate) struct Cut {
    pub made: Made,
    pub at: f64,
}

impl Hydrodynamics for Cut {
    fn description(&self) -> ModelDescription<'_> {
        ModelDescription {
            cutoff: Some(self.at),
            ..self.made.description()
        }
    }

    fn interacting_loads(&self, gap: Gap, set: LoadSet) -> Result<PairLoads, SceneError> {
        self.made.interacting_loads(gap, set)
    }

    fn interacting_loads_with_swirl(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<(PairLoads, SwirlLoads), SceneError> {
        self.made.interacting_loads_with_swirl(gap, set)
    }

    fn error_estimate(&self, gap: Gap, set: LoadSet) -> Result<Option<f64>, SceneError> {
        self.made.error_estimate(gap, set)
    }

    fn fingerprint(&self) -> String {
        format!("{} up to {}", self.made.fingerprint(), self.at)
    }
}
