//! `squirmers flow`: the flow about the pair of a scene file, at an instant or as a film.

use std::path::{Path, PathBuf};

use clap::{Arg, Args};

use super::scene::read;
use super::shared::model_options;
use crate::arguments::{GeneralArguments, ModelArguments};
use crate::error::CommandError;
use crate::figures;
use crate::streams::print_error;
use crate::terminal::print_rows;
use crate::vtk::{self, Part};
use compare::SceneFile;
use compare::numbers::{parse_number, parse_whole, rounded, size};
use compare::output::{OutputFolder, csv_text};
use compare::study::flow::{
    FlowField, FlowFrame, FlowStudy, FlowView, Instant, SurfaceField, Window, each_frame, fastest,
    frame_name,
};
use scene::MovingPair;

#[derive(Debug, Args)]
pub(crate) struct FlowArguments {
    /// Scene file (docs/SCENES.md lists its keys)
    #[arg(value_name = "SCENE.toml")]
    file: PathBuf,
    /// Time from the start, in a/V_s [default: the closest approach]
    #[arg(long, value_name = "T", value_parser = parse_number, allow_hyphen_values = true)]
    time: Option<f64>,
    /// First time at this gap, in radii
    #[arg(long, value_name = "G", value_parser = parse_number, allow_hyphen_values = true, conflicts_with = "time")]
    gap: Option<f64>,
    /// A film of the whole run: a frame at each multiple of this time, in a/V_s. An interrupted film goes on by the same command
    #[arg(
        long,
        value_name = "DT",
        value_parser = parse_number,
        allow_hyphen_values = true,
        conflicts_with_all = ["time", "gap"]
    )]
    every: Option<f64>,
    #[command(flatten)]
    models: ModelArguments,
    /// Whose velocity is subtracted: lab, 1 or 2
    #[arg(long, value_name = "FRAME", default_value = "lab", value_parser = parse_frame)]
    frame: FlowFrame,
    /// Points along a side of the window [default: 400; 120 for bem and for films]
    #[arg(long, value_name = "N", value_parser = parse_whole, allow_hyphen_values = true)]
    grid: Option<usize>,
    /// Half width of the window, in radii [default: both spheres with a margin]
    #[arg(long, value_name = "W", value_parser = parse_number, allow_hyphen_values = true)]
    window: Option<f64>,
    /// Also write files for ParaView: flow.pvd with the plane (.vts) and both surfaces (.vtu)
    #[arg(long)]
    vtk: bool,
}

/// The help of `--method`.
pub(super) fn methods(argument: Arg) -> Arg {
    let help = "Method: exact or bem, which know the flow [default: the scene's]";
    argument.value_name("METHOD").help(help)
}

fn parse_frame(text: &str) -> Result<FlowFrame, String> {
    let allowed = FlowFrame::ALL.map(FlowFrame::name).join(", ");
    FlowFrame::named(text).ok_or_else(|| format!("'{text}' is not a frame: use one of {allowed}"))
}

/// An instant to be drawn.
struct Shown {
    t: f64,
    pair: MovingPair,
    window: Window,
}

/// What is drawn of an instant, and where.
struct Pictures<'a> {
    study: &'a FlowStudy,
    view: FlowView,
    /// Name of the scene in captions.
    name: String,
    fastest: f64,
    vtk: bool,
    out: &'a OutputFolder,
}

pub(super) fn run(
    arguments: &FlowArguments,
    general: &GeneralArguments,
) -> Result<(), CommandError> {
    let file = chosen(arguments, general)?;
    let view = FlowView {
        grid: arguments
            .grid
            .unwrap_or_else(|| FlowView::default_grid(file.method, arguments.every.is_some())),
        frame: arguments.frame,
        half_width: arguments.window,
    };
    view.check()?;
    let study = FlowStudy::new(&file, general.model_options())?;
    let samples = match arguments.every {
        Some(interval) => study.samples_every(interval)?,
        None => vec![study.sample(instant(arguments))?],
    };
    let out = general.output()?;
    let pairs = study.pairs(&samples)?;
    let pictures = Pictures {
        fastest: fastest(&pairs, view.frame),
        name: name_of(&arguments.file),
        study: &study,
        view,
        vtk: arguments.vtk,
        out: &out,
    };
    let windows = study.windows(&samples, view.half_width);
    let shown: Vec<_> = (samples.iter().zip(pairs).zip(windows))
        .map(|((sample, pair), window)| Shown {
            t: sample.t,
            pair,
            window,
        })
        .collect();
    match arguments.every {
        Some(interval) => film(&pictures, &shown, &key(&pictures, &file, interval)),
        None => still(&pictures, &shown[0]),
    }
}

/// The scene file, under the method that is asked for.
fn chosen(
    arguments: &FlowArguments,
    general: &GeneralArguments,
) -> Result<SceneFile, CommandError> {
    let file = read(&arguments.file)?;
    let (methods, options) = model_options(&arguments.models, &[file.method], general)?;
    let [method] = methods[..] else {
        let names: Vec<_> = methods.iter().map(|method| method.name()).collect();
        let allowed = "a flow is that of one method: give exact or bem";
        return Err(CommandError::input("--method", names.join(","), allowed));
    };
    Ok(SceneFile {
        method,
        mesh: if arguments.models.mesh.is_some() || method != file.method {
            options.mesh
        } else {
            file.mesh
        },
        direct: arguments.models.direct || (file.direct && method == file.method),
        ..file
    })
}

fn instant(arguments: &FlowArguments) -> Instant {
    match (arguments.time, arguments.gap) {
        (Some(t), _) => Instant::Time(t),
        (None, Some(gap)) => Instant::Gap(gap),
        (None, None) => Instant::ClosestApproach,
    }
}

fn name_of(path: &Path) -> String {
    path.file_name()
        .map_or_else(String::new, |name| name.to_string_lossy().into_owned())
}

/// What a film is of: everything that its frames depend on.
fn key(pictures: &Pictures<'_>, file: &SceneFile, interval: f64) -> String {
    let Pictures {
        study,
        view,
        name,
        vtk,
        ..
    } = pictures;
    let version = env!("CARGO_PKG_VERSION");
    format!(
        "frames of flow, version {version}, every {interval:?}, {view:?}, vtk {vtk}\n{name}: {file:?}\n{}\n",
        study.fingerprint()
    )
}

fn still(pictures: &Pictures<'_>, shown: &Shown) -> Result<(), CommandError> {
    let (field, mut files) = pictures.write("flow", shown)?;
    if pictures.vtk {
        files.push(pictures.collect(parts("flow", shown.t))?);
    }
    let files = files.into_iter().map(|file| line("file", file));
    print_rows(&["", ""], summary(&field).into_iter().chain(files));
    Ok(())
}

fn film(pictures: &Pictures<'_>, shown: &[Shown], key: &str) -> Result<(), CommandError> {
    let mut last = None;
    let kept = each_frame(pictures.out, key, shown.len(), |k| {
        last = Some(pictures.write(&frame_name(k), &shown[k])?.0);
        Ok::<_, CommandError>(())
    })?;
    if kept > 0 {
        print_error!("{kept} frames of an interrupted command are kept");
    }
    let mut rows = vec![line("frames", shown.len().to_string())];
    rows.extend(last.iter().flat_map(summary));
    let to = frame_name(shown.len() - 1);
    rows.push(line("files", format!("flow-0001.csv to {to}.csv, .svg")));
    if pictures.vtk {
        let all = shown.iter().enumerate();
        let parts = all.flat_map(|(k, shown)| parts(&frame_name(k), shown.t));
        rows.push(line("file", pictures.collect(parts.collect())?));
    }
    print_rows(&["", ""], rows.into_iter());
    Ok(())
}

/// The parts of a collection that an instant has.
fn parts(name: &str, t: f64) -> Vec<Part> {
    let part = |(number, ending): (usize, &str)| Part {
        t,
        number,
        file: format!("{name}{ending}"),
    };
    PARTS.into_iter().enumerate().map(part).collect()
}

/// Endings of the files of a plane and of the surfaces.
const PARTS: [&str; 3] = [".vts", "-surface1.vtu", "-surface2.vtu"];

impl Pictures<'_> {
    /// Writes all files of an instant, the picture last, and returns what is in them with their names.
    fn write(&self, name: &str, shown: &Shown) -> Result<(FlowField, Vec<String>), CommandError> {
        let flow = self.study.flow(&shown.pair)?;
        let field = self
            .study
            .field(shown.t, flow.as_ref(), shown.window, &self.view);
        let mut files = Vec::new();
        let mut write = |file: String, text: &str| {
            self.out.write(&file, text)?;
            files.push(file);
            Ok::<_, CommandError>(())
        };
        write(format!("{name}.csv"), &csv_text(&field.rows())?)?;
        if self.vtk {
            let [plane, one, two] = PARTS.map(|ending| format!("{name}{ending}"));
            let surface =
                |k: usize| vtk::surface(&SurfaceField::new(flow.as_ref(), k, self.view.frame));
            write(plane, &vtk::plane(&field))?;
            write(one, &surface(0))?;
            write(two, &surface(1))?;
        }
        let svg = figures::flow(&field, &self.name, self.fastest)?;
        write(format!("{name}.svg"), &svg)?;
        Ok((field, files))
    }

    /// Writes the collection of all parts, and returns its name.
    fn collect(&self, parts: Vec<Part>) -> Result<String, CommandError> {
        let name = "flow.pvd".to_owned();
        self.out.write(&name, &vtk::collection(&parts))?;
        Ok(name)
    }
}

fn line(name: &str, value: String) -> Vec<String> {
    vec![name.to_owned(), value]
}

fn summary(field: &FlowField) -> Vec<Vec<String>> {
    vec![
        line("time [a/V_s]", rounded(field.t, 6)),
        line("gap [a]", size(field.pair.configuration.gap.eps())),
        line("method", field.method.to_string()),
        line("frame", field.frame.to_string()),
        line("largest speed [V_s]", rounded(field.largest_speed(), 6)),
        line("error estimate [V_s]", size(field.error_estimate)),
    ]
}
