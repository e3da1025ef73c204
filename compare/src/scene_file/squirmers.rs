//! The two squirmers of a scene file.

use std::ops::Range;

use scene::{MAX_MODES, Orientation, Pose, Squirmer};
use toml::de::DeValue;

use super::effects::{direction, vector};
use super::mistakes::Notes;
use super::table::{Table, number, numbers};

/// The squirmers and where they start.
pub(super) struct Squirmers {
    pub bodies: [Squirmer; 2],
    pub start: [Pose; 2],
    /// Where the second one's position stands.
    pub second: Range<usize>,
}

/// `[[squirmer]]`, twice.
pub(super) fn read(file: &mut Table<'_, '_>, notes: &mut Notes<'_>) -> Option<Squirmers> {
    const NEEDED: &str = "give two tables [[squirmer]]";
    let Some(entry) = file.get("squirmer") else {
        notes.missing(file.span(), "squirmer", NEEDED);
        return None;
    };
    let Some(array) = entry.value.as_array().filter(|array| !array.is_empty()) else {
        notes.wrong(entry.span, "squirmer", NEEDED);
        return None;
    };
    if array.len() != 2 {
        let found = format!("{} of them", array.len());
        notes.note(entry.span, "squirmer", found, NEEDED.to_owned());
    }
    let mut all = Vec::new();
    for (index, value) in array.iter().enumerate() {
        let key = format!("squirmer[{index}]");
        match value.get_ref() {
            DeValue::Table(table) => {
                all.push(squirmer(Table::new(&key, value.span(), table), notes));
            }
            _ => notes.wrong(value.span(), &key, "give a table [[squirmer]]"),
        }
    }
    let [Some(one), Some(two)] = <[_; 2]>::try_from(all).ok()? else {
        return None;
    };
    Some(Squirmers {
        bodies: [one.body, two.body],
        start: [one.pose, two.pose],
        second: two.place,
    })
}

struct Read {
    body: Squirmer,
    pose: Pose,
    place: Range<usize>,
}

fn squirmer(mut table: Table<'_, '_>, notes: &mut Notes<'_>) -> Option<Read> {
    let before = notes.count();
    let position = direction(&mut table, "position", notes);
    if position.is_none() && notes.count() == before {
        let allowed = "give the centre, two or three numbers in sphere radii";
        notes.missing(table.span(), &table.key("position"), allowed);
    }
    let orientation = orientation(&mut table, notes);
    let body = body(&mut table, notes);
    table.finish(notes);
    let (position, place) = position?;
    let pose = Pose {
        position,
        orientation: orientation?,
    };
    Some(Read {
        body: body?,
        pose,
        place,
    })
}

/// `orientation`: an angle in degrees or a vector.
fn orientation(table: &mut Table<'_, '_>, notes: &mut Notes<'_>) -> Option<Orientation> {
    let Some(entry) = table.get("orientation") else {
        let allowed = "give an angle in degrees from the x axis, or a vector";
        notes.missing(table.span(), &table.key("orientation"), allowed);
        return None;
    };
    if let Some(degrees) = number(entry.value) {
        return Some(Orientation::from_degrees(degrees));
    }
    if entry.value.as_array().is_none() {
        let allowed = "give an angle in degrees, or a vector of two or three numbers";
        notes.wrong(entry.span, &entry.key, allowed);
        return None;
    }
    let orientation = Orientation::Vector(vector(&numbers(&entry, notes, 2..=3)?));
    match orientation.vector() {
        Ok(_) => Some(orientation),
        Err(error) => {
            notes.wrong(entry.span, &entry.key, error.to_string());
            None
        }
    }
}

/// `modes`, or `swimming_speed` and `beta`; `swirl` and `bottom_heaviness`.
fn body(table: &mut Table<'_, '_>, notes: &mut Notes<'_>) -> Option<Squirmer> {
    let before = notes.count();
    let modes = table.numbers("modes", notes, 0..=MAX_MODES);
    let swirl = table.numbers("swirl", notes, 0..=MAX_MODES);
    let speed_place = table.get("swimming_speed").map(|entry| entry.span);
    let beta_place = table.get("beta").map(|entry| entry.span);
    let mut finite =
        |name, notes: &mut Notes<'_>| table.number(name, notes, "a finite number", |_| true);
    let speed = finite("swimming_speed", notes);
    let beta = finite("beta", notes);
    let heaviness = finite("bottom_heaviness", notes);
    let body = match (&modes, &beta_place) {
        (Some((modes, _)), None) if speed_place.is_none() => Squirmer::new(modes),
        (Some(_), _) => {
            let keys = [("beta", &beta_place), ("swimming_speed", &speed_place)];
            for (name, place) in keys {
                if let Some(place) = place {
                    let allowed = "modes say it all: give either modes or swimming_speed and beta";
                    notes.wrong(place.clone(), &table.key(name), allowed);
                }
            }
            return None;
        }
        (None, Some(_)) => Squirmer::with_beta(speed.unwrap_or(1.0), beta.unwrap_or(0.0)),
        (None, None) => {
            if notes.count() == before {
                let allowed = "give beta = B2/B1 (and swimming_speed, 1 unless given), or modes = [B1, B2, …]";
                notes.missing(table.span(), &table.key("beta"), allowed);
            }
            return None;
        }
    };
    if notes.count() > before {
        return None;
    }
    let swirl = swirl.map_or(Vec::new(), |(modes, _)| modes);
    let body = body.and_then(|body| body.with_swirl(&swirl));
    match body.and_then(|body| body.bottom_heavy(heaviness.unwrap_or(0.0))) {
        Ok(body) => Some(body),
        Err(error) => {
            notes.wrong(table.span(), &table.key("modes"), error.to_string());
            None
        }
    }
}
