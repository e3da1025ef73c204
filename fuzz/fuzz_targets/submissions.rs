//! A text is a submission or one line that says why not. What it answers is finite, by rising gap; so are the loads between its gaps.

#![no_main]

use compare::submission::{Submission, SubmittedModel};
use fuzz::finite;
use libfuzzer_sys::fuzz_target;
use scene::{Gap, Hydrodynamics, LoadSet};

/// Longest message, in bytes: shorter than those of scene files.
const LONGEST: usize = 400;

fn one_line(error: &impl std::fmt::Display) {
    fuzz::one_line(error);
    assert!(error.to_string().len() < LONGEST, "{error}");
}

fuzz_target!(|text: &str| {
    let submission = match Submission::parse(text) {
        Ok(submission) => submission,
        Err(error) => return one_line(&error),
    };
    let answers = submission.answers();
    let rise = |two: &[compare::submission::Answer]| two[0].gap.eps() < two[1].gap.eps();
    assert!(answers.windows(2).all(rise), "gaps do not rise");
    for answer in answers {
        let calibrated = answer.values.calibrated(submission.header());
        let [given, left] = [&answer.values, &calibrated].map(|values| values.iter().count());
        assert_eq!(given, left, "calibration loses values");
        let all = answer.values.iter().chain(answer.errors.iter());
        for (quantity, value) in all.chain(calibrated.iter()) {
            assert!(value.is_finite(), "{quantity} = {value}");
        }
        if let Some(laws) = &answer.laws {
            finite("asymmetry", laws.asymmetry.0);
            finite("images", laws.images.0);
            finite("eigenvalue", laws.smallest_eigenvalue);
        }
    }
    let model = match SubmittedModel::new(&submission) {
        Ok(model) => model,
        Err(error) => return one_line(&error),
    };
    let range = model.range();
    for eps in [
        range.smallest,
        (range.smallest * range.largest).sqrt(),
        range.largest,
        // Outside.
        0.5 * range.smallest,
    ] {
        let Ok(gap) = Gap::new(eps) else { continue };
        for set in [
            LoadSet::axial(1),
            LoadSet::all(2),
            LoadSet::all(2).with_swirl(1),
        ] {
            match model.interacting_loads_with_swirl(gap, set) {
                Ok((loads, swirl)) => {
                    for (name, value) in loads.named().into_iter().chain(swirl.named()) {
                        finite(&name, value);
                    }
                }
                Err(error) => one_line(&error),
            }
        }
    }
});
