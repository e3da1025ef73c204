//! The native part of the Python package `squirmers`: thin wrappers, whose pages are in Python. What they refuse they refuse in the words of the library.

mod array;
mod background;
mod error;
mod flow;
mod instant;
mod judge;
mod loads;
mod model;
mod outside;
mod run;
mod scene;
mod squirmer;
mod stress;
mod studies;
mod table;

/// `squirmers._native`.
#[pyo3::pymodule]
mod _native {
    #[pymodule_export]
    use crate::background::set_threads;
    #[pymodule_export]
    use crate::flow::flow;
    #[pymodule_export]
    use crate::instant::Pair;
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
    #[pymodule_export]
    use crate::stress::{Stresslet, stresses, stresslet};
    #[pymodule_export]
    use crate::studies::bound_states::bound_states;
    #[pymodule_export]
    use crate::studies::kinetics::kinetics;
    #[pymodule_export]
    use crate::studies::maps::{fates, scatter};
    #[pymodule_export]
    use crate::studies::sensitivity::sensitivity;
    #[pymodule_export]
    use crate::studies::sweep::{family_model, merge, sweep};

    /// Version of the library.
    #[expect(non_upper_case_globals, reason = "its name in Python")]
    #[pymodule_export]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}
