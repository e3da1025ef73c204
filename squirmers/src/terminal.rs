//! Tables on the terminal. They fit its width, and numbers are never broken into two lines.

use comfy_table::{CellAlignment, ColumnConstraint, ContentArrangement, Table, Width, presets};

use crate::streams::print_line;

/// Characters in a line of a terminal.
const TERMINAL: u16 = 80;

/// A table of words, which are wrapped to the width of the terminal.
pub(crate) fn words(rows: impl Iterator<Item = Vec<String>>) -> Table {
    let mut table = Table::new();
    table
        .load_preset(presets::NOTHING)
        .set_content_arrangement(ContentArrangement::Dynamic)
        .set_width(TERMINAL);
    table.add_rows(rows);
    for column in table.column_iter_mut() {
        column.set_padding((0, 1));
    }
    table
}

pub(crate) fn print_rows(header: &[&str], rows: impl Iterator<Item = Vec<String>>) {
    let mut table = Table::new();
    table.load_preset(presets::NOTHING).set_header(header);
    // Headers are wrapped to the width of the terminal; the other cells are not.
    table
        .set_content_arrangement(ContentArrangement::Dynamic)
        .set_width(TERMINAL);
    let rows: Vec<_> = rows.collect();
    let width = |column: usize| {
        let cells = rows.iter().filter_map(|row| row.get(column));
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<_> = (0..header.len()).map(width).collect();
    table.add_rows(rows);
    for (column, width) in table.column_iter_mut().zip(widths) {
        column.set_cell_alignment(CellAlignment::Right);
        column.set_padding((0, 1));
        let whole = Width::Fixed(u16::try_from(width + 1).unwrap_or(TERMINAL));
        column.set_constraint(ColumnConstraint::LowerBoundary(whole));
    }
    print_line!("{table}");
}
