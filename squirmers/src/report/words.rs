//! The prose of the page.

use scene::Outcome;

use compare::{Approach, OffsetRow};

/// Paragraphs under the title.
pub(super) fn lead() -> Vec<String> {
    vec![
        "When two swimming microorganisms collide, how far can lubrication theory be trusted, and \
         what does a better answer cost? Two spherical squirmers of radius a meet in a Stokes fluid. \
         Each encounter is computed with the loads of lubrication theory, which acts only where the \
         gap is at most one radius, and with those of full hydrodynamics."
            .to_owned(),
        "Lengths are in radii a, times in a/V_s, angles in degrees, anticlockwise positive. The \
         cases are those of Darveniza, Ishikawa, Pedley & Brumley, Pairwise scattering and bound \
         states of spherical microorganisms (2022)."
            .to_owned(),
    ]
}

/// What the errors of the loads are relative to.
pub(super) const ERRORS: &str = "Exact loads are those of bispherical series. Errors are relative to the larger of the \
     load and 1.";

/// How the panels under gravity are set up.
pub(super) const BOTTOM_HEAVY: &str = "Gravity turns bottom-heavy squirmers upward at the rate k sin(θ), k = G \
     V_s/(8πa), θ the angle to up. Not all starts of Fig. 8 are printed; those that are not are chosen here so that \
     lubrication theory does what the paper says of the panel.";

/// Says which pairs are bound without an offset: a small one can free them.
pub(super) fn bound_in_plane(rows: &[OffsetRow]) -> String {
    let mut bound: Vec<_> = (rows.iter())
        .filter(|row| row.outcome_in_plane != Outcome::Scattered.to_string())
        .map(|row| {
            let OffsetRow {
                case,
                method,
                beta,
                dx,
                outcome_in_plane,
                ..
            } = row;
            format!("{case}, β = {beta}, δx = {dx} by {method} ({outcome_in_plane})")
        })
        .collect();
    bound.dedup();
    if bound.is_empty() {
        "Without an offset every pair parts.".to_owned()
    } else {
        format!(
            "Without an offset these stay bound, and the change is that of the orientation at the \
             end of the run: {}.",
            bound.join("; ")
        )
    }
}

/// Title and prose of an approach.
pub(super) fn encounters(approach: Approach) -> (&'static str, String) {
    match approach {
        Approach::HeadOn => (
            "Opposed approach (Fig. 6)",
            format!(
                "Squirmers of opposed velocities start at (-δx/2, 5) and (δx/2, -5). Under lubrication \
                 theory those with δx > {} pass without noticing each other.",
                2.0 + lt::CUTOFF
            ),
        ),
        Approach::Orthogonal => (
            "Approach at right angles (Fig. 7)",
            "Squirmers start at (0, 10), swimming along x, and (10 - δx, 0), swimming along y."
                .to_owned(),
        ),
    }
}

/// Caption of the picture in a file.
pub(super) fn caption(file_name: &str) -> &'static str {
    if file_name.contains("gravity-fates") {
        "Share of starts that end in a drifting orbit, against bottom-heaviness."
    } else if file_name.contains("bottom-heavy") {
        "Paths under gravity, which acts along -y, from (-1.5, 0) and (1.5, 0), each in a window of its own. G and β of (a), (b) and (c), β of (d) and the starting angles of (e) and \
         (f) are the paper's; the others are not printed there and are round values that show what it says."
    } else if file_name.contains("load-errors") {
        "Error of each load against the exact one. Beyond a gap of 1 lubrication theory has the loads \
         of lone squirmers."
    } else if file_name.contains("trajectories") {
        "Paths of both squirmers (solid: first, dashed: second), with dots at equal times and the \
         spheres, to scale, at closest approach. Lubrication paths are continued by straight flight; \
         the others end where the two, receding, are 12 apart."
    } else if file_name.contains("outcomes") {
        "One start for each outcome of lubrication theory, above; below, the same starts by exact \
         hydrodynamics."
    } else if file_name.contains("examples") {
        "Neutral squirmers from four starts by lubrication theory, above, and by exact hydrodynamics."
    } else if file_name.contains("scatter") {
        "Deflections (of a bound pair: change of orientation up to the end of the run), time spent at gaps \
         up to 1, and outcome."
    } else if file_name.contains("fates") {
        "Share of each outcome."
    } else if file_name.contains("trust-dz") {
        "Shares of the incoming angles by how far lubrication theory is from exact hydrodynamics."
    } else if file_name.contains("trust") {
        "Difference of lubrication theory from exact hydrodynamics."
    } else if file_name.contains("deflection") {
        "Deflection of the squirmers against the offset of their paths."
    } else {
        "Change of the outgoing orientation against the offset out of the plane."
    }
}
