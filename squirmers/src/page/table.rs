//! Tables of the page: rounded numbers to read, and the full CSV text to download.

use std::borrow::Cow;

use serde::Serialize;

/// A table with its CSV.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Table {
    /// Caption.
    pub caption: String,
    /// File name of the CSV.
    pub file_name: String,
    /// The CSV text, with numbers that are not rounded.
    pub csv: String,
    /// Names of the columns.
    pub headers: Vec<String>,
    /// Fields as in the CSV.
    pub records: Vec<Vec<String>>,
}

/// A field of a table whose columns are not the fields of a type.
pub(super) enum Cell {
    Text(String),
    Number(f64),
    Count(usize),
}

impl Table {
    /// The table of `rows`. Its columns have the names of the fields.
    ///
    /// # Errors
    /// [`csv::Error`] if a row has nested fields.
    pub fn from_rows<T: Serialize>(
        caption: &str,
        file_name: &str,
        rows: &[T],
    ) -> Result<Self, csv::Error> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        for row in rows {
            writer.serialize(row)?;
        }
        let bytes = (writer.into_inner()).map_err(|error| csv::Error::from(error.into_error()))?;
        Self::from_csv(caption, file_name, &String::from_utf8_lossy(&bytes))
    }

    /// The table of a CSV text with a header row.
    ///
    /// # Errors
    /// [`csv::Error`] if rows differ in length.
    pub fn from_csv(caption: &str, file_name: &str, csv: &str) -> Result<Self, csv::Error> {
        let mut reader = csv::Reader::from_reader(csv.as_bytes());
        let fields = |record: &csv::StringRecord| record.iter().map(str::to_owned).collect();
        let headers = fields(reader.headers()?);
        let records = (reader.records())
            .map(|record| Ok(fields(&record?)))
            .collect::<Result<_, csv::Error>>()?;
        Ok(Self {
            caption: caption.to_owned(),
            file_name: file_name.to_owned(),
            csv: csv.to_owned(),
            headers,
            records,
        })
    }

    pub(super) fn from_cells(
        caption: &str,
        file_name: &str,
        headers: Vec<String>,
        rows: impl Iterator<Item = Vec<Cell>>,
    ) -> Self {
        let text = |cell| match cell {
            Cell::Text(text) => text,
            Cell::Number(value) => f64::to_string(&value),
            Cell::Count(count) => count.to_string(),
        };
        let records: Vec<Vec<String>> = (rows)
            .map(|row| row.into_iter().map(text).collect())
            .collect();
        let line = |fields: &Vec<String>| {
            let fields: Vec<Cow<'_, str>> = fields.iter().map(|f| quoted(f)).collect();
            fields.join(",") + "\n"
        };
        let csv = [&headers].into_iter().chain(&records).map(line).collect();
        Self {
            caption: caption.to_owned(),
            file_name: file_name.to_owned(),
            csv,
            headers,
            records,
        }
    }

    /// Whether every field of a column is a number.
    pub(super) fn is_numeric(&self, column: usize) -> bool {
        let field = |record: &Vec<String>| record.get(column).map_or("", String::as_str).to_owned();
        self.records.iter().all(|r| field(r).parse::<f64>().is_ok())
    }
}

/// A field with the quotation marks that CSV needs.
fn quoted(field: &str) -> Cow<'_, str> {
    if field.contains([',', '"', '\n', '\r']) {
        Cow::Owned(format!("\"{}\"", field.replace('"', "\"\"")))
    } else {
        Cow::Borrowed(field)
    }
}

/// A field as the page shows it: angles with 4 decimals, times and errors with 3 significant digits, other numbers
/// with 5, NaN as a dash.
pub(super) fn displayed(header: &str, field: &str) -> String {
    if field.parse::<i64>().is_ok() {
        return field.replace('-', "\u{2212}");
    }
    let Ok(value) = field.parse::<f64>() else {
        return field.to_owned();
    };
    if !value.is_finite() {
        return match value {
            v if v > 0.0 => "∞".to_owned(),
            v if v < 0.0 => "\u{2212}∞".to_owned(),
            _ => "–".to_owned(),
        };
    }
    let text = if header.ends_with("_deg") {
        format!("{:.4}", rounded(value, 4))
    } else if header.contains("seconds") || header.contains("error") {
        significant(value, 3)
    } else {
        significant(value, 5)
    };
    text.replace('-', "\u{2212}")
}

/// A number rounded to `decimals`, without a negative zero.
pub(crate) fn rounded(value: f64, decimals: i32) -> f64 {
    let unit = 10.0_f64.powi(decimals);
    (value * unit).round() / unit + 0.0
}

/// A number with `digits` significant digits and no trailing zeros; very small and large numbers with an exponent.
fn significant(value: f64, digits: usize) -> String {
    if value.abs() < f64::MIN_POSITIVE {
        return "0".to_owned();
    }
    let scientific = format!("{value:.*e}", digits - 1);
    let Some((mantissa, exponent)) = scientific.split_once('e') else {
        return scientific;
    };
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let trimmed = |text: &str| match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text.to_owned(),
    };
    if (-3..7).contains(&exponent) {
        let decimals = (digits as i32 - 1 - exponent).max(0).unsigned_abs() as usize;
        trimmed(&format!("{value:.decimals$}"))
    } else {
        format!("{}e{exponent}", trimmed(mantissa))
    }
}
