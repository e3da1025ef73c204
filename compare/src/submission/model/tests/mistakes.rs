//! Files that are refused.

use proptest::prelude::*;

use super::*;

#[test]
fn every_mistake_in_a_file_is_told_in_one_line() {
    let good = text_of(&[0.1, 0.2, 0.5, 1.0], without_lubrication);
    assert!(parsed(&good).is_ok());
    let with = |row: &str| format!("{good}{row}\n");
    let without = |part: &str| -> String {
        let kept = good.lines().filter(|line| !line.contains(part));
        kept.map(|line| format!("{line}\n")).collect()
    };
    let methods: String = (0..9).map(|k| format!("m{k},1,X11A,1,\n")).collect();
    let of_values = |gaps: &[f64], value: fn(f64) -> f64| {
        text_of(gaps, |gap| {
            let named = |name: &str| (name.to_owned(), value(gap.eps()));
            vec![named("X11A"), named("X12A")]
        })
    };
    let huge = of_values(&[0.1, 0.2, 0.5, 1.0], |gap| 1e308 * (0.3 - gap).signum());
    // Two gaps with the same logarithm.
    let close = of_values(&[0.1, 0.2, 0.5, 1e8, 1e8_f64.next_up()], |gap| gap);
    for (text, message) in [
        (
            String::new(),
            "there is no column 'gap': needed are gap, name and value",
        ),
        (
            good.replace("value", "worth"),
            "there is no column 'value': needed are",
        ),
        (
            good.replace("method", "gap"),
            "there is more than one column 'gap'",
        ),
        (HEADER.to_owned(), "the file has no rows"),
        (
            with("mine,1"),
            "line 18: fields: 2 are not allowed: there are 5 columns",
        ),
        (
            with("mine,0,X11A,1,"),
            "line 18: gap '0' is not allowed: give a finite number greater than 0",
        ),
        (
            with("mine,inf,X11A,1,"),
            "line 18: gap 'inf' is not allowed: give a finite",
        ),
        (
            with("mine,2,X11A,nan,"),
            "line 18: value 'nan' is not allowed: give a finite number",
        ),
        (
            with("mine,2,X11A,1,-1"),
            "line 18: error_estimate '-1' is not allowed: give none or a finite",
        ),
        (
            with("mine,2,X13A,1,"),
            "line 18: there is no quantity 'X13A': names are X11A, X12A",
        ),
        (
            with("mine,2,XF1_9,1,"),
            "line 18: there is no quantity 'XF1_9': names are",
        ),
        (
            with(&format!("mine,2,{},1,", "\t\u{1b}x".repeat(99))),
            "line 18: there is no quantity '",
        ),
        (
            with("mine,2,X11A - X12A,1,"),
            "line 18: 'X11A - X12A' is a combination of two loads, as symmetric pairs need it: give each",
        ),
        (
            with("mine,0.10,X12A,1,"),
            "line 18: X12A at the gap 0.1 is already in line 3",
        ),
        (
            format!("{HEADER}{methods}mine,1,X12A,1,\n"),
            "the file has loads of several methods: 'm0', 'm1', 'm2', 'm3', 'm4', 'm5', 'm6', 'm7', ...; keep",
        ),
        (
            with("yours,2,X11A,1,"),
            "the file has loads of several methods: 'mine', 'yours'; keep",
        ),
        (without(",0.5,"), "too few gaps (3): at least 4 are needed"),
        (
            huge,
            "X11A cannot be interpolated: its values are too large, or gaps too close to each other",
        ),
        (close, "X11A cannot be interpolated"),
        (
            "#".repeat((32 << 20) + 1),
            "the file is too large: at most 33554432 bytes are allowed",
        ),
    ] {
        let error = parsed(&text).unwrap_err().to_string();
        assert!(error.starts_with(message), "{error}\n{message}");
        assert!(
            error.len() < 300 && !error.contains(char::is_control),
            "{error}"
        );
    }
}

#[test]
fn mistakes_of_a_file_on_disk_name_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.csv");
    let read = || {
        let message = Submission::read(&path).unwrap_err().to_string();
        assert!(message.contains("mine.csv': "), "{message}");
        message
    };
    assert!(read().starts_with("cannot read '"));
    for (bytes, message) in [
        (HEADER.as_bytes(), "the file has no rows"),
        (&[0xff, 0xfe], "the file is not text in UTF-8"),
    ] {
        std::fs::write(&path, bytes).unwrap();
        assert!(read().ends_with(message));
    }
    std::fs::File::create(&path)
        .unwrap()
        .set_len(1 << 32)
        .unwrap();
    assert!(read().contains("too large"));
    let good = text_of(&[0.1, 0.2, 0.5, 1.0], without_lubrication);
    std::fs::write(&path, &good).unwrap();
    let [read, parsed] = [Submission::read(&path), Submission::parse(&good)].map(Result::unwrap);
    assert_eq!(read.checksum(), parsed.checksum());
}

proptest! {
    #[test]
    fn mutated_files_give_finite_loads_or_one_line(
        mutations in prop::collection::vec((any::<prop::sample::Index>(), 0_usize..4, prop::sample::select(vec![
            "", "0", "9", "e308", "e-320", "-", ".", ",", "\n", "\"", "#", "nan", "inf", "none", "X11A", "XF1_8", "YTC2_1",
            "\u{feff}", "é", "\r", " ", "mine,5,X11A,1,none\n",
        ])), 1..6)
    ) {
        let mut text = text_of(&[0.1, 0.2, 0.5, 1.0, 3.0], without_lubrication);
        for (place, cut, piece) in mutations {
            let mut from = place.index(text.len());
            while !text.is_char_boundary(from) {
                from -= 1;
            }
            let cut: usize = text[from..].chars().take(cut).map(char::len_utf8).sum();
            text.replace_range(from..from + cut, piece);
        }
        match parsed(&text) {
            Ok(file) => {
                let GapRange { smallest, largest } = file.range();
                for gap in [smallest, (smallest * largest).sqrt(), largest] {
                    let loads = file.loads(Gap::new(gap).unwrap(), LoadSet::axial(0));
                    if let Ok(loads) = loads {
                        prop_assert!(loads.columns().all(f64::is_finite));
                    }
                }
            }
            Err(error) => prop_assert!(!error.to_string().contains('\n')),
        }
    }
}
