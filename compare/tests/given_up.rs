//! Work that is given up ends with an error, keeps nothing unfinished, and leaves the process able to work. In one test, because it concerns the whole process.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use compare::sweep::{FamilySweep, Points, RunChoices, Share};
use compare::watch::{give_up, given_up, go_on};
use compare::{CompareError, Family, Method, Model, ModelOptions, Numbers, OutputFolder};
use scene::{LoadSet, RunOptions};

#[test]
fn what_is_given_up_ends_keeps_nothing_unfinished_and_can_be_done_again() {
    let points = Points::new(
        Family::named("opposed").unwrap().clone(),
        &[("dx".to_owned(), Numbers(vec![1.0, 2.0]))],
        RunChoices {
            tolerance: None,
            angles_at: f64::INFINITY,
        },
    );
    let points = points.unwrap();
    let scene = points.family().scene(&[]).unwrap().scene;
    let options = ModelOptions {
        cache: None,
        tabulated: LoadSet::planar(1),
        ..ModelOptions::default()
    };
    let lubrication = Model::set_up(Method::Lt, &options).unwrap();
    let direct = ModelOptions {
        direct: true,
        ..options.clone()
    };
    let solved = Model::set_up(Method::Exact, &direct).unwrap();
    let run = |model: &Model| model.run(&scene, &RunOptions::default());
    let before = run(&lubrication).unwrap();

    give_up();
    assert!(given_up());
    for model in [&lubrication, &solved] {
        let told = run(model).unwrap_err().to_string();
        assert!(told.contains("given up"), "{told}");
    }
    let table = Model::set_up(Method::Exact, &options).err().unwrap();
    assert!(table.to_string().contains("given up"), "{table}");
    let folder = tempfile::tempdir().unwrap();
    let out = OutputFolder::open(folder.path()).unwrap();
    let models = [lubrication];
    let loads = points.reads().unwrap().loads;
    let sweep = FamilySweep {
        points: &points,
        models: &models,
        loads,
        share: Share::ALL,
        time_limit: None,
        out: &out,
    };
    let stopped = sweep.run(&mut |_| {}).unwrap_err();
    let CompareError::Interrupted { left, path, .. } = stopped else {
        panic!("{stopped}");
    };
    assert_eq!(left, 2);
    let kept = std::fs::read_to_string(path).unwrap();
    assert!(!kept.contains("failed"), "{kept}");

    go_on();
    assert_eq!(run(&models[0]).unwrap(), before);
    let done = sweep.run(&mut |_| {}).unwrap();
    assert_eq!((done.rows, done.failed), (2, 0));
}
