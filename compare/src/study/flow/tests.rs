use exact::Exact;
use scene::Plan;

use super::*;
use crate::OutputFolder;

/// Two squirmers that swim straight, the first along x, the second along -x, their paths `offset` apart. The run ends once they recede, after
/// t = 5.
fn straight(offset: f64, z: f64) -> FlowStudy {
    let squirmer = |x: f64, y: f64, z: f64, degrees: f64| {
        format!(
            "[[squirmer]]\nposition = [{x:?}, {y:?}, {z:?}]\norientation = {degrees:?}\nbeta = 2.0\n"
        )
    };
    let text = format!(
        "hydrodynamics = \"none\"\n{}{}[run]\nend_time = 12.0\n",
        squirmer(-5.0, 0.0, z, 0.0),
        squirmer(5.0, offset, 0.0, 180.0)
    );
    let file = SceneFile::parse(&text).unwrap();
    let plan = Plan::new(&file.scene).unwrap();
    let options = file.model_options(&plan, ModelOptions::default());
    FlowStudy {
        method: file.method,
        fluid: Box::new(Exact::new()),
        model: Model::set_up(file.method, &options).unwrap(),
        plan,
        run: file.run,
    }
}

fn view(grid: usize, frame: FlowFrame) -> FlowView {
    FlowView {
        grid,
        frame,
        half_width: None,
    }
}

fn field(study: &FlowStudy, instant: Instant, view: &FlowView) -> FlowField {
    let at = study.sample(instant).unwrap();
    let flow = study.flow(&study.pairs(&[at]).unwrap()[0]).unwrap();
    let windows = study.windows(&[at], view.half_width);
    study.field(at.t, flow.as_ref(), windows[0], view)
}

fn refusal(study: &FlowStudy, instant: Instant) -> String {
    study.sample(instant).unwrap_err().to_string()
}

#[test]
fn straight_paths_are_closest_where_they_pass() {
    // At t the distance is sqrt((10 - 2 t)² + 9).
    let at = straight(3.0, 0.0).sample(Instant::ClosestApproach).unwrap();
    assert!((at.t - 5.0).abs() < 1e-6, "{}", at.t);
    assert!((at.configuration.gap.eps() - 1.0).abs() < 1e-12);
}

#[test]
fn the_closest_approach_is_found_however_seldom_a_scene_has_samples() {
    for interval in [None, Some(11.0), Some(3.3)] {
        let mut study = straight(3.0, 0.0);
        study.run.sample_interval = interval;
        let at = study.sample(Instant::ClosestApproach).unwrap();
        assert!((at.t - 5.0).abs() < 1e-6, "{interval:?}: {}", at.t);
        let at = study.sample(Instant::Gap(1.5)).unwrap();
        assert!((at.configuration.gap.eps() - 1.5).abs() < 1e-9);
    }
}

#[test]
fn a_gap_is_found_where_it_is_first_reached() {
    let study = straight(3.0, 0.0);
    for gap in [7.0, 2.0, 1.0 + 1e-7, 1.000_1] {
        let distance: f64 = 2.0 + gap;
        let expected = 5.0 - 0.5 * (distance * distance - 9.0).sqrt();
        let at = study.sample(Instant::Gap(gap)).unwrap();
        assert!((at.t - expected).abs() < 1e-6, "{gap}: {}", at.t);
        assert!((at.configuration.gap.eps() - gap).abs() < 1e-9);
    }
}

#[test]
fn a_gap_that_the_run_never_has_is_refused_with_the_smallest_one() {
    let study = straight(3.0, 0.0);
    let message = refusal(&study, Instant::Gap(0.5));
    assert!(message.contains("--gap '0.5'"), "{message}");
    assert!(
        message.contains("smallest gap of the run is 1.000000e0"),
        "{message}"
    );
    assert!(refusal(&study, Instant::Gap(-1.0)).contains("greater than 0"));
}

#[test]
fn a_time_is_met_to_the_last_bit_and_must_be_within_the_run() {
    let study = straight(3.0, 0.0);
    for t in [0.0, 1e-3, 4.3] {
        let at = study.sample(Instant::Time(t)).unwrap();
        assert!(at.t.total_cmp(&t).is_eq(), "{t}: {}", at.t);
        let [one, _] = at.configuration.positions();
        assert!((one.x - (t - 5.0)).abs() < 1e-12, "{one}");
    }
    for t in [-1.0, 12.5, f64::NAN] {
        assert!(refusal(&study, Instant::Time(t)).contains("from 0 to 12"));
    }
}

#[test]
fn frames_come_at_equal_steps_of_time() {
    let study = straight(3.0, 0.0);
    let frames = study.samples_every(2.5).unwrap();
    let times: Vec<_> = frames.iter().map(|sample| sample.t).collect();
    assert_eq!(times, [0.0, 2.5, 5.0]);
    for bad in [0.0, -1.0, f64::NAN, 1e-9] {
        let message = study.samples_every(bad).unwrap_err().to_string();
        assert!(message.contains("--every"), "{message}");
    }
}

#[test]
fn frames_of_the_squirmers_differ_by_their_velocities() {
    let study = straight(3.0, 0.0);
    let [lab, one, two] =
        FlowFrame::ALL.map(|frame| field(&study, Instant::Time(2.0), &view(12, frame)));
    for ((lab, one), two) in lab.points.iter().zip(&one.points).zip(&two.points) {
        assert_eq!(lab.place, one.place);
        if lab.inside.is_none() {
            for (k, other) in [one, two].into_iter().enumerate() {
                let difference = lab.state.velocity - other.state.velocity;
                assert!(
                    (difference - FlowFrame::Squirmer(k).velocity(&two_of(&study))).norm() < 1e-14
                );
                assert!(lab.state.pressure.total_cmp(&other.state.pressure).is_eq());
            }
        } else {
            assert!(one.state.velocity.x.is_nan() && one.inside == lab.inside);
        }
    }
    assert!(lab.points.iter().any(|point| point.inside == Some(1)));
}

fn two_of(study: &FlowStudy) -> MovingPair {
    let at = study.sample(Instant::Time(2.0)).unwrap();
    study.pairs(&[at]).unwrap()[0]
}

#[test]
fn a_field_has_the_same_bits_for_any_number_of_threads() {
    let study = straight(3.0, 0.4);
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let of = || field(&study, Instant::ClosestApproach, &view(30, FlowFrame::Lab)).rows();
        crate::csv_text(&pool.build().unwrap().install(of)).unwrap()
    };
    assert_eq!(with(1), with(2));
}

#[test]
fn the_window_shows_both_spheres_and_the_plane_holds_both_centres() {
    for z in [0.0, 0.7] {
        let study = straight(3.0, z);
        let field = field(&study, Instant::Time(3.0), &view(10, FlowFrame::Lab));
        let Window {
            section,
            middle,
            half_width,
        } = field.window;
        assert_eq!(section.is_level, z == 0.0);
        for centre in field.pair.configuration.positions() {
            assert!((centre - section.origin).dot(&section.normal()).abs() < 1e-12);
            let (x, y) = section.coordinates(&centre);
            let farthest = (x - middle.0).abs().max((y - middle.1).abs());
            assert!(farthest + 3.0 <= half_width + 1e-12);
        }
        for point in &field.points {
            let (x, y) = section.coordinates(&point.place);
            assert!((section.point((x, y)) - point.place).norm() < 1e-12);
        }
    }
}

#[test]
fn windows_of_a_film_have_one_size() {
    let study = straight(3.0, 0.0);
    let frames = study.samples_every(2.0).unwrap();
    let windows = study.windows(&frames, None);
    assert!(
        windows
            .iter()
            .all(|w| w.half_width.total_cmp(&windows[0].half_width).is_eq())
    );
    let half_width = study.windows(&frames, Some(2.5))[1].half_width;
    assert!((half_width - 2.5).abs() < f64::EPSILON, "{half_width}");
    // Lone squirmers with beta 2 have no surface that is faster than B1 |1 + 2 c| and their speed.
    let pairs = study.pairs(&frames).unwrap();
    let of_surfaces = fastest(&pairs, FlowFrame::Lab);
    assert!(of_surfaces > 1.0 && of_surfaces < 5.5, "{of_surfaces}");
    assert!(fastest(&pairs, FlowFrame::Squirmer(0)) > of_surfaces);
}

#[test]
fn surfaces_move_by_rigid_motion_and_slip() {
    let study = straight(3.0, 0.3);
    let at = study.sample(Instant::ClosestApproach).unwrap();
    let pair = study.pairs(&[at]).unwrap()[0];
    let flow = study.flow(&pair).unwrap();
    for k in [0, 1] {
        let surface = SurfaceField::new(flow.as_ref(), k, FlowFrame::Lab);
        let centre = pair.configuration.positions()[k];
        assert_eq!(surface.triangles.len(), 2 * surface.points.len() - 4);
        assert!(surface.density.is_none());
        for (index, point) in surface.points.iter().enumerate() {
            let normal = point - centre;
            assert!((normal.norm() - 1.0).abs() < 1e-12);
            let rigid = surface.surface_velocity[index] - surface.slip[index];
            assert!((rigid - pair.rigid_velocity(k, &normal)).norm() < 1e-12);
            assert!(surface.slip[index].dot(&normal).abs() < 1e-12);
        }
    }
}

#[test]
fn an_interrupted_film_goes_on_and_another_one_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let out = OutputFolder::open(folder.path()).unwrap();
    let write = |k: usize, text: &str| out.write(&format!("{}.svg", frame_name(k)), text).map(drop);
    let fails_at_2 = |k: usize| {
        if k == 2 {
            return Err(CompareError::input("frame", k, "it fails"));
        }
        write(k, "first")
    };
    assert!(each_frame(&out, "a film", 4, fails_at_2).is_err());
    assert!(out.holds(PART));
    let other = each_frame(&out, "another", 4, |k| write(k, "other"));
    assert!(
        matches!(other, Err(CompareError::OtherSweep { pieces: 2, .. })),
        "{other:?}"
    );
    let kept = each_frame(&out, "a film", 4, |k| write(k, "second")).unwrap();
    assert_eq!(kept, 2);
    let text = |k: usize| out.read(&format!("{}.svg", frame_name(k))).unwrap();
    assert_eq!([text(0), text(3)], ["first", "second"]);
    assert!(!out.holds(PART));
    // A film of fewer frames leaves none of the longer one.
    each_frame(&out, "a film", 1, |k| write(k, "third")).unwrap();
    assert!(!out.holds("flow-0002.svg"));
}
