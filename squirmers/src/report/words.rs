//! The prose of the page.

use scene::Outcome;

use compare::{Approach, OffsetRow};

/// Paragraphs under the title.
pub(super) fn lead() -> Vec<String> {
    vec![
        "When two swimming microorganisms collide, how far can lubrication theory be trusted, and \
         what does a better answer cost? Two spherical squirmers of radius a meet in a Stokes fluid. \
         Each encounter is computed by lubrication theory, which acts only at gaps up to one radius, \
         and by full hydrodynamics."
            .to_owned(),
        "Lengths are in radii a, times in a/V_s (V_s is the swimming speed), angles in degrees, anticlockwise \
         positive. The squirmer parameter is β = B2/B1: pushers have β < 0, pullers β > 0. The cases are those of \
         Darveniza, Ishikawa, Pedley & Brumley, Pairwise scattering and bound states of spherical microorganisms (2022)."
            .to_owned(),
    ]
}

/// The definition of the errors of the loads.
pub(super) const ERRORS: &str = "Exact loads are those of bispherical series. Errors are relative to the larger of the \
     load and 1.";

/// The set-up of the panels under gravity.
pub(super) const BOTTOM_HEAVY: &str = "Gravity turns bottom-heavy squirmers upward at the rate k sin(θ), k = G \
     V_s/(8πa), where θ is the angle to the upward direction. The paper does not print all starts of Fig. 8. The \
     other starts are chosen here so that lubrication theory gives the outcome that the paper describes.";

/// Names the pairs that are bound without an offset. A small offset can part them.
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
            "Without an offset these pairs stay bound, and the change is that of the orientation at the \
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
                "Squirmers with opposed velocities start at (-δx/2, 5) and (δx/2, -5). In lubrication \
                 theory pairs with δx > {} do not interact.",
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
        "Share of starts that end in a drifting orbit, as a function of the bottom-heaviness."
    } else if file_name.contains("bottom-heavy") {
        "Paths under gravity, which acts along -y, from (-1.5, 0) and (1.5, 0). Each pair has a window of its own. The \
         paper gives G and β of (a), (b) and (c), β of (d), and the initial angles of (e) and (f). The other values are \
         round numbers chosen here, which give the behaviour that the paper describes."
    } else if file_name.contains("load-errors") {
        "Error of each load against the exact load. At gaps above 1 lubrication theory has the loads \
         of lone squirmers."
    } else if file_name.contains("trajectories") {
        "Paths of both squirmers (solid: squirmer 1, dashed: squirmer 2), with dots at equal times, and the \
         spheres to scale at closest approach. Paths by lubrication theory end with a straight flight; \
         the others end at a distance of the centres of 12."
    } else if file_name.contains("outcomes") {
        "Upper row: one start for each outcome of lubrication theory. Lower row: the same starts by exact \
         hydrodynamics."
    } else if file_name.contains("examples") {
        "Neutral squirmers from four starts, by lubrication theory (upper row) and by exact hydrodynamics (lower row)."
    } else if file_name.contains("growth") {
        "Angle by which an outgoing orientation turns out of the plane per offset out of it, the larger of the two; hatched where a pair does not part."
    } else if file_name.contains("scatter") {
        "Deflections (for a bound pair: change of orientation up to the end of the run), interaction time τ (at \
         gaps up to 1), and outcome."
    } else if file_name.contains("ratios") {
        "Share of each outcome by lubrication theory (upper row) and by exact hydrodynamics (middle row), and share of the \
         incoming angles in each class of difference between the two (lower row), for radii in these ratios."
    } else if file_name.contains("cargo") {
        "Displacement of the passive sphere along the swimmer's first direction (upper row) and across it, towards the \
         swimmer's path (lower row), for spheres of λ times the swimmer's radius."
    } else if file_name.contains("kinetics") {
        "Coefficients of a dilute suspension by its collisions, over the number of squirmers in a volume, and share of the pairs that do \
         not part. Bars: two standard errors of the sampling to each side."
    } else if file_name.contains("fates") {
        "Share of each outcome."
    } else if file_name.contains("trust-dz") {
        "Share of the incoming angles in each class of difference between lubrication theory and exact hydrodynamics."
    } else if file_name.contains("trust") {
        "Difference between lubrication theory and exact hydrodynamics."
    } else if file_name.contains("flow") {
        "Flow in the plane of motion at the closest approach. Lubrication theory has no such picture: it knows forces and torques, and no \
         flow."
    } else if file_name.contains("stress") {
        "Stresslets of a sphere by its own motion or slip and by that of the other one, and rates of work of slip. Lubrication theory \
         has no stresslet of its own: it is that of lone squirmers and what diverges here."
    } else if file_name.contains("sensitivity") {
        "Offset out of the plane at which an outgoing orientation turns by 6 degrees in space: by the motion itself, and by its derivative."
    } else if file_name.contains("deflection") {
        "Deflection of the squirmers as a function of the offset of their paths."
    } else {
        "Change of the outgoing orientation as a function of the offset out of the plane."
    }
}
