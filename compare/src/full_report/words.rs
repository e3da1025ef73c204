//! The prose of the page.

use scene::Outcome;

use crate::{Approach, OffsetRow};

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

/// What the errors of the loads mean.
pub(super) fn errors() -> Vec<String> {
    vec![
        "Exact loads are those of bispherical series, good to about ten digits at every gap. Errors \
         are relative to the larger of the load and 1."
            .to_owned(),
        "The slope of the axial squirming force XF in ln(1/eps), fitted to the exact loads at gaps \
         below 1e-3, is 3.000 for every mode; those of YF and YT are 1.000, 1.600 and 0.400. The \
         paper prints 9/4 for XF, 3/4 of the true slope, so as published lubrication theory draws \
         two facing squirmers together too weakly, ever more so as the gap closes: its error in XF \
         grows as the logarithm of the gap, while that of the corrected form tends to a constant. \
         That constant is what lubrication theory leaves out, and it is of the size of the \
         logarithm itself at every gap that a collision reaches: the corrected slope alone does \
         not make the deflections right."
            .to_owned(),
    ]
}

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
pub(super) fn encounters(approach: Approach) -> (&'static str, &'static str) {
    match approach {
        Approach::HeadOn => (
            "Opposed approach (Fig. 6)",
            "Squirmers of opposed velocities start at (-δx/2, 5) and (δx/2, -5). Under lubrication \
             theory those with δx > 3 pass without noticing each other.",
        ),
        Approach::Orthogonal => (
            "Approach at right angles (Fig. 7)",
            "Squirmers start at (0, 10), swimming along x, and (10 - δx, 0), swimming along y.",
        ),
    }
}

/// Caption of the picture in a file.
pub(super) fn caption(file_name: &str) -> &'static str {
    if file_name.contains("load-errors") {
        "Error of each load against the exact one. Beyond a gap of 1 lubrication theory has the loads \
         of lone squirmers."
    } else if file_name.contains("trajectories") {
        "Paths of both squirmers (solid: first, dashed: second), with dots at equal times and the \
         spheres, to scale, at closest approach. Lubrication paths are continued by straight flight; \
         the others end where the two, receding, are 12 apart."
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
