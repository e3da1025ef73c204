//! Families: scene files with parameters.

use scene::{Gravity, RunOptions, Scene};
use toml::de::DeTable;

use super::effects::{self, Hydrodynamics, RepulsionTemplate};
use super::mistakes::{Mistakes, Notes};
use super::number::{List, Reader};
use super::parameters::{self, Parameter};
use super::point::Point;
use super::run::{self, RunTemplate};
use super::scope::Scope;
use super::squirmers::{self, SquirmerTemplate};
use super::table::Table;

/// A scene for each value of some parameters: a scene file with a table `[parameters]`, read once.
///
/// `docs/SCENES.md` says what may stand in it. The hydrodynamic model may be left out; then it is chosen by whoever
/// runs the scenes.
///
/// ```
/// use compare::Family;
/// let text = "
/// [parameters]
/// dx = 1.0
/// [[squirmer]]
/// position = [\"-dx/2\", 5.0]
/// orientation = -90.0
/// beta = 5.0
/// [[squirmer]]
/// position = [\"dx/2\", -5.0]
/// orientation = 90.0
/// beta = 5.0";
/// let family = Family::parse(text)?;
/// let point = family.scene(&[("dx", 3.0)])?;
/// assert_eq!(point.scene.start[1].position.x, 1.5);
/// // A mistake says where it is and which numbers led to it.
/// let mistakes = family.scene(&[("dx", f64::INFINITY)]).unwrap_err();
/// assert_eq!(mistakes.to_string(), "3:6: parameters.dx: found dx = inf; give a finite number");
/// # Ok::<(), compare::Mistakes>(())
/// ```
#[derive(Clone, Debug)]
pub struct Family {
    text: String,
    parameters: Vec<Parameter>,
    defaults: Vec<f64>,
    hydrodynamics: Option<Hydrodynamics>,
    template: Template,
}

/// The scene of a family at one point, and how it is run.
#[derive(Clone, Debug, PartialEq)]
pub struct FamilyScene {
    /// Squirmers, start, repulsion and gravity.
    pub scene: Scene,
    /// End, stop rules, tolerance and samples.
    pub run: RunOptions,
}

/// A scene as it stands in the file, with expressions for numbers.
#[derive(Clone, Debug)]
struct Template {
    squirmers: Vec<SquirmerTemplate>,
    repulsion: Option<RepulsionTemplate>,
    gravity: Option<List>,
    run: RunTemplate,
}

impl Family {
    /// Reads a scene file, and makes its scene with the defaults of the parameters.
    ///
    /// # Errors
    /// Every mistake in the file and in that scene.
    pub fn parse(text: &str) -> Result<Self, Mistakes> {
        Self::read(text, false).map(|(family, _)| family)
    }

    /// A family, which has to name the hydrodynamic model if it is `needed`, and its scene at the defaults.
    pub(super) fn read(text: &str, needed: bool) -> Result<(Self, FamilyScene), Mistakes> {
        let mut reader = Reader {
            notes: Notes::new(text),
            scope: Scope::default(),
        };
        let (table, errors) = DeTable::parse_recoverable(text);
        for error in &errors {
            reader.notes.not_toml(error.span(), error.message());
        }
        let mut file = Table::new("", 0..0, table.get_ref());
        let parameters = parameters::read(&mut file, &mut reader);
        let template = Template {
            squirmers: squirmers::read(&mut file, &mut reader),
            repulsion: effects::repulsion(&mut file, &mut reader),
            gravity: effects::gravity(&mut file, &mut reader),
            run: run::read(&mut file, &mut reader),
        };
        let hydrodynamics = effects::hydrodynamics(&mut file, needed, &mut reader);
        file.finish(&mut reader);
        let Reader { mut notes, scope } = reader;
        // A parameter may be misspelt where it is read.
        if notes.is_empty() {
            parameters::note_unread(&parameters, &scope, &mut notes);
        }
        let mut point = Point::new(notes, &parameters, &[]);
        let scene = template.at(hydrodynamics, &mut point);
        let defaults = point.parameters().to_vec();
        let scene = point.finish(scene)?;
        let family = Self {
            text: text.to_owned(),
            parameters,
            defaults,
            hydrodynamics,
            template,
        };
        Ok((family, scene))
    }

    /// The text of the file.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The parameters with their defaults, in the order of the file.
    pub fn parameters(&self) -> impl Iterator<Item = (&str, f64)> {
        let names = self.parameters.iter().map(|known| known.name.as_str());
        names.zip(self.defaults.iter().copied())
    }

    /// The hydrodynamic model, if the file names one.
    #[must_use]
    pub fn hydrodynamics(&self) -> Option<Hydrodynamics> {
        self.hydrodynamics
    }

    /// Whether the file gives a squirmer a radius, so that scenes may have unlike ones.
    pub(crate) fn has_radii(&self) -> bool {
        (self.template.squirmers.iter()).any(|squirmer| squirmer.radius().is_some())
    }

    /// The family under a hydrodynamic model: starts and repulsion that the model has no answer for are mistakes.
    #[must_use]
    pub fn under(self, hydrodynamics: Hydrodynamics) -> Self {
        Self {
            hydrodynamics: Some(hydrodynamics),
            ..self
        }
    }

    /// The scene at given values of some parameters. The others have their defaults, which follow where they are
    /// expressions. Of two values of one parameter the later one holds.
    ///
    /// # Errors
    /// Every number in the file that is not allowed with these values, a start that is not, and names that are no
    /// parameters.
    pub fn scene(&self, values: &[(&str, f64)]) -> Result<FamilyScene, Mistakes> {
        let mut point = Point::new(Notes::new(&self.text), &self.parameters, values);
        let scene = self.template.at(self.hydrodynamics, &mut point);
        point.finish(scene)
    }
}

impl Template {
    /// The scene at a point; none if there are mistakes, which are noted.
    fn at(
        &self,
        hydrodynamics: Option<Hydrodynamics>,
        point: &mut Point<'_>,
    ) -> Option<FamilyScene> {
        let mut squirmers = self.squirmers.iter().map(|squirmer| squirmer.at(point));
        let (one, two) = (squirmers.next(), squirmers.next());
        squirmers.for_each(drop);
        let repulsion = self.repulsion.as_ref();
        let repulsion = repulsion.and_then(|repulsion| repulsion.at(point));
        let gravity = self.gravity.as_ref();
        let gravity: Option<Gravity> =
            gravity.and_then(|direction| effects::gravity_at(direction, point));
        let run = self.run.at(point);
        let ((body1, pose1), (body2, pose2)) = (one??, two??);
        if let (Err(error), Some(first)) = (body1.check_first(), self.squirmers.first()) {
            // A radius that is not 1 was given.
            let radius = first.radius()?;
            point.wrong(radius.span.clone(), &radius.key, &error.to_string());
            return None;
        }
        if let (Some(given), Some(repulsion), Some(model)) =
            (&self.repulsion, repulsion, hydrodynamics)
        {
            let smaller = body1.radius().min(body2.radius());
            given.check_reach(model, repulsion, smaller, point)?;
        }
        let scene = Scene::new([body1, body2], [pose1, pose2], repulsion, gravity)
            .map_err(|error| error.to_string())
            .and_then(|scene| {
                hydrodynamics.map_or(Ok(()), |model| model.check_start(&scene))?;
                Ok(scene)
            });
        // What is left to be wrong are the positions: the spheres overlap, or are too near for the model or too far
        // apart.
        let second = self.squirmers.get(1)?.position.as_ref()?;
        let scene = point.accept(scene, &second.span, &second.key)?;
        Some(FamilyScene { scene, run })
    }
}

#[cfg(test)]
mod tests;
