//! What is refused, in one line.

use super::*;

#[test]
fn overlapping_spheres_are_refused() {
    // The paper's cases start far apart: only offsets so large that distances overflow can make
    // the gap meaningless.
    refused(
        &["orthogonal", "--dx", "10,1e200", "--method", "lt"],
        "1e200",
    );
    refused(
        &["head-on", "--dx", "1", "--dz", "1e308", "--method", "lt"],
        "1e308",
    );
}

#[test]
fn numbers_that_are_none_are_refused() {
    refused(&["head-on", "--beta", "nan", "--method", "lt"], "'nan'");
    refused(&["head-on", "--dx", "1,abc"], "'abc'");
    refused(&["offset", "--dz", "inf"], "'inf'");
    refused(&["loads", "--gap", "0.1,NaN"], "'NaN'");
    refused(&["head-on", "--tol", "nan"], "NaN");
    refused(&["head-on", "--tol", "-1e-8"], "-1e-8");
}

#[test]
fn empty_lists_are_refused() {
    refused(&["head-on", "--dx", ""], "--dx");
    refused(&["loads", "--gap", ""], "--gap");
    refused(&["loads", "--gap", "0.1", "--method", ""], "not a method");
}

#[test]
fn unknown_methods_and_commands_are_refused() {
    refused(&["head-on", "--method", "lt,magic"], "'magic'");
    refused(&["collide"], "collide");
    refused(&["loads"], "--gap");
}

#[test]
fn gaps_that_are_not_positive_or_under_the_range_are_refused() {
    refused(&["loads", "--gap", "0.1,-0.5", "--method", "lt"], "-0.5");
    refused(&["loads", "--gap", "0", "--method", "lt"], "'0.0'");
    refused(&["loads", "--gap", "1e-7", "--method", "bem"], "1e-7");
}

#[test]
fn mesh_levels_and_threads_out_of_range_are_refused() {
    refused(&["loads", "--gap", "1", "--mesh", "99"], "99");
    refused(
        &["loads", "--gap", "1", "--mesh", "-1"],
        "'-1' is not a level",
    );
    let unused = ["loads", "--gap", "1", "--method", "lt", "--mesh", "2"];
    refused(&unused, "no method uses boundary elements");
    refused(&["loads", "--gap", "1", "--threads", "0"], "'0'");
    refused(&["head-on", "--time-limit", "-3"], "-3");
}

#[test]
fn a_folder_that_cannot_be_written_is_refused() {
    // Even the superuser cannot make a folder below a file.
    let file = tempfile::NamedTempFile::new().unwrap();
    let below = file.path().join("results");
    let output = squirmers(&below, &["loads", "--gap", "1", "--method", "lt"]);
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert_eq!(message.trim().lines().count(), 1, "{message}");
    assert!(message.contains("cannot write"), "{message}");
}

#[test]
fn distances_at_which_no_angle_can_be_read_are_refused() {
    refused(
        &["head-on", "--method", "lt", "--departure", "2"],
        "--departure",
    );
    refused(
        &["scatter", "--method", "lt", "--departure", "nan"],
        "--departure",
    );
}

#[test]
fn what_is_listed_twice_is_refused() {
    refused(&["head-on", "--dx", "1,2,1", "--method", "lt"], "twice");
    refused(&["head-on", "--dx", "1", "--method", "lt,lt"], "twice");
}

#[test]
fn a_cache_that_is_no_folder_is_refused() {
    let file = tempfile::NamedTempFile::new().unwrap();
    let path = file.path().to_str().unwrap();
    refused(
        &["loads", "--gap", "1", "--method", "lt", "--cache", path],
        path,
    );
}

#[test]
fn decimal_commas_are_refused_with_the_point_that_they_stand_for() {
    for option in ["--tol", "--departure", "--time-limit"] {
        refused(&["head-on", option, "1,5"], "decimals take a point, 1.5");
    }
    refused(
        &["cost", "--target", "0,1deg"],
        "decimals take a point, 0.1",
    );
    refused(&["loads", "--gap", "0,1"], "decimals take a point");
    refused(
        &["head-on", "--dx", "0:1:0,5"],
        "range 0:1:0 is empty: the step must lead from the first to the second number; decimals take a point",
    );
}

#[test]
fn counts_that_are_none_are_named_in_words() {
    for (arguments, value) in [
        (&["scatter", "--grid"][..], "1.5"),
        (&["loads", "--gap", "1", "--modes"], "-1"),
        (&["loads", "--gap", "1", "--swirl"], "x"),
        (&["loads", "--gap", "1", "--threads"], "2,0"),
    ] {
        let named = format!("'{value}' is not a whole number");
        refused(&[arguments, &[value]].concat(), &named);
    }
}

#[test]
fn values_of_maps_that_are_not_allowed_are_named() {
    refused(&["scatter", "--grid", "1"], "'1'");
    refused(&["scatter", "--grid", "-4"], "-4");
    refused(&["fates", "--g", "nan"], "'nan'");
    refused(&["fates", "--tol", "0"], "'0.0'");
    refused(&["scatter", "--beta", "5,x"], "'x'");
    refused(&["trust", "--method", "lt"], "exact");
}
