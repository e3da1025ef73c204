//! The 12 x 12 matrix of a pair, with columns for slip: what it says in named quantities, and which laws it breaks by itself.

use std::collections::BTreeMap;
use std::f64::consts::{FRAC_1_SQRT_2, PI};

use nalgebra::SMatrix;
use scene::{Gap, MAX_MODES, legendre};

use super::error::SubmissionError;
use super::header::{Header, MatrixKind};
use super::quantity::{Quantity, Values};

/// Rows, and columns that are not by slip.
pub(super) const SIZE: usize = 12;

/// Largest entry, in the unit that makes the diagonal of a lone sphere 1: its square is a number.
const LARGEST: f64 = 1e100;

/// A column.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Column {
    /// By a force or velocity, counted from 0.
    Rigid(usize),
    /// By a slip mode.
    Slip(Slip),
}

/// A slip column: mode, squirmer (0 or 1) and orientation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Slip {
    mode: usize,
    squirmer: usize,
    axis: Axis,
}

/// Orientation of a squirmer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Axis {
    X,
    Z,
    Xz,
}

impl Axis {
    /// Along x and z.
    fn orientation(self) -> [f64; 2] {
        match self {
            Self::X => [1.0, 0.0],
            Self::Z => [0.0, 1.0],
            Self::Xz => [FRAC_1_SQRT_2; 2],
        }
    }
}

/// The place of a number in a matrix, with the row counted from 0. Sorted column by column.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Place {
    pub column: Column,
    pub row: usize,
}

impl Place {
    pub const ROWS: &'static str = "a whole number from 1 to 12";
    pub const COLUMNS: &'static str = "a whole number from 1 to 12, or a slip column such as B1_1z: mode, squirmer and orientation x, z or xz";

    /// From the texts of row and column.
    ///
    /// # Errors
    /// Which of the two is wrong: "row" or "col".
    pub fn parse(row: &str, column: &str) -> Result<Self, &'static str> {
        let number = |text: &str| {
            let number: Option<usize> = text.parse().ok();
            number
                .filter(|number| (1..=SIZE).contains(number))
                .map(|number| number - 1)
        };
        let column = number(column)
            .map(Column::Rigid)
            .or_else(|| Slip::parse(column).map(Column::Slip));
        Ok(Self {
            row: number(row).ok_or("row")?,
            column: column.ok_or("col")?,
        })
    }
}

impl Slip {
    pub fn parse(text: &str) -> Option<Self> {
        let (mode, of) = text.strip_prefix('B')?.split_once('_')?;
        let mode = mode
            .parse()
            .ok()
            .filter(|mode| (1..=MAX_MODES).contains(mode))?;
        let (squirmer, axis) = of.split_at_checked(1)?;
        Some(Self {
            mode,
            squirmer: match squirmer {
                "1" => 0,
                "2" => 1,
                _ => return None,
            },
            axis: match axis {
                "x" => Axis::X,
                "z" => Axis::Z,
                "xz" => Axis::Xz,
                _ => return None,
            },
        })
    }
}

impl std::fmt::Display for Column {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Rigid(number) => write!(f, "{}", number + 1),
            Self::Slip(Slip {
                mode,
                squirmer,
                axis,
            }) => {
                let axis = match axis {
                    Axis::X => "x",
                    Axis::Z => "z",
                    Axis::Xz => "xz",
                };
                write!(f, "B{mode}_{}{axis}", squirmer + 1)
            }
        }
    }
}

/// A matrix of a pair at one gap, complete, and its columns by slip.
pub(super) struct Matrix {
    pub rigid: SMatrix<f64, SIZE, SIZE>,
    pub slip: BTreeMap<Slip, [f64; SIZE]>,
}

/// Laws that a matrix breaks by itself, at one gap, in the units of the scalars, which are 1 of lone spheres; differences are relative to the larger of the two entries and 1.
#[derive(Clone, Debug, PartialEq)]
pub struct MatrixLaws {
    /// Largest difference of two entries that reciprocity makes equal, and these entries.
    pub asymmetry: (f64, String),
    /// The same of entries that are equal because the spheres are, and because nothing tells x from y; slip columns among them.
    pub images: (f64, String),
    /// Smallest eigenvalue of the symmetric part.
    pub smallest_eigenvalue: f64,
}

/// Sign of an entry's part along x, y, z (velocities, then spins) as the pair is turned by pi about the x axis.
const TURNED: [f64; SIZE] = [
    1.0, -1.0, -1.0, 1.0, -1.0, -1.0, 1.0, -1.0, -1.0, 1.0, -1.0, -1.0,
];

/// Place of the same part of the other sphere.
fn exchanged(row: usize) -> usize {
    if row % 6 < 3 { row + 3 } else { row - 3 }
}

/// Place and sign after a turn by a quarter about the z axis: x becomes y, y becomes -x.
fn quarter(row: usize) -> (usize, f64) {
    match row % 3 {
        0 => (row + 1, 1.0),
        1 => (row - 1, -1.0),
        _ => (row, 1.0),
    }
}

/// Of a force or a translation, and not of a torque or a spin.
fn is_force(row: usize) -> bool {
    row < 6
}

impl Matrix {
    /// In the units of the scalars: entries of a mobility times, of a resistance over `6 pi mu a` and so on.
    fn dimensionless(&self, header: &Header, kind: MatrixKind) -> SMatrix<f64, SIZE, SIZE> {
        let (a, mu) = (header.radius, header.viscosity);
        SMatrix::from_fn(|i, j| {
            let unit = match (is_force(i), is_force(j)) {
                (true, true) => 6.0 * PI * mu * a,
                (false, false) => 8.0 * PI * mu * a.powi(3),
                _ => 4.0 * PI * mu * a * a,
            };
            match kind {
                MatrixKind::Mobility => self.rigid[(i, j)] * unit,
                MatrixKind::Resistance => self.rigid[(i, j)] / unit,
            }
        })
    }

    /// Its quantities, and the laws that it breaks.
    ///
    /// # Errors
    /// [`SubmissionError::Units`] if it is so large in the units of the header that they cannot be right.
    pub fn read(
        &self,
        gap: Gap,
        header: &Header,
        kind: MatrixKind,
    ) -> Result<(Values, MatrixLaws), SubmissionError> {
        let scalars = self.dimensionless(header, kind);
        for row in 0..SIZE {
            for column in 0..SIZE {
                let times = scalars[(row, column)].abs();
                if times.is_nan() || times > LARGEST {
                    return Err(SubmissionError::Units {
                        gap: gap.eps(),
                        row: row + 1,
                        column: column + 1,
                        times,
                    });
                }
            }
        }
        let mut values = Values::default();
        // What is said twice stands as it is said first.
        let mut put = |name: &str, value: f64| {
            if let Some(quantity) = Quantity::named(name)
                && values.get(quantity).is_none()
            {
                values.set(quantity, value);
            }
        };
        // d is z, t is x, d x t is y.
        let [x, z, spin_y, spin_z] = [0, 2, 7, 8];
        for (k, other) in [("11", 0), ("12", 3)] {
            let at = |row: usize, column: usize| scalars[(row + other, column)];
            let [xa, ya, yb, xc, yc] = [
                at(z, z),
                at(x, x),
                at(spin_y, x),
                at(spin_z, spin_z),
                at(spin_y, spin_y),
            ];
            match kind {
                MatrixKind::Mobility => {
                    put(&format!("x{k}a"), xa);
                    put(&format!("y{k}a"), ya);
                    put(&format!("y{k}b"), yb);
                    put(&format!("x{k}c"), xc);
                    put(&format!("y{k}c"), yc);
                }
                MatrixKind::Resistance => {
                    put(&format!("X{k}A"), xa);
                    put(&format!("Y{k}A"), ya);
                    // The torque by the fluid is 4 pi Y11B U on the sphere itself, -4 pi Y12B U on the other one.
                    put(&format!("Y{k}B"), if other == 0 { -yb } else { yb });
                    put(&format!("X{k}C"), xc);
                    put(&format!("Y{k}C"), yc);
                }
            }
        }
        for (slip, column) in &self.slip {
            for (name, value) in slip.quantities(column, header, kind) {
                put(&name, value);
            }
        }
        let mut laws = laws(&scalars, kind);
        for (slip, column) in &self.slip {
            slip.compare(column, (header, kind), &values, &mut laws.images);
        }
        Ok((values, laws))
    }
}

impl Slip {
    /// From this squirmer to the other one `d` is z or -z; `t` is x, so that `d x t` is y or -y.
    fn side(self) -> f64 {
        if self.squirmer == 0 { 1.0 } else { -1.0 }
    }

    /// `P_n(c)` and `W_n(c) p_t`.
    fn factors(self) -> Option<[f64; 2]> {
        let [across, along] = self.axis.orientation();
        let order = legendre(self.side() * along).nth(self.mode - 1)?;
        Some([order.p, order.w * across])
    }

    /// The names of what is along `d`, along `t` and about `d x t`, and their units.
    fn kinds(header: &Header, kind: MatrixKind) -> [(&'static str, f64); 3] {
        let (a, mu) = (header.radius, header.viscosity);
        let force = PI * mu * a;
        match kind {
            MatrixKind::Mobility => [("UX", 1.0), ("UY", 1.0), ("OY", 1.0 / a)],
            MatrixKind::Resistance => [("XF", force), ("YF", force), ("YT", force * a)],
        }
    }

    /// The part of a column that is along `d`, along `t` or about `d x t`, by its place in [`Self::kinds`], of a sphere: row and sign.
    fn place(self, part: usize, sphere: usize) -> (usize, f64) {
        match part {
            0 => (2 + 3 * sphere, self.side()),
            1 => (3 * sphere, 1.0),
            _ => (7 + 3 * sphere, self.side()),
        }
    }

    /// What a column says.
    fn quantities(
        self,
        column: &[f64; SIZE],
        header: &Header,
        kind: MatrixKind,
    ) -> Vec<(String, f64)> {
        let Some([along, across]) = self.factors() else {
            return Vec::new();
        };
        let mut quantities = Vec::new();
        for (sphere, number) in [(self.squirmer, 1), (1 - self.squirmer, 2)] {
            for (part, (name, unit)) in Self::kinds(header, kind).into_iter().enumerate() {
                let (row, sign) = self.place(part, sphere);
                let factor = if part == 0 { along } else { across };
                let is_read = if part == 0 {
                    self.axis == Axis::Z
                } else {
                    factor.abs() > 0.1
                };
                if is_read {
                    let value = sign * column[row] / (factor * unit);
                    quantities.push((format!("{name}{number}_{}", self.mode), value));
                }
            }
        }
        quantities
    }

    /// Notes the largest difference of a column from what the quantities make of it: both squirmers are alike, and all orientations belong together.
    fn compare(
        self,
        column: &[f64; SIZE],
        (header, kind): (&Header, MatrixKind),
        values: &Values,
        worst: &mut (f64, String),
    ) {
        let Some([along, across]) = self.factors() else {
            return;
        };
        let kinds = Self::kinds(header, kind);
        let mut expected = [Some(0.0); SIZE];
        for (sphere, number) in [(self.squirmer, 1), (1 - self.squirmer, 2)] {
            for (part, (name, _)) in kinds.into_iter().enumerate() {
                let (row, sign) = self.place(part, sphere);
                let quantity = Quantity::named(&format!("{name}{number}_{}", self.mode));
                let value = quantity.and_then(|quantity| values.get(quantity));
                let factor = if part == 0 { along } else { across };
                expected[row] = if factor.abs() > 1e-9 {
                    value.map(|value| sign * factor * value)
                } else {
                    Some(0.0)
                };
            }
        }
        for (row, expected) in expected.into_iter().enumerate() {
            let unit = if is_force(row) {
                kinds[0].1
            } else {
                kinds[2].1
            };
            let found = column[row] / unit;
            if let Some(expected) = expected {
                note(worst, [found, expected], || {
                    format!(
                        "({}, {}) and what the other slip columns make of it",
                        row + 1,
                        Column::Slip(self)
                    )
                });
            }
        }
    }
}

/// Notes the difference of two numbers that should be one, relative to the larger of them and 1, if it is the largest.
fn note(worst: &mut (f64, String), [one, other]: [f64; 2], names: impl FnOnce() -> String) {
    let difference = (one - other).abs() / one.abs().max(other.abs()).max(1.0);
    if difference > worst.0 {
        *worst = (difference, names());
    }
}

fn laws(scalars: &SMatrix<f64, SIZE, SIZE>, kind: MatrixKind) -> MatrixLaws {
    let mut asymmetry = (0.0, String::new());
    let mut images = (0.0, String::new());
    let note = |worst: &mut (f64, String), [one, other]: [(usize, usize); 2], sign: f64| {
        let entry = |(row, column): (usize, usize)| format!("({}, {})", row + 1, column + 1);
        note(worst, [scalars[one], sign * scalars[other]], || {
            format!("{} and {}", entry(one), entry(other))
        });
    };
    for (i, turned_i) in TURNED.into_iter().enumerate() {
        for (j, turned_j) in TURNED.into_iter().enumerate() {
            note(&mut asymmetry, [(i, j), (j, i)], 1.0);
            note(
                &mut images,
                [(i, j), (exchanged(i), exchanged(j))],
                turned_i * turned_j,
            );
            let ((turned_i, sign_i), (turned_j, sign_j)) = (quarter(i), quarter(j));
            note(&mut images, [(i, j), (turned_i, turned_j)], sign_i * sign_j);
        }
    }
    // Velocities and spins, forces and torques each in one unit: only so do signs of eigenvalues mean what they should.
    // The geometric mean of 6 pi and 8 pi over the 4 pi of mixed entries.
    let unit = match kind {
        MatrixKind::Mobility => 48.0_f64.sqrt() / 4.0,
        MatrixKind::Resistance => 4.0 / 48.0_f64.sqrt(),
    };
    let congruent = SMatrix::<f64, SIZE, SIZE>::from_fn(|i, j| {
        let is_mixed = is_force(i) != is_force(j);
        scalars[(i, j)] * if is_mixed { unit } else { 1.0 }
    });
    let symmetric = (congruent + congruent.transpose()) * 0.5;
    MatrixLaws {
        asymmetry,
        images,
        smallest_eigenvalue: symmetric.symmetric_eigenvalues().min(),
    }
}
