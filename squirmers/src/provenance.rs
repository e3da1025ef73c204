//! Provenance of a result: command, version, machine, date.

use std::time::SystemTime;

use crate::page::Provenance;

/// Provenance of a result made by `squirmers` with `arguments`, in `seconds`.
pub(crate) fn of(arguments: &[String], seconds: f64) -> Provenance {
    let mut command = String::from("squirmers");
    for argument in arguments {
        command.push(' ');
        command.push_str(argument);
    }
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let (system, architecture) = (std::env::consts::OS, std::env::consts::ARCH);
    Provenance {
        command,
        version: format!("squirmers {}", env!("CARGO_PKG_VERSION")),
        machine: format!("{}, {cores} cores, {system} {architecture}", processor()),
        threads: rayon::current_num_threads().to_string(),
        date: humantime::format_rfc3339_seconds(SystemTime::now()).to_string(),
        total_time: format!("{seconds:.1} s"),
    }
}

/// Name of the processor, if the system reports it.
fn processor() -> String {
    let information = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    (information.lines())
        .find_map(|line| line.strip_prefix("model name"))
        .and_then(|rest| rest.split_once(':'))
        .map_or("unknown processor".to_owned(), |(_, name)| {
            name.trim().to_owned()
        })
}
