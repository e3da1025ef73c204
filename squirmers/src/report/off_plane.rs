//! The section "Off the plane": what an offset out of the plane does, to first order and in full.

use super::growth::{self, growth};
use super::kinetics::kinetics;
use super::written;
use crate::commands::maps::METHODS;
use crate::error::CommandError;
use crate::page::{Section, Table};
use crate::pictures;
use compare::numbers::{self, rounded};
use compare::output::OutputFolder;
use compare::study::sensitivity::{Part, SensitivityCase, SensitivityStudy};
use compare::sweep::{RunChoices, SweepOptions};
use compare::{Method, Model, ModelOptions};

/// The models of maps.
fn of_maps(models: &[Model]) -> Vec<&Model> {
    (models.iter())
        .filter(|model| METHODS.contains(&model.method()))
        .collect()
}

/// Checks that no finished rows of another command would be deleted.
pub(super) fn check(
    models: &[Model],
    sweep: &SweepOptions,
    out: &OutputFolder,
) -> Result<(), CommandError> {
    Ok(growth::maps(&of_maps(models), sweep, out)?.check()?)
}

/// The study of the paper's encounters, the maps, the bound states and what suspensions feel, written into `out`.
pub(super) fn section(
    (methods, models): (&[Method], &[Model]),
    options: &ModelOptions,
    sweep: &SweepOptions,
    out: &OutputFolder,
) -> Result<Section, CommandError> {
    let parts = Part::paper(RunChoices {
        tolerance: None,
        angles_at: f64::INFINITY,
    })?;
    let study = SensitivityStudy {
        parts: &parts,
        models,
        time_limit: sweep.time_limit,
        out,
    };
    let mut cases = Vec::new();
    study.run(&mut |case| cases.push(case))?;
    let csv = out.read("sensitivity.csv").unwrap_or_default();
    let mut section = Section {
        id: "off-plane".to_owned(),
        title: "Off the plane".to_owned(),
        finding: finding(&parts, &cases),
        prose: vec![
            "Squirmer 1 starts raised by dz/2 and squirmer 2 lowered by dz/2. To first order in dz the outgoing headings tilt out of the plane; in \
             the plane they turn at second order. The derivative comes from the linearised motion, integrated beside the run; the offsets at which \
             an outgoing heading turns in space by 1, 6 and 15 degrees come from the motion itself, with the linear prediction beside \
             them. The file sensitivity-derivatives.csv has the derivatives by everything else: start, beta, repulsion."
                .to_owned(),
        ],
        figures: written(pictures::of_sensitivity(&cases)?.into_iter().collect(), out)?,
        tables: vec![Table::from_csv(
            "Derivatives by an offset dz out of the plane, per radius (in the plane per radius squared), condition number of the collision, and offsets in radii. An \
             infinite offset: none up to ten radii turns a heading so far.",
            "sensitivity.csv",
            &csv,
        )?],
    };
    if let Some(growth) = growth(&of_maps(models), sweep, out)? {
        section.finding = [section.finding, growth.finding].join(" ");
        section.prose.extend(growth.prose);
        section.figures.extend(growth.figures);
        section.tables.extend(growth.tables);
    }
    let suspensions = kinetics(methods, options, sweep, out)?;
    section.finding = [section.finding, suspensions.finding].join(" ");
    section.prose.extend(suspensions.prose);
    section.figures.extend(suspensions.figures);
    section.tables.extend(suspensions.tables);
    Ok(section)
}

/// The case that a small offset changes most by exact hydrodynamics, and what lubrication theory says of it.
fn finding(parts: &[Part], cases: &[SensitivityCase]) -> String {
    let of = |method: Method| cases.iter().filter(move |case| case.row.method == method);
    let steepest = of(Method::Exact).min_by(|a, b| a.row.offset_6deg.total_cmp(&b.row.offset_6deg));
    let Some(exact) = steepest else {
        return String::new();
    };
    let axes = parts.first().map_or(&[][..], |part| part.points.axes());
    let values: Vec<String> = (axes.iter().zip(&exact.values))
        .map(|(axis, value)| format!("{} = {}", axis.name, numbers::written(*value)))
        .collect();
    let named = format!("{}, {}", exact.case, values.join(", "));
    let lubrication =
        of(Method::Lt).find(|case| case.case == exact.case && case.values == exact.values);
    let says = lubrication.map_or(String::new(), |lt| {
        format!(" (lubrication theory: {})", rounded(lt.row.offset_6deg, 4))
    });
    format!(
        "By exact hydrodynamics an offset of {} radii{says} turns an outgoing heading by 6 degrees in the most sensitive of the paper's encounters ({named}).",
        rounded(exact.row.offset_6deg, 4)
    )
}
