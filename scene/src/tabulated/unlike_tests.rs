//! Tables of unlike radii.

use std::sync::Arc;

use super::*;
use crate::{GapRange, SelfOther, singular};

/// A made-up model of unlike radii, with the true singular parts, that fades far apart.
#[derive(Clone, Copy)]
struct Unlike(f64);

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
            let more = 0.3 + 0.1 * k as f64;
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

const TOLERANCE: f64 = 1e-9;

fn table(ratio: f64, set: LoadSet) -> Tabulated {
    let options = TableOptions {
        set,
        tolerance: TOLERANCE,
        smallest_gap: 1e-3,
    };
    Tabulated::build(Arc::new(Unlike(ratio)), options, &|_| ()).unwrap()
}

/// All coefficients by name, with those of the second squirmer marked.
fn named(model: &dyn Hydrodynamics, gap: Gap, set: MobilitySet) -> Vec<(String, f64)> {
    model
        .interacting_mobility_of_each(gap, set)
        .unwrap()
        .named(set)
}

#[test]
fn a_table_of_unlike_radii_agrees_with_its_model_between_its_nodes_and_to_infinity() {
    for ratio in [0.3, 4.0] {
        let set = MobilitySet {
            loads: LoadSet::all(3).with_swirl(2),
            torque: true,
        };
        let table = table(ratio, set.loads);
        assert_eq!(table.summary().limit, TableLimit::Tolerance(TOLERANCE));
        for i in 0..250 {
            let gap = Gap::new((-6.9 + 0.1 * f64::from(i)).exp()).unwrap();
            let both = named(&table, gap, set)
                .into_iter()
                .zip(named(table.model(), gap, set));
            for ((name, found), (_, truth)) in both {
                let scale = if name.starts_with("opening") {
                    gap.eps().max(1.0)
                } else {
                    1.0
                };
                let error = scale * (found - truth).abs() / truth.abs().max(1.0);
                assert!(error <= 3.0 * TOLERANCE, "{name} at {}: {error}", gap.eps());
            }
        }
    }
}

#[test]
fn coefficients_do_not_depend_on_what_else_a_table_of_unlike_radii_holds() {
    let planar = LoadSet::planar(2);
    let [plain, whole] = [planar, LoadSet::all(3).with_swirl(2)].map(|set| table(2.0, set));
    let set = MobilitySet {
        loads: planar,
        torque: true,
    };
    for eps in [0.002, 0.3, 5.0, 1e3] {
        let gap = Gap::new(eps).unwrap();
        assert_eq!(named(&plain, gap, set), named(&whole, gap, set));
    }
    let more = MobilitySet {
        loads: LoadSet::all(2),
        torque: true,
    };
    let refused = plain.interacting_mobility_of_each(Gap::new(0.1).unwrap(), more);
    assert!(matches!(refused, Err(SceneError::LoadsNotHeld { .. })));
}

#[test]
fn a_table_of_equal_radii_gives_the_coefficients_of_each_as_its_model_does() {
    let set = MobilitySet {
        loads: LoadSet::planar(2),
        torque: false,
    };
    let table = table(1.0, set.loads);
    let gap = Gap::new(0.01).unwrap();
    let of_model = table.model().interacting_mobility_of_each(gap, set);
    let of_table = table.interacting_mobility_of_each(gap, set);
    assert_eq!(of_table.unwrap(), of_model.unwrap());
}
