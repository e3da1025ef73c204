//! The hydrodynamic models, by their names on the command line.

use std::cmp::Ordering;
use std::fmt;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use bem::Bem;
use exact::Exact;
use scene::{Fluid, Gap, Hydrodynamics, SceneError};
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::{CompareError, ModelOptions};

/// A hydrodynamic model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Method {
    /// Lubrication theory as published.
    Lt,
    /// Lubrication theory with the corrected coefficient (3) of the axial squirming force.
    LtCorrected,
    /// Bispherical series, accurate to about ten digits: the reference.
    Exact,
    /// Boundary elements.
    Bem,
    /// No hydrodynamic interaction. Only scene files can name it.
    Isolated,
    /// A model from outside this workspace, see [`Method::register`].
    Other(OtherModel),
}

/// A model from outside this workspace. It is kept until the process ends.
#[derive(Clone, Copy)]
pub struct OtherModel(&'static Registered);

struct Registered {
    name: &'static str,
    /// Number among the models from outside, from 0.
    number: usize,
    model: Arc<dyn Hydrodynamics>,
    /// Whether it takes so long for each gap that it is to be tabulated.
    is_dear: bool,
}

/// The models from outside, in the order in which they were registered.
static OTHERS: Mutex<Vec<OtherModel>> = Mutex::new(Vec::new());

impl OtherModel {
    /// The model itself.
    pub(crate) fn hydrodynamics(self) -> &'static dyn Hydrodynamics {
        self.0.model.as_ref()
    }

    /// The same, to be tabulated, if it is dear.
    pub(crate) fn dear(self) -> Option<Arc<dyn Hydrodynamics>> {
        self.0.is_dear.then(|| Arc::clone(&self.0.model))
    }
}

impl PartialEq for OtherModel {
    fn eq(&self, other: &Self) -> bool {
        self.0.number == other.0.number
    }
}

impl Eq for OtherModel {}

impl PartialOrd for OtherModel {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for OtherModel {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.number.cmp(&other.0.number)
    }
}

impl fmt::Debug for OtherModel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("OtherModel").field(&self.0.name).finish()
    }
}

impl Method {
    /// The methods of this workspace that the command line accepts.
    pub const ALL: [Self; 4] = [Self::Lt, Self::LtCorrected, Self::Exact, Self::Bem];

    /// The methods that a command runs by default.
    pub const DEFAULT: [Self; 3] = [Self::Lt, Self::Exact, Self::Bem];

    /// Makes a model from outside this workspace a method, under a name that stands in tables and pictures. The model
    /// is kept until the process ends.
    ///
    /// # Errors
    /// [`CompareError::Input`] for a name that is taken, and for one that is not made of letters, digits, `-`, `_` and
    /// `.` only.
    ///
    /// ```
    /// use compare::{Method, Model, ModelOptions};
    ///
    /// let method = Method::register("lone", Box::new(scene::Isolated::EQUAL))?;
    /// assert_eq!(Method::named("lone"), Some(method));
    /// assert!(Method::register("exact", Box::new(scene::Isolated::EQUAL)).is_err());
    /// let model = Model::set_up(method, &ModelOptions::default())?;
    /// assert_eq!(model.method().name(), "lone");
    /// # Ok::<(), compare::CompareError>(())
    /// ```
    pub fn register(name: &str, model: Box<dyn Hydrodynamics>) -> Result<Self, CompareError> {
        Self::registered(name, model.into(), false)
    }

    /// As [`Self::register`]; the name may be that of an earlier model from outside, which is named no longer. Whoever holds its method can go on with it. A
    /// model that `is_dear` takes so long for each gap that it is tabulated before it moves pairs, by one thread, which says what it is about to ask for
    /// ([`Hydrodynamics::foresee`]).
    ///
    /// # Errors
    /// [`CompareError::Input`] for a name of this workspace's models, and for one that is not allowed.
    pub fn replace(
        name: &str,
        model: Arc<dyn Hydrodynamics>,
        is_dear: bool,
    ) -> Result<Self, CompareError> {
        Self::check_letters(name)?;
        Self::check_ours(name)?;
        let mut others = OTHERS.lock().unwrap_or_else(PoisonError::into_inner);
        Ok(Self::pushed(&mut others, name, model, is_dear))
    }

    /// Refuses a name that is none for a model from outside.
    ///
    /// # Errors
    /// As [`Self::register`].
    pub fn check(name: &str) -> Result<(), CompareError> {
        Self::others_without(name).map(drop)
    }

    /// Refuses a name of letters that are not allowed.
    fn check_letters(name: &str) -> Result<(), CompareError> {
        let is_part = |c: char| c.is_alphanumeric() || "-_.".contains(c);
        if name.is_empty() || name.len() > MOST_LETTERS || !name.chars().all(is_part) {
            let allowed = format!(
                "a name has 1 to {MOST_LETTERS} letters, digits or the signs - _ . and nothing else"
            );
            return Err(CompareError::input("--method", name, allowed));
        }
        if name.parse::<f64>().is_ok() {
            // Whoever reads a column of such names takes them for numbers.
            let allowed = "a name is a word, and this is a number";
            return Err(CompareError::input("--method", name, allowed));
        }
        Ok(())
    }

    fn taken(name: &str) -> CompareError {
        let allowed = "a model has this name already: give another one";
        CompareError::input("--method", name, allowed)
    }

    /// Refuses the name of a model of this workspace.
    fn check_ours(name: &str) -> Result<(), CompareError> {
        let mut of_ours = (Self::ALL.iter()).chain(std::iter::once(&Self::Isolated));
        if of_ours.any(|method| method.name() == name) {
            return Err(Self::taken(name));
        }
        Ok(())
    }

    /// The models from outside, none of which has this name.
    fn others_without(name: &str) -> Result<MutexGuard<'static, Vec<OtherModel>>, CompareError> {
        Self::check_letters(name)?;
        Self::check_ours(name)?;
        let others = OTHERS.lock().unwrap_or_else(PoisonError::into_inner);
        if others.iter().any(|other| other.0.name == name) {
            return Err(Self::taken(name));
        }
        Ok(others)
    }

    /// The same for a model that may take so long for each gap that it `is_dear`: it is tabulated before it moves pairs.
    pub(crate) fn registered(
        name: &str,
        model: Arc<dyn Hydrodynamics>,
        is_dear: bool,
    ) -> Result<Self, CompareError> {
        let mut others = Self::others_without(name)?;
        Ok(Self::pushed(&mut others, name, model, is_dear))
    }

    /// The method of one more model from outside.
    fn pushed(
        others: &mut Vec<OtherModel>,
        name: &str,
        model: Arc<dyn Hydrodynamics>,
        is_dear: bool,
    ) -> Self {
        let other = OtherModel(Box::leak(Box::new(Registered {
            name: Box::leak(name.to_owned().into_boxed_str()),
            number: others.len(),
            model,
            is_dear,
        })));
        others.push(other);
        Self::Other(other)
    }

    /// The method with this name on the command line and in tables, if it can be compared.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let of_ours = Self::ALL.into_iter().find(|method| method.name() == name);
        of_ours.or_else(|| {
            let others = OTHERS.lock().unwrap_or_else(PoisonError::into_inner);
            // Of models that have replaced each other the last one.
            let other = others.iter().rev().find(|other| other.0.name == name);
            other.map(|&other| Self::Other(other))
        })
    }

    /// Name on the command line and in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Lt => "lt",
            Self::LtCorrected => "lt-corrected",
            Self::Exact => "exact",
            Self::Bem => "bem",
            Self::Isolated => "none",
            Self::Other(OtherModel(other)) => other.name,
        }
    }

    /// The model of this name as one that knows the flow, for spheres whose radii are in the given `ratio`; boundary elements of the mesh of
    /// `options`.
    ///
    /// # Errors
    /// [`CompareError::Input`] for a model that knows loads only; as [`crate::Model::set_up`] for radii and meshes that are not allowed.
    pub fn fluid(self, options: &ModelOptions, ratio: f64) -> Result<Box<dyn Fluid>, CompareError> {
        let reason = match self {
            Self::Exact => {
                return Ok(Box::new(Exact::of_ratio(ratio).map_err(SceneError::from)?));
            }
            Self::Bem => return Ok(Box::new(Bem::of_ratio(options.mesh, ratio)?)),
            Self::Lt | Self::LtCorrected => {
                "lubrication theory has no stresslet beyond its singular parts; it knows loads, no flow: give exact or bem"
            }
            Self::Isolated => {
                "without interaction there is no flow about a pair: give exact or bem"
            }
            Self::Other(_) => "a model from outside knows loads, no flow: give exact or bem",
        };
        Err(CompareError::input("method", self, reason))
    }

    /// Refuses a gap outside the model's range, of spheres whose radii are in the given `ratio`. Boundary elements of level `mesh` have a
    /// smallest gap.
    ///
    /// # Errors
    /// [`CompareError::Bem`] with the level that resolves the gap, or if `mesh` is not a level;
    /// [`CompareError::Scene`] for a gap outside the range of a model from outside.
    pub fn check_gap(self, mesh: usize, ratio: f64, gap: Gap) -> Result<(), CompareError> {
        match self {
            Self::Bem => Ok(Bem::of_ratio(mesh, ratio)?.check(gap)?),
            Self::Other(other) => Ok(other.hydrodynamics().range().check(gap)?),
            Self::Lt | Self::LtCorrected | Self::Exact | Self::Isolated => Ok(()),
        }
    }

    /// Largest gap at which the model has loads.
    #[must_use]
    pub fn largest_gap(self) -> f64 {
        match self {
            Self::Other(other) => other.hydrodynamics().range().largest,
            _ => f64::INFINITY,
        }
    }

    /// Name of the model in pictures.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Self::Lt => "Lubrication theory",
            Self::LtCorrected => "Lubrication theory, corrected",
            Self::Exact => "Exact hydrodynamics",
            Self::Bem => "Boundary elements",
            Self::Isolated => "No hydrodynamic interaction",
            Self::Other(OtherModel(other)) => other.name,
        }
    }

    /// Name of the model within a sentence.
    #[must_use]
    pub fn in_sentence(self) -> &'static str {
        match self {
            Self::Lt => "lubrication theory",
            Self::LtCorrected => "corrected lubrication theory",
            Self::Exact => "exact hydrodynamics",
            Self::Bem => "boundary elements",
            Self::Isolated => "no interaction",
            Self::Other(OtherModel(other)) => other.name,
        }
    }

    /// Place in the order of all methods, for colours and line styles.
    #[must_use]
    pub fn place(self) -> usize {
        match self {
            Self::Lt => 0,
            Self::LtCorrected => 1,
            Self::Exact => 2,
            Self::Bem => 3,
            Self::Isolated => 4,
            Self::Other(OtherModel(other)) => 5 + other.number,
        }
    }
}

/// Largest number of letters in the name of a model from outside.
const MOST_LETTERS: usize = 40;

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// As its name.
impl Serialize for Method {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.serialize_str(self.name())
    }
}

/// From its name.
impl<'de> Deserialize<'de> for Method {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let name = String::deserialize(from)?;
        Self::named(&name).ok_or_else(|| D::Error::custom(format!("'{name}' is not a method")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_that_is_replaced_names_the_last_model_and_the_first_can_still_be_used() {
        let of_ratio =
            |ratio| -> Arc<dyn Hydrodynamics> { Arc::new(scene::Isolated::of_ratio(ratio)) };
        let first = Method::replace("replaced", of_ratio(1.0), false).unwrap();
        let last = Method::replace("replaced", of_ratio(0.5), false).unwrap();
        assert_ne!(first, last);
        assert_eq!(Method::named("replaced"), Some(last));
        let has_unlike_radii = |method| match method {
            Method::Other(other) => Some(other.hydrodynamics().has_unlike_radii()),
            _ => None,
        };
        assert_eq!(
            [first, last].map(has_unlike_radii),
            [Some(false), Some(true)]
        );
        assert!(Method::register("replaced", Box::new(scene::Isolated::EQUAL)).is_err());
        for refused in ["exact", "none", "", "a b", "nan", "1e5"] {
            assert!(
                Method::replace(refused, of_ratio(1.0), false).is_err(),
                "{refused}"
            );
        }
    }
}
