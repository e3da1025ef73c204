//! Names of loads and what stands behind them.

#![allow(clippy::float_cmp, reason = "the very numbers that were put in")]

use super::*;
use crate::{SwirlLoads, SwirlModeLoads};

/// Loads that count: own 1, 3, 5, ..., of the other sphere 2, 4, 6, ....
pub(crate) fn counted(set: LoadSet) -> (PairLoads, SwirlLoads) {
    let of = |k: usize| SelfOther::new(2.0 * k as f64 + 1.0, 2.0 * k as f64 + 2.0);
    let rigid = [of(0), of(1), of(2), of(3), of(4)];
    let mode = |n: usize| ModeLoads {
        xf: of(5 + 3 * n),
        yf: of(6 + 3 * n),
        yt: of(7 + 3 * n),
    };
    let swirl = |n: usize| SwirlModeLoads {
        xtc: of(20 + 3 * n),
        yfc: of(21 + 3 * n),
        ytc: of(22 + 3 * n),
    };
    (
        PairLoads::from_parts(rigid, set, mode),
        SwirlLoads::from_modes(set, swirl),
    )
}

/// Names and values to compare with.
fn borrowed(named: &[(String, f64)]) -> Vec<(&str, f64)> {
    (named.iter())
        .map(|(name, value)| (name.as_str(), *value))
        .collect()
}

#[test]
fn loads_stand_behind_their_published_names() {
    let (pair, swirl) = counted(LoadSet::all(2).with_swirl(1));
    let expected = [
        ("X11A", 1.0),
        ("X12A", 2.0),
        ("Y11A", 3.0),
        ("Y12A", 4.0),
        ("Y11B", 5.0),
        ("Y12B", 6.0),
        ("X11C", 7.0),
        ("X12C", 8.0),
        ("Y11C", 9.0),
        ("Y12C", 10.0),
        ("XF1_1", 11.0),
        ("XF2_1", 12.0),
        ("YF1_1", 13.0),
        ("YF2_1", 14.0),
        ("YT1_1", 15.0),
        ("YT2_1", 16.0),
        ("XF1_2", 17.0),
        ("XF2_2", 18.0),
        ("YF1_2", 19.0),
        ("YF2_2", 20.0),
        ("YT1_2", 21.0),
        ("YT2_2", 22.0),
    ];
    assert_eq!(borrowed(&pair.named()), expected);
    assert_eq!(
        borrowed(&swirl.named()),
        [
            ("XTC1_1", 41.0),
            ("XTC2_1", 42.0),
            ("YFC1_1", 43.0),
            ("YFC2_1", 44.0),
            ("YTC1_1", 45.0),
            ("YTC2_1", 46.0)
        ]
    );
    // Along the line of centres alone.
    let names = |set: LoadSet| -> Vec<String> {
        counted(set)
            .0
            .named()
            .into_iter()
            .map(|(name, _)| name)
            .collect()
    };
    assert_eq!(names(LoadSet::axial(1)), ["X11A", "X12A", "XF1_1", "XF2_1"]);
    // Of a pair that is its own image one combination each: opposed forces along the line, equal ones across it.
    let turned = names(LoadSet::all(1).point_symmetric());
    assert_eq!(
        turned,
        [
            "X11A - X12A",
            "Y11A - Y12A",
            "Y11B - Y12B",
            "X11C",
            "X12C",
            "Y11C + Y12C",
            "XF1_1 - XF2_1",
            "YF1_1 - YF2_1",
            "YT1_1 + YT2_1"
        ]
    );
    let mirrored = names(LoadSet::planar(1).mirror_symmetric());
    assert_eq!(
        mirrored,
        [
            "X11A - X12A",
            "Y11A + Y12A",
            "Y11B + Y12B",
            "Y11C - Y12C",
            "XF1_1 - XF2_1",
            "YF1_1 + YF2_1",
            "YT1_1 - YT2_1"
        ]
    );
    assert_eq!(
        counted(LoadSet::all(1).point_symmetric()).0.named()[0].1,
        -1.0
    );
}
