//! Deflections of the paper's encounters.

use super::*;

#[test]
fn readme_table_of_deflections() {
    let mut readme = Claims::default();
    for (approach, beta, dx) in [
        (Approach::HeadOn, 5.0, 1.0),
        (Approach::HeadOn, 5.0, 2.0),
        (Approach::HeadOn, 5.0, 3.0),
        (Approach::Orthogonal, -1.0, 1.0),
        (Approach::Orthogonal, 1.0, 1.0),
        (Approach::Orthogonal, 5.0, 1.0),
    ] {
        let case = case(approach, beta, dx);
        let name = match approach {
            Approach::HeadOn => "opposed",
            Approach::Orthogonal => "right angles",
        };
        let cells = [Method::Lt, Method::LtCorrected, Method::Bem, Method::Exact].map(|method| {
            let encounter = encounter(&case, method);
            let angle = deflections(&case, method)[0];
            match (encounter.scattered(), angle.abs() < 5e-4) {
                (false, _) => "bound".to_owned(),
                (true, true) => "0".to_owned(),
                (true, false) => format!("{angle:.3}"),
            }
        });
        readme.says(&format!(
            "| {name}, β = {beta}, δx = {dx} | {} |",
            cells.join(" | ")
        ));
    }
}

#[test]
fn readme_boundary_elements_against_the_exact_series() {
    let mut readme = Claims::default();
    let worst = (paper_cases().iter())
        .flat_map(|case| {
            let [a, b] = [Method::Bem, Method::Exact].map(|m| deflections(case, m));
            [0, 1].map(|k| (a[k] - b[k]).abs())
        })
        .fold(0.0, f64::max);
    readme.says(&format!(
        "within {worst:.3}° in every encounter of Figs 6 and 7"
    ));
}

#[test]
fn readme_lubrication_theory_is_a_caricature() {
    let mut readme = Claims::default();
    let of = |approach, beta, dx, method| deflections(&case(approach, beta, dx), method);
    let ratio = |dx: f64, method| {
        of(Approach::HeadOn, 5.0, dx, method)[0] / of(Approach::HeadOn, 5.0, dx, Method::Exact)[0]
    };
    let ratios: Vec<f64> = [1.0, 2.0]
        .into_iter()
        .flat_map(|dx| [Method::Lt, Method::LtCorrected].map(|method| ratio(dx, method)))
        .collect();
    let (least, most) = ends(&ratios);
    readme.says(&format!("by {least:.1} to {most:.1} times too much"));
    for dx in [3.0, 5.0, 10.0] {
        assert!(of(Approach::HeadOn, 5.0, dx, Method::Lt)[0].abs() < 1e-9);
    }
    readme.says("not at all from δx = 3 on");
    let off: Vec<f64> = [-1.0, 1.0]
        .into_iter()
        .flat_map(|beta| {
            let [a, b] =
                [Method::Lt, Method::Exact].map(|m| of(Approach::Orthogonal, beta, 1.0, m));
            [0, 1].map(|k| (a[k] - b[k]).abs())
        })
        .collect();
    let (least, most) = ends(&off);
    readme.says(&format!(
        "{least:.0}° to {most:.0}° off at δx = 1 for β = ±1"
    ));
    for (beta, dx) in [(1.0, 2.0), (1.0, 3.0), (-1.0, 3.0)] {
        let [a, b] = [Method::Lt, Method::Exact].map(|m| of(Approach::Orthogonal, beta, dx, m)[0]);
        assert!(a * b < 0.0, "beta {beta}, dx {dx}: {a} and {b}");
    }
    readme.says("the wrong sign for the first squirmer at δx = 2 (β = 1) and 3 (both)");
    for dx in [1.0, 2.0] {
        let case = case(Approach::Orthogonal, 5.0, dx);
        assert!(!encounter(&case, Method::Lt).scattered());
        assert!(encounter(&case, Method::Exact).scattered());
    }
    readme.says("binds strong pullers (β = 5, δx = 1 and 2) that full hydrodynamics parts");
}

#[test]
fn readme_an_offset_out_of_the_plane() {
    let mut readme = Claims::default();
    let defaults = Defaults::paper().unwrap().offset;
    let model = set_up(Method::Exact, LoadSet::all(2));
    let (rows, _) = offsets(&[model], &defaults.cases(), &[0.1, 0.5], &sweep_options());
    let most = |approach: &str, strong: bool, dz: f64| {
        (rows.iter())
            .filter(|r| r.case == approach && (r.dz - dz).abs() < 1e-9)
            .filter(|r| (r.beta > 1.0) == strong)
            .map(|r| r.change1_deg.max(r.change2_deg))
            .fold(0.0, f64::max)
    };
    readme.says(&format!(
        "by up to {:.0}° in opposed encounters and {:.0}° at right angles for β = ±1",
        most("head-on", true, 0.5),
        most("orthogonal", false, 0.5)
    ));
    readme.says(&format!(
        "0.1 radii change the outgoing direction by {:.0}°",
        most("orthogonal", true, 0.1)
    ));
}
