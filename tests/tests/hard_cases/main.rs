//! Numerically hard cases, each compared with a bound that was derived before anything was measured: the rows of
//! `squirmers hard-cases`, one group a test.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::sync::OnceLock;

use compare::ModelOptions;
use compare::hard_cases::{Bench, GROUPS};

/// The methods, set up once for all tests.
fn bench() -> &'static Bench {
    static BENCH: OnceLock<Bench> = OnceLock::new();
    // Not within a task of the thread pool: setting up a table uses the pool itself.
    BENCH.get_or_init(|| Bench::set_up(&ModelOptions::default()).unwrap())
}

/// Every row of the group holds, and there are rows.
fn holds(name: &str) {
    let group = GROUPS.iter().find(|group| group.name == name).unwrap();
    let rows = group.rows(bench());
    assert!(!rows.is_empty());
    let broken: Vec<_> = (rows.iter().filter(|row| !row.holds))
        .map(|row| {
            format!(
                "{}, {}: {:e}, allowed {:e} by {}",
                row.method, row.measure, row.value, row.bound, row.bound_from
            )
        })
        .collect();
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

/// A test for each group.
macro_rules! groups {
    ($($test:ident: $name:literal,)*) => {
        $(
            #[test]
            fn $test() {
                holds($name);
            }
        )*

        #[test]
        fn every_group_has_a_test() {
            let names: Vec<_> = GROUPS.iter().map(|group| group.name).collect();
            assert_eq!(names, [$($name),*]);
        }
    };
}

groups! {
    val_loads_and_mobility_keep_their_digits_to_contact: "contact",
    val_pairs_without_repulsion_come_into_contact_when_the_closed_form_says: "no repulsion",
    val_stiff_forces_end_at_their_equilibrium_in_bounded_steps: "stiff forces",
    val_a_standoff_stands_until_it_is_tipped_and_then_leaves_at_its_eigenvalue: "standoff",
    val_the_tolerance_moves_lines_between_outcomes_by_no_more_than_its_steps: "separatrix",
    val_long_runs_keep_phase_symmetry_and_period: "long runs",
    val_the_spatial_code_is_the_planar_one_in_the_plane: "out of plane",
    val_tables_join_and_tend_to_reflections_far_out: "far",
    val_boundary_elements_are_within_their_estimate_or_refuse: "boundary elements",
    val_starts_on_a_surface_or_at_infinity_are_the_limits_of_their_neighbours: "starts",
    val_tangents_from_contact_are_differences_of_runs: "tangents",
    val_a_pair_of_very_unlike_radii_moves_the_same_whoever_is_named_first: "unlike radii",
    val_hostile_submissions_are_refused_or_move_a_pair: "submissions",
    val_extreme_numbers_and_threads_do_no_harm: "machine",
}
