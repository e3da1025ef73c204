//! `[run]` and `[output]` of a scene file.

use scene::RunOptions;

use super::number::{Number, Reader, Rule};
use super::point::Point;
use super::table::Table;

/// Time between samples unless the file says otherwise, in `a/V_s`.
pub const SAMPLE_INTERVAL: f64 = 0.05;

/// Longest run, in `a/V_s`.
const LONGEST: f64 = 1e6;

/// Most samples and most steps of a run.
const MOST_SAMPLES: f64 = 1e6;
const MOST_STEPS: usize = 100_000_000;

const END_TIME: Rule = Rule {
    allowed: || format!("a time greater than 0, at most {LONGEST}"),
    holds: |t| t > 0.0 && t <= LONGEST,
};

const DISTANCE: Rule = Rule {
    allowed: || "a distance of the centres greater than 2".to_owned(),
    holds: |r| r > 2.0,
};

const TOLERANCE: Rule = Rule {
    allowed: || "a number from 1e-14 to 1e-2".to_owned(),
    holds: |tolerance| (1e-14..=1e-2).contains(&tolerance),
};

/// What is least depends on the end time.
const INTERVAL: Rule = Rule {
    allowed: || "a time of at least a millionth of the end time".to_owned(),
    holds: |t| t > 0.0,
};

/// How a scene is run, as it stands in the file; what is left out has its default.
#[derive(Clone, Debug, Default)]
pub(super) struct RunTemplate {
    end_time: Option<Number>,
    departure_distance: Option<Number>,
    tolerance: Option<Number>,
    max_steps: Option<usize>,
    sample_interval: Option<Number>,
}

/// `[run]` and `[output]`.
pub(super) fn read(file: &mut Table<'_, '_>, reader: &mut Reader<'_>) -> RunTemplate {
    let mut template = RunTemplate::default();
    if let Some(mut run) = file.table("run", reader) {
        template.end_time = run.number("end_time", reader, &END_TIME);
        template.departure_distance = run.number("departure_distance", reader, &DISTANCE);
        template.tolerance = run.number("tolerance", reader, &TOLERANCE);
        template.max_steps = run.whole("max_steps", reader, 1..=MOST_STEPS);
        run.finish(reader);
    }
    if let Some(mut output) = file.table("output", reader) {
        template.sample_interval = output.number("sample_interval", reader, &INTERVAL);
        output.finish(reader);
    }
    template
}

impl RunTemplate {
    /// How the scene at a point is run.
    pub(super) fn at(&self, point: &mut Point<'_>) -> RunOptions {
        let mut options = RunOptions::default();
        let mut set = |slot: &mut f64, number: &Option<Number>| {
            let value = number.as_ref().and_then(|number| point.value(number));
            *slot = value.unwrap_or(*slot);
        };
        set(&mut options.end_time, &self.end_time);
        set(&mut options.departure_distance, &self.departure_distance);
        set(&mut options.tolerance, &self.tolerance);
        options.max_steps = self.max_steps.unwrap_or(options.max_steps);
        let least = options.end_time / MOST_SAMPLES;
        let mut interval = SAMPLE_INTERVAL.max(least);
        set(&mut interval, &self.sample_interval);
        if let Some(number) = self.sample_interval.as_ref().filter(|_| interval < least) {
            let allowed = format!("a time of at least {least}, a millionth of the end time");
            point.refuse(number, interval, &allowed);
        }
        options.sample_interval = Some(interval);
        options
    }
}
