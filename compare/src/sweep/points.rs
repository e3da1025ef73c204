//! The points of a sweep: a family and the parameters that are varied.

use scene::{LoadSet, RunOptions};

use super::Axis;
use super::SweepTail;
use crate::columns::{self, Columns as _};
use crate::{CompareError, Family, Numbers, Reads};

/// Largest number of points of a sweep.
const MOST_POINTS: usize = 1 << 40;

/// Largest number of points for which every point is checked for the loads that it reads.
const LOOKED_UP: usize = 10_000;

/// Largest number of points that are checked for the ratio of their radii.
const MOST_RATIOS: usize = 10_000_000;

/// The points of a sweep: a family and the parameters that are varied. The last parameter varies fastest.
#[derive(Clone, Debug)]
pub struct Points {
    family: Family,
    axes: Vec<Axis>,
    run: RunChoices,
}

/// Options of the runs that replace those of the family's file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunChoices {
    /// Tolerance of the integrator; `None` uses the tolerance of the family's file.
    pub tolerance: Option<f64>,
    /// Distance of the centres at which angles are read, in radii.
    pub angles_at: f64,
}

impl Points {
    /// Varies parameters of a family. Each list of values is one axis; the first axis is the outer loop.
    ///
    /// # Errors
    /// [`CompareError::Input`] for a name that is not a parameter, for a parameter that is given twice, and for too
    /// many points.
    pub fn new(
        family: Family,
        vary: &[(String, Numbers)],
        run: RunChoices,
    ) -> Result<Self, CompareError> {
        let known: Vec<&str> = family.parameters().map(|(name, _)| name).collect();
        let columns = columns::names(SweepTail::COLUMNS);
        let mut axes: Vec<Axis> = Vec::new();
        for (name, Numbers(values)) in vary {
            if !known.contains(&name.as_str()) {
                let allowed = if known.is_empty() {
                    "the family has no parameters".to_owned()
                } else {
                    format!("the family has the parameters {}", known.join(", "))
                };
                return Err(CompareError::input("--vary", name, allowed));
            }
            if columns.contains(&name.as_str()) {
                let allowed = format!(
                    "columns of every sweep have these names: {}; give the parameter another one",
                    columns.join(", ")
                );
                return Err(CompareError::input("--vary", name, allowed));
            }
            if axes.iter().any(|axis| axis.name == *name) {
                let allowed = "it is varied twice: give one list";
                return Err(CompareError::input("--vary", name, allowed));
            }
            axes.push(Axis {
                name: name.clone(),
                values: values.clone(),
            });
        }
        let points = (axes.iter()).try_fold(1_usize, |points, axis| {
            points.checked_mul(axis.values.len())
        });
        if points.is_none_or(|points| points > MOST_POINTS) {
            let allowed = format!("a sweep has at most {MOST_POINTS} points");
            return Err(CompareError::input("--vary", "so many values", allowed));
        }
        Ok(Self { family, axes, run })
    }

    /// Number of points.
    #[must_use]
    pub fn count(&self) -> usize {
        self.axes.iter().map(|axis| axis.values.len()).product()
    }

    /// The axes; the first one is the outer loop.
    #[must_use]
    pub fn axes(&self) -> &[Axis] {
        &self.axes
    }

    /// The family.
    #[must_use]
    pub fn family(&self) -> &Family {
        &self.family
    }

    /// Options of the runs that replace those of the family's file.
    #[must_use]
    pub fn choices(&self) -> RunChoices {
        self.run
    }

    /// The values of the parameters at point `number`, axis by axis.
    pub(crate) fn values(&self, point: usize) -> Vec<(&str, f64)> {
        let mut rest = point;
        let mut values: Vec<_> = (self.axes.iter().rev())
            .map(|axis| {
                let place = rest % axis.values.len();
                rest /= axis.values.len();
                (axis.name.as_str(), axis.values[place])
            })
            .collect();
        values.reverse();
        values
    }

    /// Numbers of typical points: each value of each axis, with the first and with the last values of the other axes.
    fn typical(&self) -> Vec<usize> {
        let last = self.count() - 1;
        let mut stride = self.count();
        let mut numbers = vec![0, last];
        for axis in &self.axes {
            stride /= axis.values.len();
            for place in 0..axis.values.len() {
                let end = axis.values.len() - 1;
                numbers.extend([place * stride, last - (end - place) * stride]);
            }
        }
        numbers.sort_unstable();
        numbers.dedup();
        numbers
    }

    /// The loads that the motion reads at all points, and all ratios of radii. For very many points, only typical points are checked, and the
    /// loads of a pair without symmetry are added.
    ///
    /// # Errors
    /// [`CompareError::FamilyPoint`] for a point whose scene is not valid; [`CompareError::Scene`].
    pub fn reads(&self) -> Result<Reads, CompareError> {
        let count = self.count();
        let numbers = if count <= LOOKED_UP {
            (0..count).collect()
        } else {
            self.typical()
        };
        let mut read = Reads::default();
        for number in numbers {
            let values = self.values(number);
            let point = (self.family.scene(&values)).map_err(CompareError::FamilyPoint)?;
            read.add(&point.scene)?;
        }
        if count > LOOKED_UP {
            read.loads = read.loads.map(|read| LoadSet {
                twist: read.twist,
                swirl: read.swirl,
                ..LoadSet::planar(read.modes)
            });
            // A ratio of radii that no model is set up for would be a run without a result.
            if self.family.has_radii() {
                for number in 0..count.min(MOST_RATIOS) {
                    if let Ok(point) = self.family.scene(&self.values(number)) {
                        read.add_ratio(point.scene.ratio());
                    }
                }
            }
        }
        Ok(read)
    }

    /// Options of the run of a point, from the options of its file.
    pub(crate) fn options(&self, file: RunOptions) -> RunOptions {
        RunOptions {
            sample_interval: None,
            tolerance: self.run.tolerance.unwrap_or(file.tolerance),
            angles_at: self.run.angles_at,
            ..file
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FAMILY: &str = "
        [parameters]
        x = 3.0
        y = 0.0
        beta = 1.0
        [[squirmer]]
        position = [0, 0]
        orientation = 90
        beta = \"beta\"
        [[squirmer]]
        position = [\"x\", \"y\"]
        orientation = 90
        beta = \"beta\"";

    const AS_IN_FILE: RunChoices = RunChoices {
        tolerance: None,
        angles_at: f64::INFINITY,
    };

    fn points(vary: &[(&str, &[f64])]) -> Result<Points, CompareError> {
        let vary: Vec<_> = (vary.iter())
            .map(|(name, values)| ((*name).to_owned(), Numbers(values.to_vec())))
            .collect();
        Points::new(Family::parse(FAMILY).unwrap(), &vary, AS_IN_FILE)
    }

    #[test]
    fn the_last_axis_runs_fastest() {
        let points = points(&[("x", &[3.0, 4.0]), ("y", &[0.0, 1.0, 2.0])]).unwrap();
        assert_eq!(points.count(), 6);
        let found: Vec<_> = (0..6).map(|point| points.values(point)).collect();
        assert_eq!(found[1], [("x", 3.0), ("y", 1.0)]);
        assert_eq!(found[3], [("x", 4.0), ("y", 0.0)]);
        assert_eq!(found[5], [("x", 4.0), ("y", 2.0)]);
    }

    #[test]
    fn typical_points_have_every_value_of_every_axis_at_both_ends_of_the_others() {
        let points = points(&[
            ("beta", &[-1.0, 0.0, 1.0]),
            ("x", &[3.0, 4.0]),
            ("y", &[0.0, 1.0, 2.0, 3.0]),
        ]);
        let points = points.unwrap();
        let typical: Vec<Vec<f64>> = (points.typical().into_iter())
            .map(|number| {
                points
                    .values(number)
                    .iter()
                    .map(|(_, value)| *value)
                    .collect()
            })
            .collect();
        for expected in [
            [0.0, 3.0, 0.0],
            [0.0, 4.0, 3.0],
            [-1.0, 3.0, 2.0],
            [1.0, 4.0, 1.0],
            [1.0, 3.0, 3.0],
        ] {
            assert!(
                typical.contains(&expected.to_vec()),
                "{expected:?} in {typical:?}"
            );
        }
    }

    #[test]
    fn a_sweep_reads_the_loads_of_all_its_points() {
        // Two equal squirmers side by side are their own mirror image; one above the other they are not.
        let read = |axes: &[(&str, &[f64])]| points(axes).unwrap().reads().unwrap().loads.unwrap();
        let alone = read(&[]);
        let both = read(&[("y", &[0.0, 1.0])]);
        assert_ne!(alone, both);
        assert!(both.holds(alone));
        let many: Vec<f64> = (0..200).map(|i| f64::from(i) / 200.0).collect();
        let far: Vec<f64> = (0..200).map(|i| 3.0 + f64::from(i) / 200.0).collect();
        let axes: [(&str, &[f64]); 2] = [("y", &many), ("x", &far)];
        assert!(points(&axes).unwrap().count() > LOOKED_UP);
        assert!(read(&axes).holds(both));
    }

    #[test]
    fn a_sweep_sets_models_up_for_all_its_radii() {
        let family = format!("{FAMILY}\nradius = \"lambda\"").replacen(
            "[parameters]",
            "[parameters]\nlambda = 1.0",
            1,
        );
        let reads = |radii: &[f64], others: usize| {
            let others: Vec<f64> = (0..others).map(|i| f64::from(i as u32)).collect();
            let vary = [("beta", others), ("lambda", radii.to_vec())];
            let vary = vary.map(|(name, values)| (name.to_owned(), Numbers(values)));
            let points = Points::new(Family::parse(&family).unwrap(), &vary, AS_IN_FILE);
            points.unwrap().reads().unwrap().ratios
        };
        assert_eq!(reads(&[0.5, 1.0, 1.5], 2), [0.5, 1.0, 1.5]);
        // Too many points to look at each for its loads.
        let many: Vec<f64> = (0..150).map(|i| 0.1 + 0.01 * f64::from(i)).collect();
        assert_eq!(reads(&many, 100), many);
    }

    #[test]
    fn names_that_are_no_parameters_or_are_there_twice_are_refused() {
        let error = points(&[("z", &[1.0])]).unwrap_err().to_string();
        assert!(
            error.contains("'z'") && error.contains("x, y, beta"),
            "{error}"
        );
        let error = points(&[("x", &[3.0]), ("x", &[4.0])]).unwrap_err();
        assert!(error.to_string().contains("twice"), "{error}");
        let family = Family::parse(&FAMILY.replace("y", "tau")).unwrap();
        let vary = [("tau".to_owned(), Numbers(vec![1.0]))];
        let error = Points::new(family, &vary, AS_IN_FILE).unwrap_err();
        assert!(error.to_string().contains("another"), "{error}");
    }

    #[test]
    fn a_point_that_is_no_scene_is_named_before_anything_runs() {
        let points = points(&[("x", &[1.5, 3.0])]).unwrap();
        let error = points.reads().unwrap_err();
        assert!(matches!(error, CompareError::FamilyPoint(_)));
        assert!(error.to_string().contains("x = 1.5"), "{error}");
    }
}
