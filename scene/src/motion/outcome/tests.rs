use super::*;

fn history(angles: impl IntoIterator<Item = f64>) -> LineHistory {
    let mut history = LineHistory::new(0.0);
    for angle in angles {
        history.take(angle);
    }
    history
}

#[test]
fn a_line_that_goes_round_orbits_whatever_it_did_at_first() {
    let round = (0..=80).map(|i| 0.1 * f64::from(i));
    assert!(history(round.clone()).orbits());
    let after_a_swing = [-0.3, -0.7, -1.2].into_iter().chain(round);
    let line = history(after_a_swing);
    assert!(line.orbits() && line.swings == 1, "{line:?}");
    assert!(!history((0..=60).map(|i| 0.1 * f64::from(i))).orbits());
}

#[test]
fn a_line_that_swings_to_and_fro_does_not_orbit() {
    // By more than a whole turn each way: only the reversals tell.
    let swinging = |i: i32| 7.0 * (0.05 * f64::from(i)).sin();
    let line = history((0..400).map(swinging));
    assert!(!line.orbits() && line.swings >= OSCILLATIONS, "{line:?}");
}

#[test]
fn only_gravity_that_turns_both_rights_a_pair() {
    let apart = Configuration {
        radii: [1.0; 2],
        gap: crate::Gap::from_ln(5.0),
        midpoint: nalgebra::Vector3::zeros(),
        line: nalgebra::Vector3::x(),
        orientations: [nalgebra::Vector3::y(); 2],
        line_angle_rad: 0.0,
        angles_rad: [0.5 * std::f64::consts::PI; 2],
    };
    let swimmer = Squirmer::with_beta(1.0, 0.0).expect("a squirmer");
    let heavy = swimmer.bottom_heavy(10.0).expect("a squirmer");
    let passive = Squirmer::new(&[])
        .and_then(|s| s.bottom_heavy(10.0))
        .expect("a sphere");
    let judged = |pair: [Squirmer; 2]| {
        let righting = Righting::new(Gravity::DOWN, &pair);
        let gaps = GapHistory::from(apart.gap.ln());
        judge_under_gravity((&apart, &apart), 1.0, 1.0, &gaps, None, &righting)
    };
    assert_eq!(judged([heavy; 2]), Outcome::Upward);
    assert_eq!(judged([heavy, swimmer]), Outcome::Scattered);
    assert_eq!(judged([passive, heavy]), Outcome::Scattered);
}

#[test]
fn what_counts_as_close_is_measured_by_the_smaller_squirmer() {
    let at = |radius: f64, eps: f64| Configuration {
        radii: [1.0, radius],
        gap: crate::Gap::from_ln(eps.ln()),
        midpoint: nalgebra::Vector3::zeros(),
        line: nalgebra::Vector3::x(),
        orientations: [nalgebra::Vector3::x(), -nalgebra::Vector3::x()],
        line_angle_rad: 0.0,
        angles_rad: [0.0; 2],
    };
    let judged = |radius: f64, eps: f64| {
        let pair = at(radius, eps);
        judge_bound(&pair, &pair, 10.0, 1.0)
    };
    for radius in [0.2, 1.0, 3.0] {
        let smaller = f64::min(radius, 1.0);
        assert_eq!(judged(radius, 0.9 * smaller), Outcome::Standoff);
        assert_eq!(judged(radius, 1.1 * smaller), Outcome::Undecided);
        let heavy = Squirmer::with_beta(1.0, 0.0)
            .and_then(|s| s.bottom_heavy(-5.0))
            .expect("a squirmer");
        let righting = Righting::new(Gravity::DOWN, &[heavy; 2]);
        let apart = |eps: f64| {
            let pair = at(radius, eps);
            let gaps = GapHistory::from(pair.gap.ln());
            judge_under_gravity((&pair, &pair), 1.0, 1.0, &gaps, None, &righting)
        };
        assert_eq!(apart(1.1 * smaller), Outcome::Scattered);
        assert_ne!(apart(0.9 * smaller), Outcome::Scattered);
    }
}

#[test]
fn tremor_is_no_reversal() {
    let line = history((0..200).map(|i| 0.05 * f64::from(i) + 0.2 * f64::from(i).sin()));
    assert!(line.orbits() && line.swings == 0, "{line:?}");
}
