//! The functions of expressions. Angles are in degrees.

/// A function of one or two numbers.
#[derive(Clone, Copy, Debug)]
pub(super) enum Function {
    One(fn(f64) -> f64),
    Two(fn(f64, f64) -> f64),
}

/// Every function, with what it takes and gives. `docs/SCENES.md` lists them too.
pub(super) const FUNCTIONS: [(&str, Function); 13] = [
    ("sin", Function::One(|degrees| turn(degrees).0)),
    ("cos", Function::One(|degrees| turn(degrees).1)),
    ("tan", Function::One(tan)),
    ("asin", Function::One(|x| x.asin().to_degrees())),
    ("acos", Function::One(|x| x.acos().to_degrees())),
    ("atan", Function::One(|x| x.atan().to_degrees())),
    ("atan2", Function::Two(|y, x| y.atan2(x).to_degrees())),
    ("sqrt", Function::One(f64::sqrt)),
    ("abs", Function::One(f64::abs)),
    ("exp", Function::One(f64::exp)),
    ("ln", Function::One(f64::ln)),
    (
        "min",
        Function::Two(|a, b| if a.is_nan() || a < b { a } else { b }),
    ),
    (
        "max",
        Function::Two(|a, b| if a.is_nan() || a > b { a } else { b }),
    ),
];

/// The function of that name.
pub(super) fn function(name: &str) -> Option<Function> {
    let (_, function) = FUNCTIONS.iter().find(|(known, _)| *known == name)?;
    Some(*function)
}

/// The nearest multiple of 90 degrees, counted in quarter turns from 0 to 3, and what is left, in radians. Both are exact up to the
/// conversion to radians.
fn quarters(degrees: f64) -> (u8, f64) {
    let within = degrees % 360.0;
    let quarters = (within / 90.0).round();
    let rest = (within - 90.0 * quarters).to_radians();
    (quarters.rem_euclid(4.0) as u8, rest)
}

/// Sine and cosine of an angle in degrees, exact at multiples of 90 degrees.
fn turn(degrees: f64) -> (f64, f64) {
    let (quarters, rest) = quarters(degrees);
    let (sin, cos) = rest.sin_cos();
    // Zero has no sign.
    let (sin, cos) = match quarters {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    };
    (sin + 0.0, cos + 0.0)
}

/// Tangent of an angle in degrees, infinite at odd multiples of 90 degrees.
fn tan(degrees: f64) -> f64 {
    let (sin, cos) = turn(degrees);
    sin / cos
}

#[cfg(test)]
mod tests {
    #![allow(clippy::float_cmp, reason = "quarter turns are exact")]
    use super::*;

    fn one(name: &str, x: f64) -> f64 {
        match function(name) {
            Some(Function::One(of)) => of(x),
            _ => panic!("{name} is no function of one number"),
        }
    }

    #[test]
    fn quarter_turns_are_exact_however_often_they_are_repeated() {
        for turns in [-1e6, -3.0, 0.0, 2.0, 1e9] {
            for (degrees, sin, cos) in [
                (0.0, 0.0, 1.0),
                (90.0, 1.0, 0.0),
                (180.0, 0.0, -1.0),
                (270.0, -1.0, 0.0),
            ] {
                let degrees = degrees + 360.0 * turns;
                assert_eq!(
                    one("sin", degrees).to_bits(),
                    f64::to_bits(sin),
                    "{degrees}"
                );
                assert_eq!(
                    one("cos", degrees).to_bits(),
                    f64::to_bits(cos),
                    "{degrees}"
                );
            }
        }
        assert!(one("tan", 90.0).is_infinite());
        assert_eq!([one("asin", 1.0), one("acos", -1.0)], [90.0, 180.0]);
    }

    #[test]
    fn functions_of_degrees_are_those_of_radians() {
        for tenth in -4000..4000 {
            let degrees = 0.1 * f64::from(tenth) + 0.013;
            let radians = degrees.to_radians();
            assert!((one("sin", degrees) - radians.sin()).abs() < 2e-15);
            assert!((one("cos", degrees) - radians.cos()).abs() < 2e-15);
            assert!((one("tan", degrees) / radians.tan() - 1.0).abs() < 1e-11);
        }
        for (name, back) in [("sin", "asin"), ("cos", "acos"), ("tan", "atan")] {
            for degrees in [0.5, 30.0, 45.0, 89.0] {
                assert!((one(back, one(name, degrees)) - degrees).abs() < 1e-12);
            }
        }
        let Some(Function::Two(atan2)) = function("atan2") else {
            panic!("atan2 takes two numbers")
        };
        assert_eq!(atan2(1.0, -1.0), 135.0);
    }

    #[test]
    fn what_is_no_number_is_not_hidden_by_the_smaller_or_the_greater() {
        for name in ["min", "max"] {
            let Some(Function::Two(of)) = function(name) else {
                panic!("{name} takes two numbers")
            };
            assert!(of(f64::NAN, 1.0).is_nan());
            assert!(of(1.0, f64::NAN).is_nan());
            assert_eq!(
                of(1.0, 2.0) + of(2.0, 1.0),
                if name == "min" { 2.0 } else { 4.0 }
            );
        }
    }
}
