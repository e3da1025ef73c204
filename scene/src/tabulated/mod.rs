//! Any hydrodynamic model as a table of mobilities: full hydrodynamics at lubrication's price.
//!
//! Up to the gap [`FAR_GAP`] the table interpolates in `ln eps`, in which the coefficients are smooth down to contact; beyond, in
//! `1/r`, out to infinity, times what keeps them bounded there. Stretches end at the model's seams. Chebyshev points are doubled, and
//! pieces halved, until the last coefficients are below the tolerance or the model's own noise; what is evaluated are polynomials
//! of low degree on equal parts (`parts`). Columns that follow from one part of the balance are tabulated together
//! (`columns`), and apart from all others: what a table answers does not depend on what else it holds.
//!
//! Outside its gaps a
//! table asks the model, which may have a closed form there, or refuse. Of a model with a cut the table
//! holds the mobilities of spheres that interact, to the cut and some way beyond, so that nothing jumps; beyond the cut the
//! spheres are alone, as by the model. Loads are the model's own.

mod build;
mod cache;
mod columns;
mod look_up;
mod parts;
mod tally;

pub use build::TableOptions;
pub use tally::BuildProgress;

use std::fmt;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use self::build::{Layout, Tabulation, limit};
use self::columns::{BASE_MODES, Group};
use self::look_up::{Columns, ColumnsOfEach, shrink, shrink_of_each, shrink_slopes_of_each};
use self::parts::Place;
use crate::mobility::{
    Mobility, MobilityOfEach, MobilitySet, ModeMobility, PairMobility, SwirlMobilities,
};
use crate::{
    ActiveLoads, Gap, Hydrodynamics, LoadSet, ModelDescription, PairLoads, SceneError, SwirlLoads,
    are_unlike,
};

/// Gap at which the table changes from `ln eps` to `1/r`, in radii of the larger sphere.
pub const FAR_GAP: f64 = 2.0;

/// What a table's interpolation error was brought down to.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum TableLimit {
    /// The tolerance that was asked for.
    Tolerance(f64),
    /// The noise of the model, which is above the tolerance that was asked for.
    Noise(f64),
    /// Neither: pieces were halved as often as is allowed, and this error is left. The model is not smooth there.
    Missed(f64),
}

/// How a table was built.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TableSummary {
    /// What the interpolation error was brought down to.
    pub limit: TableLimit,
    /// Estimate of the largest interpolation error of a coefficient, relative to the larger of it and 1: the error of a velocity by
    /// unit slip, in units of the slip.
    pub interpolation_error: f64,
    /// Number of gaps at which the model was evaluated, each for a part of the balance.
    pub evaluations: usize,
}

/// The mobilities of a model tabulated over its whole range.
#[derive(Clone)]
pub struct Tabulated {
    model: Arc<dyn Hydrodynamics>,
    set: LoadSet,
    /// `ln eps` of the ends of the table.
    ends: [f64; 2],
    /// The stretches in `ln eps` and in `1/r`, by falling coordinate: near ones by falling gap, far ones by rising gap.
    near: Vec<Span>,
    far: Vec<Span>,
    columns: Columns,
    /// Those of unlike radii, where they are.
    of_each: ColumnsOfEach,
    /// Radius of sphere 2 over that of sphere 1.
    ratio: f64,
    /// Gap at which the coordinate of unlike radii changes.
    far_gap: f64,
    summary: TableSummary,
}

/// A stretch of the coordinate, `ln eps` or `1/r`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Span {
    low: f64,
    /// One over the length.
    scale: f64,
    index: usize,
    /// The first of the parts that most columns have, and the number of them.
    usual: (usize, u32),
}

impl fmt::Debug for Tabulated {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        (f.debug_struct("Tabulated"))
            .field("model", &self.model.fingerprint())
            .field("set", &self.set)
            .field("summary", &self.summary)
            .finish_non_exhaustive()
    }
}

impl Tabulated {
    /// From tabulations of all groups of the set.
    fn new(
        model: Arc<dyn Hydrodynamics>,
        options: &TableOptions,
        layout: &Layout,
        tabulations: Vec<(Group, Tabulation)>,
    ) -> Result<Self, SceneError> {
        let noise = model.description().noise;
        let error = (tabulations.iter()).fold(0.0, |most: f64, (_, t)| most.max(t.error));
        let summary = TableSummary {
            limit: limit(options, noise, error),
            interpolation_error: error,
            evaluations: tabulations.iter().map(|(_, t)| t.evaluations).sum(),
        };
        let usual: Vec<u32> = (layout.stretches.iter())
            .map(|stretch| 1 << stretch.least_parts())
            .collect();
        let (mut columns, mut of_each) = (Columns::default(), ColumnsOfEach::default());
        for (group, tabulation) in &tabulations {
            columns.take(*group, tabulation, &usual);
            of_each.take(*group, tabulation, &usual);
        }
        let (mut near, mut far, mut first) = (Vec::new(), Vec::new(), 0);
        for (index, (stretch, &count)) in layout.stretches.iter().zip(&usual).enumerate() {
            let spans = if stretch.far { &mut far } else { &mut near };
            spans.push(Span {
                low: stretch.low,
                // A little less, so that the upper end lies in the last part.
                scale: (1.0 - 1e-14) / (stretch.high - stretch.low),
                index,
                usual: (first, count),
            });
            first += count as usize;
        }
        for spans in [&mut near, &mut far] {
            spans.reverse();
        }
        // Rounding of exp(ln(eps)) must not leave out the ends themselves.
        let slack = 1e-12;
        Ok(Self {
            ratio: model.description().ratio,
            far_gap: layout.far_gap,
            model,
            set: LoadSet {
                modes: options.set.modes.max(BASE_MODES),
                ..options.set
            },
            ends: [
                layout.range.smallest.max(f64::MIN_POSITIVE).ln() - slack,
                layout.range.largest.ln() + slack,
            ],
            near,
            far,
            columns,
            of_each,
            summary,
        })
    }

    /// The model behind the table.
    pub fn model(&self) -> &dyn Hydrodynamics {
        self.model.as_ref()
    }

    /// The loads whose balance it holds.
    pub fn set(&self) -> LoadSet {
        self.set
    }

    /// How the table was built.
    pub fn summary(&self) -> TableSummary {
        self.summary
    }

    /// Where `gap` lies, which may be `far`, with the centres at `distance`; none outside the table, where the model has to answer or refuse.
    #[inline(always)]
    fn place(&self, gap: Gap, far: bool, distance: f64) -> Option<Place> {
        let (place, _) = self.place_with_scale(gap, far, distance)?;
        Some(place)
    }

    /// The same with one over the length of the stretch there.
    #[inline(always)]
    fn place_with_scale(&self, gap: Gap, far: bool, distance: f64) -> Option<(Place, f64)> {
        let x = gap.ln();
        // Not NaN.
        if !(x >= self.ends[0] && x <= self.ends[1]) {
            return None;
        }
        let (spans, x) = if far {
            (&self.far, 1.0 / distance)
        } else {
            (&self.near, x)
        };
        // From above: there is where encounters are.
        let span = spans.iter().find(|span| x >= span.low).or(spans.last())?;
        let place = Place::new(span.index, (x - span.low) * span.scale, span.usual);
        Some((place, span.scale))
    }

    /// The derivatives of all coefficients of equal radii at a place; none if one is not tabulated.
    fn read_slopes(
        &self,
        place: &Place<true>,
        set: MobilitySet,
        into: &mut Mobility,
    ) -> Option<()> {
        let Mobility { pair, modes, swirl } = into;
        let LoadSet {
            modes: n, swirl: m, ..
        } = set.loads;
        self.columns
            .read(place, set, pair, &mut modes[..n.max(BASE_MODES)])?;
        for (n, of_mode) in swirl.iter_mut().enumerate().take(m) {
            *of_mode = self.columns.swirl(place, n)?;
        }
        Some(())
    }

    /// What is tabulated at a place, which may be `far`, made into the coefficients at `gap`.
    #[inline(always)]
    fn read(
        &self,
        gap: Gap,
        (place, far): (&Place, bool),
        set: MobilitySet,
        (pair, modes): (&mut PairMobility, &mut [ModeMobility]),
    ) -> Result<(), SceneError> {
        if self.columns.read(place, set, pair, modes).is_none() {
            return Err(self.refused(set.loads));
        }
        if far {
            shrink(gap, gap.distance(), pair, modes);
        }
        Ok(())
    }

    /// By the model: the gap is not in the table.
    #[cold]
    fn beyond(
        &self,
        gap: Gap,
        set: MobilitySet,
        into: (&mut PairMobility, &mut [ModeMobility]),
    ) -> Result<(), SceneError> {
        self.model.interacting_mobility(gap, set, into)
    }

    /// Refuses a set that is not tabulated.
    #[cold]
    fn refused(&self, asked: LoadSet) -> SceneError {
        SceneError::LoadsNotHeld {
            asked,
            held: self.set,
        }
    }
}

impl Hydrodynamics for Tabulated {
    /// The model's, but for the noise, which is the interpolation error.
    fn description(&self) -> ModelDescription<'_> {
        ModelDescription {
            noise: self.summary.interpolation_error,
            ..self.model.description()
        }
    }

    fn fingerprint(&self) -> String {
        format!("table of {}", self.model.fingerprint())
    }

    /// The model's own.
    fn interacting_loads(&self, gap: Gap, set: LoadSet) -> Result<PairLoads, SceneError> {
        self.model.interacting_loads(gap, set)
    }

    /// The model's own.
    fn interacting_loads_with_swirl(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<(PairLoads, SwirlLoads), SceneError> {
        self.model.interacting_loads_with_swirl(gap, set)
    }

    fn interacting_mobility(
        &self,
        gap: Gap,
        set: MobilitySet,
        into: (&mut PairMobility, &mut [ModeMobility]),
    ) -> Result<(), SceneError> {
        let far = gap.eps() > FAR_GAP;
        match self.place(gap, far, gap.distance()) {
            Some(place) => self.read(gap, (&place, far), set, into),
            None => self.beyond(gap, set, into),
        }
    }

    fn interacting_mobility_with_swirl(
        &self,
        gap: Gap,
        set: MobilitySet,
        into: (&mut PairMobility, &mut [ModeMobility]),
        swirl: &mut SwirlMobilities,
    ) -> Result<(), SceneError> {
        let far = gap.eps() > FAR_GAP;
        let Some(place) = self.place(gap, far, gap.distance()) else {
            let model = &self.model;
            return model.interacting_mobility_with_swirl(gap, set, into, swirl);
        };
        self.read(gap, (&place, far), set, into)?;
        for (n, of_mode) in swirl.iter_mut().enumerate().take(set.loads.swirl) {
            let read = self.columns.swirl(&place, n);
            *of_mode = read.ok_or_else(|| self.refused(set.loads))?;
            if far {
                of_mode.across.turning /= gap.distance();
            }
        }
        Ok(())
    }

    /// The model's own.
    fn interacting_loads_of_each(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<[ActiveLoads; 2], SceneError> {
        self.model.interacting_loads_of_each(gap, set)
    }

    fn interacting_mobility_of_each(
        &self,
        gap: Gap,
        set: MobilitySet,
    ) -> Result<MobilityOfEach, SceneError> {
        if !are_unlike(self.ratio) {
            // Its columns are those of both together.
            return self.model.interacting_mobility_of_each(gap, set);
        }
        let far = gap.eps() > self.far_gap;
        let distance = gap.distance_at_ratio(self.ratio);
        let Some(place) = self.place(gap, far, distance) else {
            return self.model.interacting_mobility_of_each(gap, set);
        };
        let mobility = self.of_each.read(&place, set);
        let mut mobility = mobility.ok_or_else(|| self.refused(set.loads))?;
        if far {
            shrink_of_each(&mut mobility, set, gap, distance);
        }
        Ok(mobility)
    }

    fn interacting_mobility_with_slope(
        &self,
        gap: Gap,
        set: MobilitySet,
        into: [&mut MobilityOfEach; 2],
    ) -> Result<(), SceneError> {
        let far = gap.eps() > self.far_gap;
        let distance = gap.distance_at_ratio(self.ratio);
        let Some((place, scale)) = self.place_with_scale(gap, far, distance) else {
            return self.model.interacting_mobility_with_slope(gap, set, into);
        };
        // By ln eps: d(1/r) = -eps/r^2 d(ln eps).
        let by_coordinate = if far {
            -gap.eps() / (distance * distance)
        } else {
            1.0
        };
        let slopes = place.of_slopes(scale * by_coordinate);
        let [value, slope] = into;
        self.interacting_mobility_of_any(gap, set, value)?;
        if are_unlike(self.ratio) {
            let read = self.of_each.read(&slopes, set);
            *slope = read.ok_or_else(|| self.refused(set.loads))?;
        } else {
            self.read_slopes(&slopes, set, &mut slope.by[0])
                .ok_or_else(|| self.refused(set.loads))?;
            slope.take_out_of_sums(set);
        }
        if far {
            shrink_slopes_of_each(value, slope, set, gap, distance);
        }
        Ok(())
    }

    /// The model's own, of its loads.
    fn error_estimate(&self, gap: Gap, set: LoadSet) -> Result<Option<f64>, SceneError> {
        self.model.error_estimate(gap, set)
    }
}

#[cfg(test)]
mod kept_tests;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod unlike_tests;
