//! Who is asked how often, and what becomes of what he says, without a process.

use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use super::*;
use crate::submission::{Submitted, is_raised};
use crate::{Model, ModelOptions};
use exact::Exact;

/// Answers with exact loads but for what `change` makes of them, and counts.
struct Copying<F> {
    change: F,
    calls: AtomicUsize,
    gaps: AtomicUsize,
}

#[derive(Debug, thiserror::Error)]
#[error("it does not converge")]
struct Own;

impl<F: Fn(&mut PairAnswer) -> Result<(), Silence> + Send + Sync> Source for Copying<F> {
    fn kind(&self) -> &'static str {
        "function"
    }

    fn name(&self) -> &str {
        "copy"
    }

    fn takes_turns(&self) -> bool {
        false
    }

    fn ask(&self, gaps: &[f64], heard: &mut Heard<'_>) -> Result<(), Silence> {
        self.calls.fetch_add(1, Relaxed);
        self.gaps.fetch_add(gaps.len(), Relaxed);
        for (place, &gap) in gaps.iter().enumerate() {
            let at = Gap::new(gap).unwrap();
            let loads = Exact::new().loads(at, LoadSet::all(2)).unwrap();
            let mut said = PairAnswer {
                gap,
                values: loads.named().into_iter().collect(),
                ..PairAnswer::default()
            };
            (self.change)(&mut said)?;
            heard(place, said).map_err(Silence::Said)?;
        }
        Ok(())
    }
}

fn copying<F>(change: F) -> (Arc<Copying<F>>, Arc<Asked>)
where
    F: Fn(&mut PairAnswer) -> Result<(), Silence> + Send + Sync + 'static,
{
    let source = Arc::new(Copying {
        change,
        calls: AtomicUsize::new(0),
        gaps: AtomicUsize::new(0),
    });
    let header = Header {
        range: Some([0.01, 1000.0]),
        ..Header::default()
    };
    let asked = Asked::new(source.clone(), header).unwrap();
    (source, Arc::new(asked))
}

fn gap(eps: f64) -> Gap {
    Gap::new(eps).unwrap()
}

#[test]
fn gaps_that_are_foreseen_are_asked_at_once_and_no_gap_twice() {
    let (source, asked) = copying(|_| Ok(()));
    let gaps = [2.0, 0.5, 2.0, 0.001].map(gap);
    asked.foresee(&gaps).unwrap();
    for gap in &gaps[..3] {
        asked.loads(*gap, LoadSet::all(2)).unwrap();
    }
    let error = asked.answer(gaps[3]).unwrap_err().to_string();
    assert!(
        error.starts_with("function 'copy': gap 1e-3 is outside"),
        "{error}"
    );
    assert_eq!(
        [&source.calls, &source.gaps].map(|n| n.load(Relaxed)),
        [1, 2]
    );
    asked.foresee(&gaps).unwrap();
    asked.loads(gap(1.0), LoadSet::all(2)).unwrap();
    assert_eq!(
        [&source.calls, &source.gaps].map(|n| n.load(Relaxed)),
        [2, 3]
    );
}

#[test]
fn a_table_asks_for_many_gaps_at_once_and_holds_what_was_said() {
    let (source, asked) = copying(|_| Ok(()));
    let method = Submitted::Asked(asked).replace("asked-in-bulk").unwrap();
    let options = ModelOptions {
        tabulated: LoadSet::planar(2),
        cache: None,
        ..ModelOptions::default()
    };
    let model = Model::set_up(method, &options).unwrap();
    assert!(model.table().is_some());
    let [calls, gaps] = [&source.calls, &source.gaps].map(|n| n.load(Relaxed));
    assert!(calls < 20 && gaps > 3 * calls, "{calls} calls, {gaps} gaps");
    let set = scene::mobility::MobilitySet {
        loads: LoadSet::planar(2),
        torque: true,
    };
    for eps in [0.0123, 0.4, 3.0, 77.0] {
        let found = model.mobility(gap(eps), set).unwrap().named(set);
        let exact = Exact::new().mobility(gap(eps), set).unwrap().named(set);
        for ((name, found), (_, exact)) in found.into_iter().zip(exact) {
            let error = (found - exact).abs() / exact.abs().max(1.0);
            assert!(error < 3e-6, "{name} at {eps}: {found} {exact}");
        }
    }
}

#[test]
fn a_number_that_is_none_is_a_gap_without_an_answer_and_the_rest_stands() {
    let (source, asked) = copying(|said| {
        if said.gap < 0.1 {
            said.values.insert("Y11B".to_owned(), f64::NAN);
        }
        Ok(())
    });
    let gaps = [0.05, 0.5].map(gap);
    asked.foresee(&gaps).unwrap();
    assert!(asked.answer(gaps[1]).is_ok());
    for _ in 0..2 {
        let error = asked.answer(gaps[0]).unwrap_err().to_string();
        assert_eq!(
            error,
            "function 'copy': it has no answer at the gap 0.05: Y11B is NaN"
        );
    }
    assert_eq!(source.calls.load(Relaxed), 1);
}

#[test]
fn what_is_no_answer_and_an_error_of_its_own_come_out_whole() {
    let (_, asked) = copying(|said| {
        said.values.insert("Y13B".to_owned(), 1.0);
        Ok(())
    });
    let error = asked.loads(gap(1.0), LoadSet::all(2)).unwrap_err();
    assert!(
        error.to_string().contains("there is no quantity 'Y13B'"),
        "{error}"
    );
    assert!(!is_raised(&error));
    let (_, asked) = copying(|said| match said.gap {
        far if far > 100.0 => Err(Silence::Raised(ModelFailure::new(Own))),
        _ => Ok(()),
    });
    let method = Submitted::Asked(asked)
        .replace("asked-and-raising")
        .unwrap();
    // Midway in the table.
    let Err(error) = Model::set_up(method, &ModelOptions::default()) else {
        panic!("a table was made");
    };
    assert!(is_raised(&error));
    let causes = std::iter::successors(Some(&error as &dyn std::error::Error), |e| e.source());
    assert!(causes.last().unwrap().is::<Own>());
}

#[test]
fn a_header_without_a_range_is_refused() {
    let (source, _) = copying(|_| Ok(()));
    let error = Asked::new(source, Header::default()).unwrap_err();
    assert!(error.to_string().contains("no range"), "{error}");
}
