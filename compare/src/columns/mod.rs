//! What the columns of every CSV file mean, with their units.
//!
//! The macro `columns!` defines the struct of a row with the documentation and the unit of each field. [`FILES`] lists the
//! files, and [`page`] is the text of `docs/COLUMNS.md`.

mod files;

pub use files::{CsvFile, FILES, page};

/// A column of a CSV file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Column {
    /// Name in the header line.
    pub name: &'static str,
    /// Unit, one of [`UNITS`].
    pub unit: &'static str,
    /// The meaning in a few sentences, without the unit.
    pub doc: &'static str,
}

/// A row of a CSV file, whose columns are its fields.
pub trait Columns {
    /// What a row is.
    const ABOUT: &'static str;
    /// The columns in their order.
    const COLUMNS: &'static [Column];
}

/// Every unit with its meaning.
pub const UNITS: [(&str, &str); 17] = [
    ("a", "radius of a squirmer"),
    (
        "V_s",
        "swimming speed of a lone squirmer; in scene files the unit of speed",
    ),
    ("a/V_s", "time in which a lone squirmer swims one radius"),
    (
        "a^2 V_s",
        "rate over the number of squirmers in a volume `a^3`",
    ),
    (
        "a^4 V_s",
        "diffusivity of positions over the number of squirmers in a volume `a^3`",
    ),
    (
        "V_s/a^2",
        "diffusivity of positions times the number of squirmers in a volume `a^3`",
    ),
    ("V_s/a", "rate; for angular velocities, radians per `a/V_s`"),
    (
        "mu V_s/a",
        "pressure and traction; `mu` is the viscosity of the fluid",
    ),
    (
        "mu a^2 V_s",
        "stresslet, and work; `mu` is the viscosity of the fluid",
    ),
    ("mu a V_s^2", "power"),
    ("mu a^3", "integral of a stresslet over time"),
    ("deg", "degrees, anticlockwise positive"),
    ("rad/a", "radians per radius of displacement"),
    ("s", "seconds of wall-clock time"),
    ("MiB", "2^20 bytes of memory"),
    ("-", "none: pure numbers and words"),
    ("varies", "the meaning says which"),
];

/// The names of columns, in their order.
#[must_use]
pub fn names(columns: &[Column]) -> Vec<&'static str> {
    columns.iter().map(|column| column.name).collect()
}

/// The header line of the rows, without its end.
pub(crate) fn header<R: Columns>() -> String {
    names(R::COLUMNS).join(",")
}

/// Defines the struct of a row and its [`Columns`]. Each field has documentation, then `#[unit = "..."]`, then other
/// attributes.
macro_rules! columns {
    (
        $(#[doc = $about:literal])+
        #[derive($($derive:ident),+ $(,)?)]
        $vis:vis struct $row:ident {
            $(
                $(#[doc = $doc:literal])+
                #[unit = $unit:literal]
                $(#[$attribute:meta])*
                $field_vis:vis $field:ident: $type:ty
            ),+ $(,)?
        }
    ) => {
        $(#[doc = $about])+
        #[derive($($derive),+)]
        $vis struct $row {
            $(
                $(#[doc = $doc])+
                #[doc = concat!("\n\nUnit: `", $unit, "`.")]
                $(#[$attribute])*
                $field_vis $field: $type
            ),+
        }

        impl $crate::columns::Columns for $row {
            const ABOUT: &'static str = concat!($($about),+).trim_ascii();
            const COLUMNS: &'static [$crate::columns::Column] = &[
                $($crate::columns::Column {
                    name: stringify!($field),
                    unit: $unit,
                    doc: concat!($($doc),+).trim_ascii(),
                }),+
            ];
        }
    };
}
pub(crate) use columns;
