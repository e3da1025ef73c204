//! `squirmers reference`: a package of reference numbers, to be cited and compared with.

use super::maps::SCATTER_BETA;
use crate::arguments::GeneralArguments;
use crate::error::CommandError;
use crate::streams::print_line;
use crate::terminal::print_rows;
use compare::reference::{DESCRIPTOR, Package, check_folder};

pub(super) fn run(general: &GeneralArguments) -> Result<(), CommandError> {
    check_folder(&general.out)?;
    let out = general.output()?;
    let package = Package::compute(&SCATTER_BETA, &general.model_options())?;
    package.write(&out)?;
    print_rows(
        &["file", "rows", "kB"],
        package.resources().iter().map(|of| {
            let rows = of.text.lines().count() - 1;
            let kilobytes = of.text.len().div_ceil(1000);
            vec![of.path(), rows.to_string(), kilobytes.to_string()]
        }),
    );
    print_line!("{}", general.out.join(DESCRIPTOR).display());
    Ok(())
}
