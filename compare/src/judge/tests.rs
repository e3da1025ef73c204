use approx::assert_relative_eq;
use exact::Exact;
use scene::Hydrodynamics;

use super::*;
use crate::ModelOptions;
use crate::numbers::few_digits;

const ALL: LoadSet = LoadSet::all(2);

/// Gaps at about twelve a decade, with one far out.
fn gaps() -> Vec<f64> {
    let near = (0..48).map(|k| 1e-3 * 10_f64.powf(f64::from(k) / 12.0));
    near.chain([38.0]).collect()
}

/// A file of the exact loads at some gaps, with each value changed.
pub(super) fn file(
    header: &str,
    gaps: &[f64],
    change: impl Fn(f64, &str, f64) -> f64,
) -> Submission {
    let exact = Exact::new();
    let mut text = format!("#! model = \"copy\"\n{header}gap,name,value\n");
    for &gap in gaps {
        for (name, value) in exact.loads(Gap::new(gap).unwrap(), ALL).unwrap().named() {
            let value = change(gap, &name, value);
            text += &format!("{gap:?},{name},{value:?}\n");
        }
    }
    Submission::parse(&text).unwrap()
}

pub(super) fn judged(submission: Submission) -> Scorecard {
    let options = Options {
        grid: None,
        gaps: &super::GAPS,
    };
    let referee = Model::set_up(
        Method::Exact,
        &ModelOptions {
            direct: true,
            ..ModelOptions::default()
        },
    );
    judge(
        "copy",
        &Submitted::File(submission),
        Err("not asked for".to_owned()),
        &referee.unwrap(),
        &options,
    )
    .unwrap()
}

/// The faults by name, with the names of what is wrong.
fn named(card: &Scorecard) -> Vec<(&'static str, Vec<String>)> {
    let items = |fault: &Fault| fault.items().iter().map(ToString::to_string).collect();
    card.faults
        .iter()
        .map(|fault| (fault.kind.name(), items(fault)))
        .collect()
}

fn verdict(card: &Scorecard) -> String {
    card.verdict().join("\n")
}

#[test]
fn val_a_copy_within_1e_6_has_no_fault_and_is_trusted_at_all_gaps() {
    let signs: Vec<f64> = (0..97)
        .map(|k| if (k * k) % 7 < 3 { 1.0 } else { -1.0 })
        .collect();
    let card = judged(file("", &gaps(), |gap, name, value| {
        let hash = name.bytes().map(usize::from).sum::<usize>() + (1e6 * gap) as usize;
        value + 1e-6 * signs[hash % signs.len()] * value.abs().max(1.0)
    }));
    assert!(card.is_faultless(), "{}", verdict(&card));
    assert!(
        verdict(&card).contains("No fault found"),
        "{}",
        verdict(&card)
    );
    for bound in TRUST {
        assert_eq!(card.trusted(bound), Some(1e-3));
    }
    assert!(card.missing.is_empty());
}

#[test]
fn val_each_broken_copy_of_exact_loads_is_told_apart_by_name() {
    let singular = |gap: f64| if gap <= 1.0 { 0.75 * gap.ln() } else { 0.0 };
    // Y11B with the other sign.
    let card = judged(file("", &gaps(), |_, name, value| {
        if name == "Y11B" { -value } else { value }
    }));
    assert_eq!(named(&card), [("wrong sign", vec!["Y11B".to_owned()])]);
    assert!(
        verdict(&card).contains("Y11B would fit with the other sign"),
        "{}",
        verdict(&card)
    );
    // X11A 2 % too large near contact.
    let card = judged(file("", &gaps(), |gap, name, value| {
        if name == "X11A" && gap < 0.05 {
            1.02 * value
        } else {
            value
        }
    }));
    assert_eq!(
        named(&card),
        [("wrong factor near contact", vec!["X11A".to_owned()])]
    );
    let Kind::FactorBelow(factor, below) = card.faults[0].kind else {
        panic!("{:?}", card.faults)
    };
    assert_relative_eq!(factor, 1.02, epsilon = 1e-9);
    assert!((0.04..0.05).contains(&below));
    assert!(
        verdict(&card).contains("X11A is 1.02 times what it should be"),
        "{}",
        verdict(&card)
    );
    // The paper's 9/4 in place of 3.
    let card = judged(file("", &gaps(), |gap, name, value| match name {
        _ if name.starts_with("XF1") => value + singular(gap),
        _ if name.starts_with("XF2") => value - singular(gap),
        _ => value,
    }));
    assert_eq!(card.faults.len(), 1, "{:?}", named(&card));
    assert_eq!(
        card.faults[0].kind.name(),
        "wrong coefficient of lubrication"
    );
    assert_eq!(card.faults[0].items().len(), 4);
    assert!(
        verdict(&card).contains("have 2.25 where 3 belongs"),
        "{}",
        verdict(&card)
    );
    // A factor 2 in torques.
    let torques =
        |name: &str| ["Y11C", "Y12C", "X11C", "X12C"].contains(&name) || name.starts_with("YT");
    let card = judged(file("", &gaps(), |_, name, value| {
        if torques(name) { 2.0 * value } else { value }
    }));
    assert_eq!(card.faults.len(), 1, "{:?}", named(&card));
    assert_relative_eq!(card.faults[0].kind.number(), 2.0, epsilon = 1e-9);
    assert_eq!(card.faults[0].items().len(), 8);
    assert!(
        verdict(&card).contains("(torques) are 2 times"),
        "{}",
        verdict(&card)
    );
    // A cut.
    let card = judged(file("", &gaps(), |gap, name, value| {
        if gap > 0.5 {
            Quantity::named(name).unwrap().isolated()
        } else {
            value
        }
    }));
    assert!(
        named(&card).iter().all(|(name, _)| *name == "cut"),
        "{:?}",
        named(&card)
    );
    assert!(
        verdict(&card).contains("the spheres no longer feel each other"),
        "{}",
        verdict(&card)
    );
    let cut = card.faults[0].kind.number();
    assert!((0.5..0.6).contains(&cut), "{cut}");
    // Eight nodes, read along straight lines: right where it was made.
    let eight: Vec<f64> = (0..8)
        .map(|k| 1e-3 * 10_f64.powf(f64::from(k) * 4.6 / 7.0))
        .collect();
    let card = judged(file(
        "#! interpolation = \"linear\"\n",
        &eight,
        |_, _, value| value,
    ));
    assert!(
        named(&card)
            .iter()
            .all(|(name, _)| *name == "wrong between its gaps"),
        "{:?}",
        named(&card)
    );
    assert!(
        verdict(&card).contains("the gaps are too far apart for this interpolation"),
        "{}",
        verdict(&card)
    );
    // The same, sampled densely by somebody who does not say so.
    let table = SubmittedModel::new(&file(
        "#! interpolation = \"linear\"\n",
        &eight,
        |_, _, value| value,
    ))
    .unwrap();
    let card = judged(file("", &gaps()[..48], |gap, name, _| {
        table
            .quantity(Gap::new(gap).unwrap(), Quantity::named(name).unwrap())
            .unwrap()
            .unwrap()
    }));
    assert!(
        verdict(&card).contains("on straight lines between few gaps"),
        "{}",
        verdict(&card)
    );
}

#[test]
fn one_wrong_value_and_a_wrong_far_field_are_told() {
    let all = gaps();
    let typing = all[20];
    let card = judged(file("", &all, |gap, name, value| {
        if name == "Y12C" && gap.total_cmp(&typing).is_eq() {
            value + 0.1
        } else {
            value
        }
    }));
    assert_eq!(named(&card), [("one wrong value", vec!["Y12C".to_owned()])]);
    assert!(verdict(&card).contains(&format!("at gap {}", few_digits(typing))));
    let card = judged(file("", &all, |gap, name, value| {
        if name == "X12A" && gap > 7.5 {
            1.5 * value
        } else {
            value
        }
    }));
    assert!(
        named(&card)
            .iter()
            .any(|(name, items)| *name == "wrong far field" && items == &["X12A"]),
        "{:?}",
        named(&card)
    );
}

#[test]
fn what_is_missing_is_said_and_what_is_there_is_scored() {
    let card = judged(file("", &gaps(), |_, _, value| value));
    assert!(card.is_faultless());
    let text = "#! model = \"some\"\n#! version = \"1\"\n#! citation = \"nobody\"\ngap,name,value\n38,x12a,0.0375\n0.1,x12a,0.7\n";
    let card = judged(Submission::parse(text).unwrap());
    assert!(card.trusted(0.01).is_some());
    assert_eq!(card.missing.len(), 22);
    let said = verdict(&card);
    assert!(
        said.contains("Missing, and so not scored: X11A, X12A"),
        "{said}"
    );
    assert!(
        said.contains("too few") || said.contains("No collisions"),
        "{said}"
    );
    assert!(!said.contains("Not stated"), "{said}");
}

#[test]
fn val_errors_of_public_codes_are_those_that_were_measured_apart_from_this_code() {
    let mut cards: Vec<(String, Scorecard)> = Vec::new();
    let mut compared = 0;
    for line in fixtures::PEER_ERRORS
        .lines()
        .filter(|line| !line.starts_with('#'))
        .skip(1)
    {
        let fields: Vec<&str> = line.split(',').collect();
        let [model, item, gap, percent] = fields[..] else {
            panic!("{line}")
        };
        if !cards.iter().any(|(name, _)| name == model) {
            cards.push((
                model.to_owned(),
                judged(Submission::parse(fixtures::peer(model).unwrap()).unwrap()),
            ));
        }
        let (_, card) = cards.iter().find(|(name, _)| name == model).unwrap();
        let gap: f64 = gap.parse().unwrap();
        let point = card.points.iter().find(|point| {
            point.item.to_string().replace(',', "") == item && (point.gap / gap - 1.0).abs() < 1e-9
        });
        let found = point.unwrap_or_else(|| panic!("{line}")).relative_percent();
        // Of Y11B, which is negative, the published error is that of its size.
        let found = if item == "Y11B" { -found } else { found };
        let Some(bound) = percent.strip_prefix("<=") else {
            let published: f64 = percent.parse().unwrap();
            // The digits that are printed.
            let decimals = percent.split_once('.').map_or(0, |(_, decimals)| {
                decimals
                    .trim_end_matches(|c: char| !c.is_ascii_digit())
                    .len()
            });
            let unit = if percent.contains('e') {
                0.5 * 10_f64.powf(published.abs().log10().floor())
            } else {
                10_f64.powi(-(decimals as i32))
            };
            assert!((found - published).abs() <= unit, "{line}: {found}");
            compared += 1;
            continue;
        };
        let bound: f64 = bound.parse().unwrap();
        // Printed with two digits.
        assert!(found.abs() <= 1.05 * bound, "{line}: {found}");
        compared += 1;
    }
    assert!(compared > 150, "{compared}");
}

#[test]
fn the_page_lists_the_measures_and_the_faults_as_they_are() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/JUDGE.md");
    let page = std::fs::read_to_string(file).unwrap();
    for (measure, meaning) in MEASURES {
        let row = format!("| `{measure}` | {meaning} |");
        assert!(page.contains(&row), "missing in docs/JUDGE.md: {row}");
    }
    for kind in Kind::ALL {
        assert!(
            page.contains(&format!("| {} | ", kind.name())),
            "missing in docs/JUDGE.md: {}",
            kind.name()
        );
    }
    // Every row is one of the measures.
    let submission = Submission::parse(fixtures::peer("multiblobs-42").unwrap()).unwrap();
    for row in judged(submission).rows() {
        assert!(
            MEASURES.iter().any(|(measure, _)| *measure == row.measure),
            "{}",
            row.measure
        );
    }
}

#[test]
fn val_exchanged_spheres_and_other_units_of_the_gap_are_told() {
    let exact = Exact::new();
    let truth = |gap: f64, name: &str| {
        let loads = exact.loads(Gap::new(gap).unwrap(), ALL).unwrap();
        loads
            .named()
            .into_iter()
            .find(|(other, _)| other == name)
            .unwrap()
            .1
    };
    let card = judged(file("", &gaps(), |gap, name, value| match name {
        "Y11C" => truth(gap, "Y12C"),
        "Y12C" => truth(gap, "Y11C"),
        _ => value,
    }));
    assert_eq!(
        named(&card),
        [(
            "spheres exchanged",
            vec!["Y11C".to_owned(), "Y12C".to_owned()]
        )]
    );
    // Half of each gap, as in diameters.
    let card = judged(file("", &gaps(), |gap, name, _| truth(2.0 * gap, name)));
    assert_eq!(card.faults.len(), 1);
    assert_eq!(card.faults[0].kind, Kind::GapUnit(2.0));
    assert!(
        verdict(&card).contains("its gaps were multiplied by 2"),
        "{}",
        verdict(&card)
    );
    let far: Vec<f64> = gaps().into_iter().filter(|gap| *gap > 2.1).collect();
    let card = judged(file("", &far, |gap, name, _| truth(gap - 2.0, name)));
    assert_eq!(card.faults[0].kind, Kind::Distance);
}

#[test]
fn val_a_fault_of_loads_is_told_of_a_code_that_answers_with_velocities() {
    let as_velocities = |loads: Submission| {
        let answers = loads.answers().iter().map(|answer| Answer {
            values: crate::submission::derived(&answer.values),
            ..answer.clone()
        });
        Submission::of_answers(loads.header().clone(), answers.collect())
    };
    let card = judged(as_velocities(file("", &gaps(), |_, name, value| {
        if name == "Y11B" { -value } else { value }
    })));
    assert_eq!(named(&card), [("wrong sign", vec!["Y11B".to_owned()])]);
    let card = judged(as_velocities(file("", &gaps(), |gap, name, value| {
        let off = 0.75 * gap.ln().min(0.0);
        match name {
            _ if name.starts_with("XF1") => value + off,
            _ if name.starts_with("XF2") => value - off,
            _ => value,
        }
    })));
    assert_eq!(card.faults.len(), 1, "{:?}", named(&card));
    assert!(
        verdict(&card).contains("have 2.25 where 3 belongs"),
        "{}",
        verdict(&card)
    );
    // Twice too mobile: one cause, and no lubrication is missing.
    let mobile = as_velocities(file("", &gaps(), |_, _, value| value));
    let answers = mobile.answers().iter().map(|answer| {
        let mut values = answer.values.clone();
        for (quantity, value) in answer
            .values
            .iter()
            .filter(|(quantity, _)| quantity.mode().is_none())
        {
            values.set(quantity, 2.0 * value);
        }
        Answer {
            values,
            ..answer.clone()
        }
    });
    let card = judged(Submission::of_answers(
        mobile.header().clone(),
        answers.collect(),
    ));
    assert_eq!(card.faults.len(), 1, "{:?}", named(&card));
    assert!(
        verdict(&card).contains("another viscosity?"),
        "{}",
        verdict(&card)
    );
}

#[test]
fn noise_is_no_far_field_and_a_stated_error_is_no_fault() {
    let far: Vec<f64> = (0..60)
        .map(|k| 1e-3 * 10_f64.powf(f64::from(k) / 12.0))
        .collect();
    let mut state = 1_u64;
    for size in [1e-6, 1e-4] {
        for _ in 0..6 {
            let mut noise = || {
                state = state
                    .wrapping_mul(6_364_136_223_846_793_005)
                    .wrapping_add(1);
                (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
            };
            let mut submission = file("", &far, |_, _, value| value);
            let answers: Vec<Answer> = (submission.answers().iter())
                .map(|answer| {
                    let (mut values, mut errors) = (Values::default(), Values::default());
                    for (quantity, value) in answer.values.iter() {
                        values.set(quantity, value + size * noise() * value.abs().max(1.0));
                        if size > 1e-6 {
                            errors.set(quantity, size);
                        }
                    }
                    Answer {
                        values,
                        errors,
                        ..answer.clone()
                    }
                })
                .collect();
            submission = Submission::of_answers(submission.header().clone(), answers);
            let card = judged(submission);
            assert!(card.is_faultless(), "{}", verdict(&card));
        }
    }
}

#[test]
fn trust_begins_beyond_the_largest_gap_at_which_an_error_is_too_large() {
    let point = |gap: f64, error: f64| points::made::point("X11A", gap, 1.0 + error, 1.0);
    let points = [
        point(0.1, -0.03),
        point(10.0, 0.002),
        point(0.01, 0.3),
        point(1.0, 0.008),
    ];
    let down_to = |bound: f64| trusted_down_to(points.iter(), bound);
    // Right again at a smaller gap is no trust down to there.
    assert_eq!(down_to(0.005), Some(10.0));
    assert_eq!(down_to(0.01), Some(1.0));
    assert_eq!(down_to(0.05), Some(0.1));
    assert_eq!(down_to(0.5), Some(0.01));
    assert_eq!(down_to(0.001), None);
    let lucky = [
        point(0.1, 0.0),
        point(1.0, 0.02),
        point(10.0, 0.0),
        point(20.0, f64::NAN),
        point(30.0, 0.0),
    ];
    assert_eq!(trusted_down_to(lucky.iter(), 0.01), Some(30.0));
    assert_eq!(trusted_down_to(lucky[..3].iter(), 0.01), Some(10.0));
}

fn peer(name: &str) -> Scorecard {
    let mut card = judged(Submission::parse(fixtures::peer(name).unwrap()).unwrap());
    card.name = name.to_owned();
    card
}

#[test]
fn val_the_smallest_eigenvalue_of_scalars_is_that_of_their_matrix() {
    let whole = fixtures::peer("pystokes-matrix").unwrap();
    // Without the other sphere along the line of centres the smallest eigenvalue is one across it.
    let across: String = (whole.lines())
        .map(|line| match line.split(',').collect::<Vec<_>>()[..] {
            [gap, row, col, _]
                if [("3", "6"), ("6", "3"), ("9", "12"), ("12", "9")].contains(&(row, col)) =>
            {
                format!("{gap},{row},{col},0\n")
            }
            _ => format!("{line}\n"),
        })
        .collect();
    for text in [whole, &across] {
        let card = judged(Submission::parse(text).unwrap());
        let law = card
            .matrix_laws
            .iter()
            .find(|law| law.name == "smallest eigenvalue")
            .unwrap();
        let (gap, least) = card
            .definite
            .iter()
            .copied()
            .min_by(|a, b| a.1.total_cmp(&b.1))
            .unwrap();
        assert_relative_eq!(gap, law.gap);
        assert_relative_eq!(least, law.value, max_relative = 1e-12);
        assert!(least > 0.0 && least < 0.6, "{least}");
    }
}

#[test]
fn the_leaderboard_goes_by_score_and_scores_only_what_is_complete() {
    let names = [
        "pystokes",
        "near-field-jeffrey-onishi",
        "libstokes-n100",
        "townsend-table",
        "multiblobs-642",
    ];
    let cards: Vec<Scorecard> = names.iter().map(|name| peer(name)).collect();
    let rows = leader_rows(&cards);
    let order: Vec<&str> = rows.iter().map(|row| row.model.as_str()).collect();
    assert_eq!(
        order,
        [
            "libstokes-n100",
            "townsend-table",
            "multiblobs-642",
            "pystokes",
            "near-field-jeffrey-onishi"
        ]
    );
    // It has no gap from 0.5 on.
    assert!(
        rows[4].score.is_nan() && rows[4].error_01 < 0.05,
        "{:?}",
        rows[4]
    );
    let pystokes = &rows[3];
    // X12A, which is as large as X11A and more off.
    assert!(
        pystokes.error_001 > 0.94 && pystokes.error_001 < 0.97,
        "{pystokes:?}"
    );
    assert!(pystokes.error_2 < pystokes.error_05 && pystokes.error_05 < pystokes.error_01);
    assert!((pystokes.score - pystokes.error_001).abs() < 1e-12 && pystokes.slip_score > 0.5);
    assert!((pystokes.seconds - 9e-5).abs() < 1e-12);
    // Between its gaps it is worse than at them.
    assert!(
        rows[1].score > 0.1 && rows[1].error_01 < 1e-6,
        "{:?}",
        rows[1]
    );
    assert!(rows[1].slip_score.is_nan());
}

#[test]
fn collisions_are_compared_outcome_by_outcome_and_state_by_state() {
    let score = |theirs: ([f64; 2], &str), exact: ([f64; 2], &str)| CaseScore {
        case: crate::Case {
            approach: crate::Approach::HeadOn,
            beta: 5.0,
            dx: 1.0,
            dz: 0.0,
        },
        theirs: (theirs.0, theirs.1.to_owned()),
        exact: (exact.0, exact.1.to_owned()),
    };
    let both = score(([10.0, -3.0], "scattered"), ([9.0, 1.0], "scattered"));
    assert_eq!(both.error_deg(), Some(4.0));
    assert_eq!(both.name(), "opposed, beta 5, dx 1");
    assert_eq!(
        score(([10.0, 0.0], "pairwise"), ([9.0, 0.0], "scattered")).error_deg(),
        None
    );
    // Lubrication theory has other bound states than exact hydrodynamics, and ends otherwise.
    let models = [Method::Lt, Method::Exact].map(|method| {
        let options = ModelOptions {
            cache: None,
            tabulated: LoadSet::planar(2),
            ..ModelOptions::default()
        };
        Model::set_up(method, &options).unwrap()
    });
    let [lt, exact] = &models;
    let same = collisions::collisions(exact, exact, Grid::new(4).unwrap()).unwrap();
    assert!(same.partings.is_empty());
    assert!(
        same.bound_states()
            .iter()
            .all(|state| state.theirs == state.exact)
    );
    assert!(
        same.cases
            .iter()
            .all(|score| score.error_deg().is_none_or(|error| error <= 0.0))
    );
    let found = collisions::collisions(lt, exact, Grid::new(6).unwrap()).unwrap();
    assert_eq!(found.cases.len(), 17);
    for beta in BETAS {
        let of = |shares: fn([f64; 2]) -> f64| -> f64 {
            let mine = found
                .outcomes
                .iter()
                .filter(|(other, ..)| other.total_cmp(&beta).is_eq());
            mine.map(|(.., both)| shares(*both)).sum()
        };
        assert_relative_eq!(of(|both| both[0]), 1.0, epsilon = 1e-12);
        assert_relative_eq!(of(|both| both[1]), 1.0, epsilon = 1e-12);
        let parted = found
            .partings
            .iter()
            .filter(|parting| parting.beta.total_cmp(&beta).is_eq());
        let other = found
            .trust
            .iter()
            .find(|shares| shares.beta.total_cmp(&beta).is_eq())
            .unwrap()
            .other_outcome;
        assert_relative_eq!(
            parted.map(|parting| parting.share).sum::<f64>(),
            other,
            epsilon = 1e-12
        );
    }
    // The weak pullers side by side, which lubrication theory lacks.
    let states = found.bound_states();
    let missing: Vec<String> = states
        .iter()
        .filter(|state| state.theirs.is_none())
        .map(BoundComparison::name)
        .collect();
    assert!(
        missing
            .iter()
            .any(|name| name.starts_with("beta 1, pairwise, stable, gap 3.7e-1")),
        "{missing:?}"
    );
    assert!(states.iter().any(|state| state.exact.is_none()));
}
