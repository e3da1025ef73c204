//! Hydrodynamics, repulsion and gravity of a scene file.

use std::ops::Range;

use bem::Bem;
use scene::{Gap, Gravity, Repulsion, Scene};
use toml::de::DeValue;

use super::number::{List, Number, Reader, Rule};
use super::point::Point;
use super::table::{Table, word};
use crate::Method;
use crate::numbers::written;

/// The hydrodynamic model of a scene, and how it is set up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Hydrodynamics {
    /// The method.
    pub method: Method,
    /// Refinement level of boundary elements, if they run.
    pub mesh: usize,
    /// Whether every load is solved for, instead of read from a table.
    pub direct: bool,
}

impl From<Method> for Hydrodynamics {
    fn from(method: Method) -> Self {
        Self {
            method,
            mesh: Bem::DEFAULT_LEVEL,
            direct: false,
        }
    }
}

/// Names in a scene file; lubrication theory has two forms.
const METHODS: [(&str, Method); 4] = [
    (Method::Isolated.name(), Method::Isolated),
    ("lubrication", Method::Lt),
    (Method::Exact.name(), Method::Exact),
    (Method::Bem.name(), Method::Bem),
];

const FORMS: [(&str, Method); 2] = [
    ("published", Method::Lt),
    ("corrected", Method::LtCorrected),
];

const NEEDED: &str = "give \"none\", \"lubrication\", \"exact\" or \"bem\"";

/// `hydrodynamics`: a word or a table; none if it is left out, which is a mistake if it is `needed`.
pub(super) fn hydrodynamics(
    file: &mut Table<'_, '_>,
    needed: bool,
    reader: &mut Reader<'_>,
) -> Option<Hydrodynamics> {
    let Some(entry) = file.get("hydrodynamics") else {
        if needed {
            (reader.notes).missing(file.span(), "hydrodynamics", NEEDED);
        }
        return None;
    };
    let DeValue::Table(inner) = entry.value else {
        let otherwise = " or a table [hydrodynamics]";
        return word(&entry, reader, &METHODS, otherwise).map(Hydrodynamics::from);
    };
    let before = reader.notes.count();
    let mut table = Table::new(&entry.key, entry.span, inner);
    let method = table.word("model", reader, &METHODS);
    if method.is_none() && reader.notes.count() == before {
        (reader.notes).missing(table.span(), &table.key("model"), NEEDED);
    }
    let mut chosen = Hydrodynamics::from(method.unwrap_or(Method::Isolated));
    // Only keys of the model are known; without one, all are.
    let of = |models: &[Method]| method.is_none_or(|method| models.contains(&method));
    if of(&[Method::Lt]) {
        chosen.method = table.word("form", reader, &FORMS).unwrap_or(chosen.method);
    }
    if of(&[Method::Bem]) {
        let (lowest, highest) = Bem::LEVELS;
        let level = table.whole("level", reader, lowest..=highest);
        chosen.mesh = level.unwrap_or(chosen.mesh);
    }
    if of(&[Method::Exact, Method::Bem]) {
        chosen.direct = table.flag("direct", reader).unwrap_or(false);
    }
    table.finish(reader);
    (reader.notes.count() == before).then_some(chosen)
}

/// Force of repulsion, per `pi mu a`, that free flight beyond the cut of lubrication theory may leave out.
const NEGLIGIBLE_FORCE: f64 = 1e-12;

impl Hydrodynamics {
    /// Lubrication theory flies freely beyond its cut, in radii of the `smaller` squirmer: repulsion must have died out there.
    fn check_reach(&self, repulsion: Repulsion, smaller: f64) -> Result<(), String> {
        let lubrication = matches!(self.method, Method::Lt | Method::LtCorrected);
        let cut = lt::CUTOFF * smaller;
        if lubrication && repulsion.force(Gap::from_ln(cut.ln())) > NEGLIGIBLE_FORCE {
            return Err(format!(
                "lubrication theory ends at a gap of {}: choose kappa2 so large that the repulsion has died out \
                 there, or other hydrodynamics",
                written(cut)
            ));
        }
        Ok(())
    }

    /// Refuses a start at which the model has no answer.
    pub(super) fn check_start(&self, scene: &Scene) -> Result<(), String> {
        let gap = scene.gap().map_err(|error| error.to_string())?;
        (self.method.check_gap(self.mesh, scene.ratio(), gap))
            .map_err(|error| format!("the start is too near: {error}"))
    }
}

/// Repulsion as it stands in the file, and where.
#[derive(Clone, Debug)]
pub(super) struct RepulsionTemplate {
    span: Range<usize>,
    kappa1: Option<Number>,
    kappa2: Option<Number>,
}

const POSITIVE: Rule = Rule {
    allowed: || "a number greater than 0".to_owned(),
    holds: |value| value > 0.0,
};

/// `repulsion`: none unless there is a word or a table.
pub(super) fn repulsion(
    file: &mut Table<'_, '_>,
    reader: &mut Reader<'_>,
) -> Option<RepulsionTemplate> {
    let entry = file.get("repulsion")?;
    let mut template = RepulsionTemplate {
        span: entry.span.clone(),
        kappa1: None,
        kappa2: None,
    };
    let DeValue::Table(inner) = entry.value else {
        let words = [("paper", true), ("off", false)];
        let is_on = word(&entry, reader, &words, " or a table [repulsion]");
        return (is_on == Some(true)).then_some(template);
    };
    let mut table = Table::new(&entry.key, entry.span, inner);
    template.kappa1 = table.number("kappa1", reader, &POSITIVE);
    template.kappa2 = table.number("kappa2", reader, &POSITIVE);
    table.finish(reader);
    Some(template)
}

impl RepulsionTemplate {
    /// The repulsion at a point.
    pub(super) fn at(&self, point: &mut Point<'_>) -> Option<Repulsion> {
        let mut kappa = |number: &Option<Number>, otherwise| match number {
            Some(number) => point.value(number),
            None => Some(otherwise),
        };
        let kappa1 = kappa(&self.kappa1, Repulsion::PAPER.kappa1());
        let kappa2 = kappa(&self.kappa2, Repulsion::PAPER.kappa2());
        let repulsion = Repulsion::new(kappa1?, kappa2?);
        point.accept(repulsion, &self.span, "repulsion")
    }

    /// Refuses a repulsion that the model cannot have between squirmers of which the smaller one has the radius `smaller`.
    pub(super) fn check_reach(
        &self,
        model: Hydrodynamics,
        repulsion: Repulsion,
        smaller: f64,
        point: &mut Point<'_>,
    ) -> Option<()> {
        let reach = model.check_reach(repulsion, smaller);
        point.accept(reach, &self.span, "repulsion")
    }
}

/// `[gravity]`: its direction; none unless it is there.
pub(super) fn gravity(file: &mut Table<'_, '_>, reader: &mut Reader<'_>) -> Option<List> {
    let mut table = file.table("gravity", reader)?;
    let direction = table.numbers("direction", reader, 2..=3);
    if direction.is_none() {
        let allowed = "give the vector along which gravity pulls, such as [0, -1]";
        (reader.notes).missing(table.span(), &table.key("direction"), allowed);
    }
    table.finish(reader);
    direction
}

/// The gravity along a direction.
pub(super) fn gravity_at(direction: &List, point: &mut Point<'_>) -> Option<Gravity> {
    let gravity = Gravity::new(point.vector(direction)?);
    point.accept(gravity, &direction.span, &direction.key)
}
