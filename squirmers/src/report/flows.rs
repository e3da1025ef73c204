//! The flow of the paper's encounters at their closest approach, for the section on the fluid.

use crate::error::CommandError;
use crate::figures;
use crate::page::Figure;
use crate::pictures::Picture;
use compare::output::OutputFolder;
use compare::study::flow::{FlowFrame, FlowStudy, FlowView, Instant, fastest};
use compare::{Approach, Case, Defaults, Method, ModelOptions, SceneFile};
use scene::RunOptions;

use super::findings::number;
use super::written;

/// Points along a side of a picture: a page of several stays small.
const GRID: usize = 200;

/// The flow by `method` of the encounter of each approach and beta whose paths are closest, at the closest approach.
pub(super) fn figures(
    method: Method,
    options: &ModelOptions,
    out: &OutputFolder,
) -> Result<Vec<Figure>, CommandError> {
    let mut pictures = Vec::new();
    for case in closest()? {
        pictures.push(picture(method, options, case)?);
    }
    written(pictures, out)
}

/// The encounters of the smallest offset of each beta.
fn closest() -> Result<Vec<Case>, CommandError> {
    let mut cases = Defaults::paper_encounters()?;
    let of_paths = |a: &Case, b: &Case| {
        let approach = a.approach.cmp(&b.approach);
        approach.then(a.beta.total_cmp(&b.beta))
    };
    cases.sort_by(|a, b| of_paths(a, b).then(a.dx.total_cmp(&b.dx)));
    cases.dedup_by(|next, first| of_paths(next, first).is_eq());
    Ok(cases)
}

fn picture(method: Method, options: &ModelOptions, case: Case) -> Result<Picture, CommandError> {
    let Case {
        approach, beta, dx, ..
    } = case;
    let file = SceneFile {
        scene: case.scene()?,
        method,
        mesh: options.mesh,
        direct: options.direct,
        run: RunOptions::default(),
    };
    let study = FlowStudy::new(&file, options.clone())?;
    let samples = [study.sample(Instant::ClosestApproach)?];
    let pairs = study.pairs(&samples)?;
    let window = study.windows(&samples, None)[0];
    let view = FlowView {
        grid: GRID,
        frame: FlowFrame::Lab,
        half_width: None,
    };
    let flow = study.flow(&pairs[0])?;
    let field = study.field(samples[0].t, flow.as_ref(), window, &view);
    let paths = match approach {
        Approach::HeadOn => "opposed paths (Fig. 6)",
        Approach::Orthogonal => "paths at right angles (Fig. 7)",
    };
    let name = format!("{paths}, β = {}, δx = {}", number(beta), number(dx));
    Ok(Picture {
        file_name: format!("flow-{approach}-beta{beta}-dx{dx}.svg"),
        svg: figures::flow(&field, &name, fastest(&pairs, view.frame))?,
    })
}
