//! Prints the page that describes the columns of every CSV file, `docs/COLUMNS.md`.

fn main() {
    print!("{}", compare::columns::page());
}
