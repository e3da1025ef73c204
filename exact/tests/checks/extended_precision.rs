//! The same recurrences in 80-bit arithmetic (a separate program), where close spheres cost digits.

use exact::Exact;
use scene::{Gap, Hydrodynamics, LoadSet};

/// Gap, then sum and difference of XA, YA, YB, YC, XF_1, YF_1, YT_1, XF_8, YF_8, YT_8.
const EXTENDED: [(f64, [f64; 20]); 3] = [
    (
        1e-04,
        [
            0.6451472373499,
            5005.490301903,
            0.7246697200653,
            4.342113648705,
            0.2372873456308,
            -4.364810555308,
            2.978255906155,
            2.11197957198,
            2.719697339082,
            56.14712655855,
            2.726615621742,
            22.45413619817,
            16.44689607888,
            7.547724378675,
            0.001591706121473,
            31.11071456905,
            -0.000420654241867,
            10.39596241294,
            10.37465828144,
            1.500722451034,
        ],
    ),
    (
        1e-05,
        [
            0.6451420067013,
            50006.52640475,
            0.7246619611416,
            5.109629798885,
            0.2373009362598,
            -5.515863104872,
            3.553679521092,
            2.457241968587,
            2.719682468258,
            69.95796940323,
            2.72656477778,
            27.05839252611,
            21.05032111072,
            10.30803462515,
            0.001591447199245,
            44.85797800423,
            -0.000426317298356,
            14.97876364288,
            14.9570111542,
            4.204365959697,
        ],
    ),
    (
        3e-06,
        [
            0.6451415998694,
            166673.7348537,
            0.7246613576598,
            5.510953116994,
            0.2373019933399,
            -6.117827266387,
            3.854651830494,
            2.637826337043,
            2.71968131162,
            77.18136599222,
            2.726560823065,
            29.46625276071,
            23.45810239524,
            11.75253613103,
            0.001591427052554,
            52.07493110609,
            -0.0004267584042024,
            17.38445561966,
            17.36265404532,
            5.642963384891,
        ],
    ),
];

#[test]
fn loads_near_contact_are_those_of_80_bit_arithmetic() {
    let exact = Exact::new();
    for (eps, expected) in EXTENDED {
        let loads = exact
            .loads(Gap::new(eps).unwrap(), LoadSet::all(8))
            .unwrap();
        let (first, last) = (loads.modes()[0], loads.modes()[7]);
        let rigid = [loads.xa, loads.ya, loads.yb, loads.yc];
        let own = rigid
            .into_iter()
            .chain([first.xf, first.yf, first.yt, last.xf, last.yf, last.yt])
            .flat_map(|s| [s.sum, s.difference]);
        for (index, (own, expected)) in own.zip(expected).enumerate() {
            let error = (own - expected).abs() / expected.abs().max(1.0);
            assert!(
                error < 3e-10,
                "number {index} at {eps:e}: {own} {expected} ({error:.1e})"
            );
        }
    }
}
