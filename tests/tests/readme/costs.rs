//! Times, as the kept measurement has them.

use super::*;

/// One measured cost, a line of `fixtures/measured-costs.csv`.
#[derive(serde::Deserialize)]
struct Cost {
    finding: String,
    of: String,
    value: f64,
}

/// To one digit, with commas between thousands.
fn about(value: f64) -> String {
    let unit = 10_f64.powf(value.log10().floor());
    let digits = format!("{:.0}", (value / unit).round() * unit);
    let from_right = digits.char_indices().map(|(i, c)| (digits.len() - i, c));
    from_right
        .flat_map(|(left, c)| {
            (left % 3 == 0 && left < digits.len())
                .then_some(',')
                .into_iter()
                .chain([c])
        })
        .collect()
}

/// Times are those of one quiet machine, kept with what measured them; README says what they come to.
#[test]
fn readme_times_are_those_that_were_measured() {
    let mut readme = Claims::default();
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../fixtures/measured-costs.csv"
    );
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_path(path)
        .unwrap();
    let costs: Vec<Cost> = reader.deserialize().map(Result::unwrap).collect();
    let measured = |finding: &str, of: &str| {
        (costs
            .iter()
            .find(|cost| cost.finding == finding && cost.of == of))
        .unwrap_or_else(|| panic!("no '{finding}' of {of}"))
        .value
    };
    let collision = "slowest collision of Fig. 6, tol 1e-8";
    let ratio = measured("right-hand side over lubrication's", "exact-table");
    readme.says(&format!(
        "a collision takes up to {:.2} ms by exact loads, {:.3} ms by lubrication theory ({ratio:.1} and 1 for a \
         right-hand side)",
        1e-3 * measured(collision, "exact-table"),
        1e-3 * measured(collision, "lt")
    ));
    let direct = "solved trajectory over tabulated, least";
    readme.says(&format!(
        "boundary elements (level 1) solved at every step take {} times as long as the exact table",
        about(measured(direct, "bem-1"))
    ));
    readme.says(&format!(
        "SciPy's solver of the same method {} times as long for lubrication theory",
        about(measured("SciPy's solver over ours", "lt, dx 1"))
    ));
    readme.says(&format!(
        "heyoka, which moves eight pairs at once in the lanes of a processor, is {:.0} times as fast",
        measured("ours over heyoka's, every lane busy", "lt, map at beta 0")
    ));
    readme.says(&format!(
        "The tables take {:.0} s on two cores",
        measured("building the table", "bem-3-table")
    ));
}
