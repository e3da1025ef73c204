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

/// What exact hydrodynamics changes under gravity.
pub(super) fn bottom_heavy() -> Vec<String> {
    vec![
        "Gravity turns bottom-heavy squirmers upward at the rate k sin(θ), k = G V_s/(8πa), θ the angle to \
         up. Not all starts of Fig. 8 are printed; those that are not are chosen here so that lubrication \
         theory does what the paper says of the panel. In (f) lubrication theory takes the pair 4.49 \
         times as far down as its members would go alone (the sum of both depths; the paper: 4.5)."
            .to_owned(),
        "Where the pair rights itself soon and parts, (a) and (b), exact hydrodynamics changes little. What \
         it changes is which pairs are bound. The splayed pushers of (c) stay together, but at a gap of \
         0.02 instead of 0.24, and do not oscillate: they are at their fixed distance after a time of 4. The \
         orbiting pushers of (d) part at once. The downward swimming of (e) is no state of equilibrium: the \
         pullers come as near as 0.02, turn to face each other, and after a time of 24 are on their way \
         up; started a little askew, (f), they go down 1.27 times as far as alone, not 4.49 times."
            .to_owned(),
        "Drifting orbits are the other way round too. Lubrication theory makes them of strong pushers \
         (β = -5), up to a bottom-heaviness between 2 and 2.5, as the paper says; exact hydrodynamics makes none \
         of pushers, but of strong pullers (β = 5) it makes more, up to between 2.5 and 3. From \
         there on bound pullers no longer go round: their line of centres swings to and fro while they \
         rise in loops, one swing there and back taking a time of about 150 at a bottom-heaviness of 3 (told as \
         oscillating, or as undecided where the run is too short to see it)."
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
