//! The native part of the Python package `squirmers`: thin wrappers, whose pages are in Python. What they refuse they refuse in the words of the library.

mod array;
mod background;
mod error;
mod judge;
mod loads;
mod model;
mod outside;
mod run;
mod scene;
mod squirmer;
mod table;

/// `squirmers._native`.
#[pyo3::pymodule]
mod _native {
    #[pymodule_export]
    use crate::background::set_threads;
    #[pymodule_export]
    use crate::judge::{judge, leaderboard, reference_files};
    #[pymodule_export]
    use crate::loads::{coefficients, loads};
    #[pymodule_export]
    use crate::model::Model;
    #[pymodule_export]
    use crate::run::{Run, run};
    #[pymodule_export]
    use crate::scene::Scene;
    #[pymodule_export]
    use crate::squirmer::Squirmer;

    /// Version of the library.
    #[expect(non_upper_case_globals, reason = "its name in Python")]
    #[pymodule_export]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}
