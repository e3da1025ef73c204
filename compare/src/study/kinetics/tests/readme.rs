//! The numbers of docs/KINETICS.md.

use super::*;

/// The rows of the first table of coefficients: method, beta, and the numbers.
fn table() -> Vec<(Method, f64, Vec<f64>)> {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/KINETICS.md");
    let text = std::fs::read_to_string(file).unwrap();
    let begins = text.find("| method | β |").unwrap();
    (text[begins..].lines().skip(2))
        .take_while(|line| line.starts_with('|'))
        .map(|line| {
            let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
            let number = |cell: &&str| cell.replace('−', "-").parse::<f64>().unwrap();
            let method = Method::named(cells[0]).unwrap();
            (
                method,
                number(&cells[1]),
                cells[2..].iter().map(number).collect(),
            )
        })
        .collect()
}

#[test]
fn readme_coefficients_are_those_of_the_page() {
    let rows = table();
    assert!(rows.len() >= 9, "{}", rows.len());
    let models: Vec<Model> = [Method::Lt, Method::LtCorrected, Method::Exact]
        .map(model)
        .into();
    for (method, beta, told) in rows {
        let model = models
            .iter()
            .find(|model| model.method() == method)
            .unwrap();
        let collider = Collider::new(model, beta, &options()).unwrap();
        let of = sampled(
            &|incoming| collider.collide(incoming, Begins::Infinity, true),
            CONTACT,
            128,
        );
        let values: [fn(&Coefficients) -> f64; 6] = [
            |of| 100.0 * of.means.parting,
            |of| of.tau,
            |of| of.rotation,
            |of| of.displacement,
            |of| of.alignment,
            |of| of.growth,
        ];
        assert_eq!(values.len(), told.len());
        for (value, told) in values.iter().zip(told) {
            let all: Vec<f64> = of.iter().map(value).collect();
            let (mean, error) = mean_and_error(&all);
            // Half of the last digit.
            let rounding = 0.006 * told.abs().max(1.0);
            let off = (mean - told).abs();
            assert!(
                off < 4.0 * error + rounding,
                "{method} {beta}: {mean} +- {error}, the page says {told}"
            );
        }
    }
}

/// README and docs/FINDINGS.md say what lubrication theory makes of the rotational diffusivity: the ratios of the table.
#[test]
fn readme_says_of_the_rotational_diffusivity_what_the_table_says() {
    let rows = table();
    let rotation = |method: Method, beta: f64| {
        let mut found = rows.iter();
        let row = found.find(|(m, b, _)| *m == method && (b - beta).abs() < 1e-9);
        row.unwrap().2[2]
    };
    let ratio = |beta: f64| rotation(Method::Lt, beta) / rotation(Method::Exact, beta);
    let [pushers, neutral, pullers] = [-5.0, 0.0, 5.0].map(ratio);
    let told = format!("is {pushers:.2}, {neutral:.1} and {pullers:.2} times the exact one");
    for file in ["README.md", "docs/FINDINGS.md"] {
        let path = format!("{}/../{file}", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(path).unwrap();
        let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(words.contains(&told), "{file} lacks: {told}");
    }
}
