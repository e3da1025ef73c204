//! The two squirmers of a scene file.

use std::ops::Range;

use scene::{MAX_MODES, Orientation, Pose, SceneError, Squirmer};
use toml::de::DeValue;

use super::number::{FINITE, List, Number, Reader, Rule};
use super::point::Point;
use super::table::{Table, numbers};

/// A squirmer as it stands in the file. What is missing is noted.
#[derive(Clone, Debug)]
pub(super) struct SquirmerTemplate {
    pub position: Option<List>,
    orientation: Option<Direction>,
    body: Body,
}

/// How an orientation is given.
#[derive(Clone, Debug)]
enum Direction {
    Degrees(Number),
    Radians(Number),
    Vector(List),
}

/// Slip, bottom-heaviness and radius, and where they stand.
#[derive(Clone, Debug)]
struct Body {
    span: Range<usize>,
    key: String,
    slip: Option<Slip>,
    swirl: Option<List>,
    heaviness: Option<Number>,
    radius: Option<Number>,
}

/// How slip is given.
#[derive(Clone, Debug)]
enum Slip {
    Modes(List),
    Beta { speed: Option<Number>, beta: Number },
}

/// `[[squirmer]]`, as many as there are.
pub(super) fn read(file: &mut Table<'_, '_>, reader: &mut Reader<'_>) -> Vec<SquirmerTemplate> {
    const NEEDED: &str = "give two tables [[squirmer]]";
    let Some(entry) = file.get("squirmer") else {
        (reader.notes).missing(file.span(), "squirmer", NEEDED);
        return Vec::new();
    };
    let Some(array) = entry.value.as_array().filter(|array| !array.is_empty()) else {
        (reader.notes).wrong(entry.span, "squirmer", NEEDED);
        return Vec::new();
    };
    if array.len() != 2 {
        let found = format!("{} of them", array.len());
        (reader.notes).note(entry.span, "squirmer", found, NEEDED.to_owned());
    }
    let mut all = Vec::new();
    for (index, value) in array.iter().enumerate() {
        let key = format!("squirmer[{index}]");
        match value.get_ref() {
            DeValue::Table(table) => {
                all.push(squirmer(Table::new(&key, value.span(), table), reader));
            }
            _ => (reader.notes).wrong(value.span(), &key, "give a table [[squirmer]]"),
        }
    }
    all
}

fn squirmer(mut table: Table<'_, '_>, reader: &mut Reader<'_>) -> SquirmerTemplate {
    let position = table.numbers("position", reader, 2..=3);
    if position.is_none() {
        let allowed = "give the centre, two or three numbers in sphere radii";
        (reader.notes).missing(table.span(), &table.key("position"), allowed);
    }
    let template = SquirmerTemplate {
        position,
        orientation: direction(&mut table, reader),
        body: body(&mut table, reader),
    };
    table.finish(reader);
    template
}

/// `orientation`: an angle in degrees, an angle in radians that says so, or a vector.
fn direction(table: &mut Table<'_, '_>, reader: &mut Reader<'_>) -> Option<Direction> {
    let Some(entry) = table.get("orientation") else {
        let allowed = "give an angle in degrees from the x axis, or a vector";
        (reader.notes).missing(table.span(), &table.key("orientation"), allowed);
        return None;
    };
    match entry.value {
        DeValue::Array(_) => Some(Direction::Vector(numbers(&entry, reader, 2..=3))),
        DeValue::Table(inner) => {
            let mut angle = Table::new(&entry.key, entry.span, inner);
            let radians = angle.number("radians", reader, &FINITE);
            if radians.is_none() {
                let allowed = "give the angle in radians";
                (reader.notes).missing(angle.span(), &angle.key("radians"), allowed);
            }
            angle.finish(reader);
            radians.map(Direction::Radians)
        }
        _ => Some(Direction::Degrees(Number::read(&entry, reader, &ANGLE))),
    }
}

const ANGLE: Rule = Rule {
    allowed: || "an angle in degrees, or a vector of two or three numbers".to_owned(),
    ..FINITE
};

/// `modes`, or `swimming_speed` and `beta`; `swirl`, `bottom_heaviness` and `radius`.
fn body(table: &mut Table<'_, '_>, reader: &mut Reader<'_>) -> Body {
    let modes = table.numbers("modes", reader, 0..=MAX_MODES);
    let swirl = table.numbers("swirl", reader, 0..=MAX_MODES);
    let speed = table.number("swimming_speed", reader, &FINITE);
    let beta = table.number("beta", reader, &FINITE);
    let heaviness = table.number("bottom_heaviness", reader, &FINITE);
    let radius = table.number("radius", reader, &FINITE);
    let slip = match (modes, speed, beta) {
        (Some(modes), None, None) => Some(Slip::Modes(modes)),
        (Some(_), speed, beta) => {
            for number in [speed, beta].into_iter().flatten() {
                let allowed = "modes say it all: give either modes or swimming_speed and beta";
                (reader.notes).wrong(number.span, &number.key, allowed);
            }
            None
        }
        (None, speed, Some(beta)) => Some(Slip::Beta { speed, beta }),
        (None, _, None) => {
            let allowed =
                "give beta = B2/B1 (and swimming_speed, 1 unless given), or modes = [B1, B2, …]";
            (reader.notes).missing(table.span(), &table.key("beta"), allowed);
            None
        }
    };
    Body {
        span: table.span(),
        key: table.key("modes"),
        slip,
        swirl,
        heaviness,
        radius,
    }
}

impl SquirmerTemplate {
    /// Its radius, if it is given.
    pub(super) fn radius(&self) -> Option<&Number> {
        self.body.radius.as_ref()
    }

    /// The squirmer at a point, and where it starts.
    pub(super) fn at(&self, point: &mut Point<'_>) -> Option<(Squirmer, Pose)> {
        let position = self.position.as_ref().and_then(|list| point.vector(list));
        let orientation = (self.orientation.as_ref()).and_then(|direction| direction.at(point));
        let body = self.body.at(point);
        let pose = Pose {
            position: position?,
            orientation: orientation?,
        };
        Some((body?, pose))
    }
}

impl Direction {
    fn at(&self, point: &mut Point<'_>) -> Option<Orientation> {
        match self {
            Self::Degrees(degrees) => point.value(degrees).map(Orientation::from_degrees),
            Self::Radians(radians) => point.value(radians).map(Orientation::Radians),
            Self::Vector(list) => {
                let orientation = Orientation::Vector(point.vector(list)?);
                point.accept(orientation.vector(), &list.span, &list.key)?;
                Some(orientation)
            }
        }
    }
}

impl Body {
    fn at(&self, point: &mut Point<'_>) -> Option<Squirmer> {
        let slip = self.slip.as_ref().and_then(|slip| slip.at(point));
        let swirl = match &self.swirl {
            Some(list) => point.values(list),
            None => Some(([0.0; MAX_MODES], 0)),
        };
        let heaviness = match &self.heaviness {
            Some(number) => point.value(number),
            None => Some(0.0),
        };
        // It stands at a place of its own.
        let radius = match &self.radius {
            Some(number) => {
                let radius = point.value(number)?;
                let body = Squirmer::new(&[]).and_then(|body| body.with_radius(radius));
                point
                    .accept(body, &number.span, &number.key)
                    .map(|body| body.radius())
            }
            None => Some(1.0),
        };
        let (slip, (swirl, modes), heaviness) = (slip?, swirl?, heaviness?);
        let radius = radius?;
        let body = slip
            .and_then(|body| body.with_swirl(&swirl[..modes]))
            .and_then(|body| body.bottom_heavy(heaviness))
            .and_then(|body| body.with_radius(radius));
        point.accept(body, &self.span, &self.key)
    }
}

impl Slip {
    fn at(&self, point: &mut Point<'_>) -> Option<Result<Squirmer, SceneError>> {
        match self {
            Self::Modes(list) => {
                let (modes, count) = point.values(list)?;
                Some(Squirmer::new(&modes[..count]))
            }
            Self::Beta { speed, beta } => {
                let speed = match speed {
                    Some(speed) => point.value(speed),
                    None => Some(1.0),
                };
                let beta = point.value(beta);
                Some(Squirmer::with_beta(speed?, beta?))
            }
        }
    }
}
