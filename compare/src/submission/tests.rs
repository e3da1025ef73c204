use approx::assert_relative_eq;
use exact::Exact;
use scene::{Gap, Hydrodynamics, LoadSet, SelfOther};

use proptest::prelude::*;

use super::*;

fn quantity(name: &str) -> Quantity {
    Quantity::named(name).unwrap()
}

fn value(submission: &Submission, gap: f64, name: &str) -> f64 {
    let same = |answer: &&Answer| (answer.gap.eps() / gap - 1.0).abs() < 1e-12;
    let answer = submission.answers().iter().find(same).unwrap();
    answer
        .values
        .get(quantity(name))
        .unwrap_or_else(|| panic!("{name} at {gap}"))
}

/// Exact loads of the modes 1 and 2 as values.
fn exact_values(gap: f64) -> Values {
    Values::of_model(&Exact::new(), Gap::new(gap).unwrap(), LoadSet::all(2)).unwrap()
}

#[test]
fn names_are_in_pairs_and_each_is_found() {
    assert_eq!(Quantity::all().count(), 2 * (5 + 3 * 8 + 3 * 8 + 5 + 3 * 8));
    for one in Quantity::all() {
        assert_eq!(Quantity::named(one.name()), Some(one));
        assert_eq!(one.partner().partner(), one);
        let [own, other] = if one.is_own() {
            [one, one.partner()]
        } else {
            [one.partner(), one]
        };
        let alike = |name: &str, from: &str, to: &str| name.replacen(from, to, 1);
        let partner = match own.name().contains("11") {
            true => alike(own.name(), "11", "12"),
            false => alike(own.name(), "1_", "2_"),
        };
        assert_eq!(other.name(), partner);
    }
}

#[test]
fn val_mobilities_and_velocities_follow_from_exact_loads_as_published() {
    // Measured apart from this code, by the definitions: `fixtures/README.md`.
    let published = Submission::parse(fixtures::EXACT_VELOCITIES).unwrap();
    let mut compared = 0;
    for answer in published
        .answers()
        .iter()
        .filter(|answer| answer.gap.eps() < 100.0)
    {
        let found = derived(&exact_values(answer.gap.eps()));
        for (quantity, truth) in answer.values.iter() {
            let value = found
                .get(quantity)
                .unwrap_or_else(|| panic!("{quantity} is missing"));
            assert_relative_eq!(value, truth, epsilon = 2e-9, max_relative = 2e-9);
            compared += 1;
        }
    }
    assert!(compared > 300, "{compared}");
}

#[test]
fn loads_come_back_from_the_mobilities_that_follow_from_them() {
    for gap in [1e-4, 0.01, 0.3, 5.0] {
        let loads = exact_values(gap);
        let mobilities = derived(&loads);
        assert!(mobilities.iter().all(|(quantity, _)| !quantity.is_load()));
        let back = derived(&mobilities);
        assert_eq!(back.iter().count(), loads.iter().count());
        for (quantity, value) in loads.iter() {
            let found = back.get(quantity).unwrap();
            // The stiffest block loses as many digits as the gap has zeros.
            assert_relative_eq!(found, value, epsilon = 1e-9, max_relative = 1e-11 / gap);
        }
    }
}

/// A matrix file, entry by entry by the definitions of the loads: forces by the fluid, of either sphere moving, turned into forces on the spheres.
fn resistance_file(gaps: &[f64], unit: f64, header: &str) -> String {
    use std::f64::consts::PI;
    use std::fmt::Write;

    let mut text = format!("{header}gap,row,col,value\n");
    for &gap in gaps {
        let loads = Exact::new()
            .loads(Gap::new(gap).unwrap(), LoadSet::all(2))
            .unwrap();
        for moving in [0, 1] {
            // From the moving sphere to the other one.
            let side = if moving == 0 { 1.0 } else { -1.0 };
            let mut put = |row: usize, column: String, value: f64| {
                writeln!(text, "{:?},{},{column},{value:?}", gap * unit, row + 1).unwrap();
            };
            for axis in 0..3 {
                for is_spin in [false, true] {
                    let column = 3 * moving + axis + if is_spin { 6 } else { 0 };
                    let mut entries = [0.0; 12];
                    for (sphere, pick) in [
                        (moving, SelfOther::own as fn(SelfOther) -> f64),
                        (1 - moving, SelfOther::other),
                    ] {
                        let (force, torque) = (3 * sphere, 6 + 3 * sphere);
                        let about = pick(loads.yb);
                        let is_own = sphere == moving;
                        match (axis, is_spin) {
                            (2, false) => entries[force + 2] = 6.0 * PI * unit * pick(loads.xa),
                            (2, true) => {
                                entries[torque + 2] = 8.0 * PI * unit.powi(3) * pick(loads.xc)
                            }
                            // t = x or y, d x t = side (y or -x).
                            (_, false) => {
                                entries[force + axis] = 6.0 * PI * unit * pick(loads.ya);
                                let spin_sign = side * if axis == 0 { 1.0 } else { -1.0 };
                                let by_fluid = 4.0
                                    * PI
                                    * unit
                                    * unit
                                    * about
                                    * if is_own { 1.0 } else { -1.0 };
                                entries[torque + 1 - axis] = -spin_sign * by_fluid;
                            }
                            (_, true) => {
                                entries[torque + axis] = 8.0 * PI * unit.powi(3) * pick(loads.yc);
                                // A spin about y is one about side (d x t) with t = x; one about x with t = y is about -side (d x t).
                                let spin_sign = side * if axis == 1 { 1.0 } else { -1.0 };
                                entries[force + 1 - axis] =
                                    -spin_sign * 4.0 * PI * unit * unit * about;
                            }
                        }
                    }
                    for (row, value) in entries.into_iter().enumerate() {
                        put(row, (column + 1).to_string(), value);
                    }
                }
            }
        }
    }
    text
}

#[test]
fn a_matrix_of_resistances_says_the_loads_that_it_was_made_of_and_breaks_no_law() {
    let gaps = [0.05, 1.0];
    for (unit, header) in [
        (1.0, "#! matrix = \"resistance\"\n"),
        (2.5, "#! matrix = \"resistance\"\n#! radius = 2.5\n"),
    ] {
        let submission = Submission::parse(&resistance_file(&gaps, unit, header)).unwrap();
        for (answer, gap) in submission.answers().iter().zip(gaps) {
            assert_relative_eq!(answer.gap.eps(), gap, max_relative = 1e-15);
            let exact = exact_values(gap);
            for (quantity, value) in answer.values.iter() {
                assert_relative_eq!(
                    value,
                    exact.get(quantity).unwrap(),
                    epsilon = 1e-14,
                    max_relative = 1e-13
                );
            }
            assert_eq!(answer.values.iter().count(), 10);
            let laws = answer.laws.as_ref().unwrap();
            assert!(laws.asymmetry.0 < 1e-9 && laws.images.0 < 1e-12, "{laws:?}");
            assert!(laws.smallest_eigenvalue > 0.1, "{laws:?}");
        }
    }
}

#[test]
fn a_matrix_shows_what_ten_scalars_hide() {
    let text = resistance_file(&[0.1], 1.0, "#! matrix = \"resistance\"\n");
    let laws = |text: &str| {
        Submission::parse(text).unwrap().answers()[0]
            .laws
            .clone()
            .unwrap()
    };
    // The force on sphere 1 across the line of centres, by a spin of sphere 2.
    let entry = text
        .lines()
        .find(|line| line.starts_with("0.1,1,11,"))
        .unwrap();
    let value: f64 = entry.rsplit(',').next().unwrap().parse().unwrap();
    let torn = laws(&text.replace(entry, &format!("0.1,1,11,{:?}", value + 1.0)));
    let unit = 4.0 * std::f64::consts::PI;
    assert_relative_eq!(torn.asymmetry.0, 1.0 / unit, max_relative = 1e-6);
    assert!(
        torn.asymmetry.1.contains("(1, 11)") && torn.asymmetry.1.contains("(11, 1)"),
        "{torn:?}"
    );
    assert_relative_eq!(torn.images.0, 1.0 / unit, max_relative = 1e-6);
    // A drag of the wrong sign.
    let entry = text
        .lines()
        .find(|line| line.starts_with("0.1,9,9,"))
        .unwrap();
    let value: f64 = entry.rsplit(',').next().unwrap().parse().unwrap();
    let wrong = laws(&text.replace(entry, &format!("0.1,9,9,{:?}", -value)));
    assert!(wrong.smallest_eigenvalue < -0.5, "{wrong:?}");
}

#[test]
fn val_the_matrix_of_a_public_code_says_what_its_named_values_say() {
    let of = |name: &str| Submission::parse(fixtures::peer(name).unwrap()).unwrap();
    let (matrix, named) = (of("pystokes-matrix"), of("pystokes"));
    for answer in matrix.answers() {
        // Slip columns of both squirmers and all orientations among them.
        assert_eq!(answer.values.iter().count(), 22);
        for (quantity, value) in answer.values.iter() {
            let truth = self::value(&named, answer.gap.eps(), quantity.name());
            // The second mode was scaled at r = 1e4 in one of them.
            assert_relative_eq!(value, truth, epsilon = 4e-9, max_relative = 1e-12);
        }
        let laws = answer.laws.as_ref().unwrap();
        assert!(
            laws.asymmetry.0 < 1e-12 && laws.images.0 < 1e-12 && laws.smallest_eigenvalue > 0.0,
            "{laws:?}"
        );
    }
    // A viscosity in the header; symmetric, but its two spheres are not alike.
    let (matrix, named) = (of("jfsd-matrix"), of("jfsd"));
    let at = |gap: f64| {
        matrix
            .answers()
            .iter()
            .find(|answer| (answer.gap.eps() - gap).abs() < 1e-9)
            .unwrap()
    };
    for (quantity, value) in at(0.1).values.iter() {
        assert_relative_eq!(
            value,
            self::value(&named, 0.1, quantity.name()),
            epsilon = 1e-6
        );
    }
    let laws = at(0.1).laws.as_ref().unwrap();
    assert!(laws.asymmetry.0 < 1e-7, "{laws:?}");
    assert_relative_eq!(laws.images.0, 0.0197, epsilon = 1e-3);
}

#[test]
fn units_of_modes_are_taken_out_and_a_calibration_is_kept_apart() {
    let rows = "gap,name,value\n1,XF1_1,6\n1,UX1_2,3\n1,X11A,2\n";
    let header = "#! mode_units = [2, 0.5]\n#! slip_calibration = [1.5, 10]\n";
    let submission = Submission::parse(&format!("{header}{rows}")).unwrap();
    for (name, raw, calibrated) in [
        ("XF1_1", 3.0, 4.5),
        ("UX1_2", 6.0, 60.0),
        ("X11A", 2.0, 2.0),
    ] {
        assert_relative_eq!(value(&submission, 1.0, name), raw);
        let of = submission.answers()[0]
            .values
            .calibrated(submission.header());
        assert_relative_eq!(of.get(quantity(name)).unwrap(), calibrated);
    }
}

#[test]
fn straight_lines_are_drawn_where_the_header_says_so() {
    let rows = "gap,name,value\n1,X11A,4\n1,X12A,-1\n4,X11A,1\n4,X12A,0\n";
    let at = |header: &str, gap: f64| {
        let model = SubmittedModel::new(&Submission::parse(&format!("{header}{rows}")).unwrap());
        let loads = model
            .unwrap()
            .loads(Gap::new(gap).unwrap(), LoadSet::axial(0))
            .unwrap();
        [loads.xa.own(), loads.xa.other()]
    };
    for (header, gap) in [
        ("#! interpolation = \"linear\"\n", 2.5),
        ("#! interpolation = \"log-linear\"\n", 2.0),
    ] {
        let [own, other] = at(header, gap);
        assert_relative_eq!(own, 2.5, max_relative = 1e-14);
        assert_relative_eq!(other, -0.5, max_relative = 1e-14);
    }
    let error = |header: &str| {
        let submission = Submission::parse(&format!("{header}{rows}")).unwrap();
        SubmittedModel::new(&submission).unwrap_err().to_string()
    };
    assert!(error("").contains("too few gaps (2): at least 4"));
    assert!(error("#! interpolation = \"none\"\n").contains("moves no pair"));
}

#[test]
fn val_a_file_of_mobilities_moves_a_pair_as_the_loads_do_that_they_follow_from() {
    let gaps: Vec<f64> = (0..40)
        .map(|k| 1e-2 * 10_f64.powf(f64::from(k) * 0.085))
        .collect();
    let mut text = "gap,name,value\n".to_owned();
    for &gap in &gaps {
        for (quantity, value) in derived(&exact_values(gap)).iter() {
            text += &format!("{gap:?},{quantity},{value:?}\n");
        }
    }
    let model = SubmittedModel::new(&Submission::parse(&text).unwrap()).unwrap();
    let set = LoadSet::all(2);
    for gap in gaps {
        let gap = Gap::new(gap).unwrap();
        let (found, exact) = (
            model.loads(gap, set).unwrap(),
            Exact::new().loads(gap, set).unwrap(),
        );
        let (name, error) = found.worst_error(&exact);
        assert!(error < 1e-9, "{name} {error:e}");
    }
    let torn: String = text
        .lines()
        .filter(|line| !line.contains("OY2_2"))
        .map(|line| format!("{line}\n"))
        .collect();
    let model = SubmittedModel::new(&Submission::parse(&torn).unwrap()).unwrap();
    let error = model.loads(Gap::new(1.0).unwrap(), set).unwrap_err();
    assert!(error.to_string().contains("OY2_2"), "{error}");
}

#[test]
fn every_mistake_in_header_columns_and_matrices_is_told_in_one_line() {
    let named = "gap,name,value\n1,X11A,2\n";
    let matrix = resistance_file(&[0.1], 1.0, "");
    let declared = format!("#! matrix = \"resistance\"\n{matrix}");
    for (text, message) in [
        (
            format!("#! modle = \"mine\"\n{named}"),
            "header: unknown field `modle`",
        ),
        (format!("#! model = mine\n{named}"), "header: "),
        (
            format!("#! radius = -1\n{named}"),
            "header: radius -1.0 is not allowed",
        ),
        (
            format!("#! mode_units = [0]\n{named}"),
            "header: mode_units [0.0] is not allowed",
        ),
        (
            format!("#! model = \"{}\"\n{named}", "x".repeat(501)),
            "header: model '",
        ),
        (
            format!("#! interpolation = \"spline\"\n{named}"),
            "header: unknown variant `spline`",
        ),
        (
            format!("#! matrix = \"mobility\"\n{named}"),
            "header: matrix is declared, and the file has named values",
        ),
        (
            format!("#! range = [1, 2]\n{named}"),
            "header: range and noise belong to processes",
        ),
        (matrix.clone(), "header: matrix is missing"),
        (
            "gap,name,value,time\n1,X11A,2,3\n".to_owned(),
            "column 'time' is not allowed: columns are gap, name and value",
        ),
        (
            "gap,name,value,ratio\n1,X11A,2,0.5\n".to_owned(),
            "line 2: ratio '0.5' is not allowed: give 1",
        ),
        (
            "gap,row,col,name\n".to_owned(),
            "there is no column 'value': needed are gap, row, col and value",
        ),
        (
            format!("{declared}0.1,13,1,0\n"),
            "line 147: row '13' is not allowed: give a whole number from 1 to 12",
        ),
        (
            format!("{declared}0.1,1,B9_1z,0\n"),
            "line 147: col 'B9_1z' is not allowed",
        ),
        (
            format!("{declared}0.1,1,B1_1z,0\n"),
            "row 2 of column B1_1z is missing at the gap 0.1",
        ),
        (
            format!("{declared}0.1,1,1,0\n"),
            "line 147: row 1 of column 1 at the gap 0.1 is already in line 3",
        ),
        (
            format!("#! viscosity = 1e-200\n{declared}"),
            "the matrix at the gap 0.1 is not one of spheres with the radius and the viscosity of the header: entry (1, 1) is",
        ),
        (
            format!("#! radius = 1e-300\n{declared}"),
            "gap 1e299 (radii) is not allowed: give gaps from 1e-12 to 1e9",
        ),
        (
            "#! mode_units = [1e-10]\ngap,name,value\n1,XF1_1,1e300\n".to_owned(),
            "XF1_1 at the gap 1.0 is no finite number with the units",
        ),
        (
            "#! slip_calibration = [1, 1e10]\ngap,name,value\n1,UX2_2,1e300\n".to_owned(),
            "UX2_2 at the gap 1.0 is no finite number with the units",
        ),
        (
            format!("#! mode_units = {:?}\n{named}", vec![1e100; 100_000]),
            "header: mode_units [1e100, 1e100",
        ),
        (
            format!("#! {} = 1\n{named}", "\u{1b}".repeat(1000)),
            "header: ",
        ),
        (
            declared.replace("0.1,5,7,", "0.2,5,7,"),
            "row 5 of column 7 is missing at the gap 0.1",
        ),
    ] {
        let error = Submission::parse(&text).unwrap_err().to_string();
        assert!(error.starts_with(message), "{error}\n{message}");
        assert!(
            error.len() < 300 && !error.contains(char::is_control),
            "{error}"
        );
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn mutated_headers_and_matrices_give_finite_values_or_one_line(
        kind in prop::sample::select(vec!["mobility", "resistance", "grand"]),
        keys in prop::collection::vec((
            prop::sample::select(vec![
                "model", "citation", "radius", "viscosity", "mode_units", "slip_calibration", "interpolation", "seconds_per_gap", "range", "noise",
                "matrix", "modle", "", "[x]", "\u{1b}",
            ]),
            prop::sample::select(vec![
                "\"mine\"", "1", "2.5", "1e-300", "1e300", "-1", "nan", "inf", "[1, 2]", "[1e-308, 1e308, 0.5]", "[]", "\"linear\"", "\"none\"", "{}",
                "\"\\u001b\"", "\"", "1979-05-27",
            ]),
        ), 0..4),
        mutations in prop::collection::vec((any::<prop::sample::Index>(), 0_usize..4, prop::sample::select(vec![
            "", "0", "9", "e308", "e-320", "-", ",", "\n", "\"", "#", "#!", "nan", "B1_1z", "B2_2xz", "\u{feff}", "0.1,1,1,0\n",
        ])), 0..3)
    ) {
        let header: String = keys.iter().map(|(key, value)| format!("#! {key} = {value}\n")).collect();
        let header = format!("#! matrix = \"{kind}\"\n{header}");
        let mut text = resistance_file(&[0.1], 1.0, &header);
        for row in 1..=12 {
            text += &format!("0.1,{row},B1_1z,{}\n", if row == 3 { 1e300 } else { 0.0 });
        }
        for (place, cut, piece) in mutations {
            let mut from = place.index(text.len());
            while !text.is_char_boundary(from) {
                from -= 1;
            }
            let cut: usize = text[from..].chars().take(cut).map(char::len_utf8).sum();
            text.replace_range(from..from + cut, piece);
        }
        match Submission::parse(&text) {
            Ok(submission) => for answer in submission.answers() {
                let calibrated = answer.values.calibrated(submission.header());
                prop_assert_eq!(calibrated.iter().count(), answer.values.iter().count());
                let laws = answer.laws.as_ref().unwrap();
                let all = [laws.asymmetry.0, laws.images.0, laws.smallest_eigenvalue];
                prop_assert!(all.iter().all(|law| law.is_finite()), "{:?}", laws);
            },
            Err(error) => {
                let error = error.to_string();
                prop_assert!(error.len() < 400 && !error.contains(char::is_control), "{}", error);
            }
        }
    }
}

#[test]
fn slip_columns_that_do_not_agree_with_each_other_break_the_law_of_equal_spheres() {
    let text = fixtures::peer("pystokes-matrix").unwrap();
    let worst = |text: &str| {
        let submission = Submission::parse(text).unwrap();
        let laws = submission
            .answers()
            .iter()
            .filter_map(|answer| answer.laws.as_ref());
        laws.map(|laws| laws.images.clone())
            .fold((0.0, String::new()), |worst, law| {
                if law.0 > worst.0 { law } else { worst }
            })
    };
    assert!(worst(text).0 < 1e-12);
    for column in ["B1_1z", "B1_2x", "B2_1xz", "B2_2xz", "B2_1z"] {
        let tripled: String = (text.lines())
            .map(|line| match line.split(',').collect::<Vec<_>>()[..] {
                [gap, row, col, value] if col == column => {
                    format!(
                        "{gap},{row},{col},{:?}\n",
                        3.0 * value.parse::<f64>().unwrap()
                    )
                }
                _ => format!("{line}\n"),
            })
            .collect();
        let (size, entries) = worst(&tripled);
        assert!(
            size > 0.01 && entries.contains("slip columns"),
            "{column}: {size} {entries}"
        );
    }
}
