//! What a solve gives, and what it takes.

use scene::{ActiveLoads, PairLoads, SwirlLoads};

use crate::surface::Work;

/// Time of the parts of a solve, in seconds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Seconds {
    /// Quadrature and assembly, by the clock.
    pub assembly: f64,
    /// Factorisation and substitution, by the clock.
    pub solve: f64,
    /// Factorisation, added up over the systems, which are solved side by side.
    pub factorisation: f64,
    /// Substitution with the check of the residual, added up likewise.
    pub substitution: f64,
}

/// Loads of a pair at one gap if sphere 1 is the active one, and what they took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairSolution {
    /// The loads.
    pub loads: PairLoads,
    /// Those by swirl.
    pub swirl: SwirlLoads,
    /// Nodes on sphere 1: vertices and middles of edges. Of equal spheres each has as many.
    pub nodes: usize,
    /// Dense systems factorised.
    pub solves: usize,
    /// Wall-clock time.
    pub seconds: Seconds,
    /// What assembly was spent on.
    pub work: Work,
}

/// Loads of a pair at one gap when either sphere is the active one, and what they took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EachSolution {
    /// The loads by either.
    pub loads: [ActiveLoads; 2],
    /// Nodes on either.
    pub nodes: [usize; 2],
    /// Dense systems factorised.
    pub solves: usize,
    /// Wall-clock time.
    pub seconds: Seconds,
    /// What assembly was spent on.
    pub work: Work,
}

impl From<PairSolution> for EachSolution {
    /// Of equal spheres.
    fn from(of: PairSolution) -> Self {
        Self {
            loads: [ActiveLoads::of_equal(of.loads, of.swirl); 2],
            nodes: [of.nodes; 2],
            solves: of.solves,
            seconds: of.seconds,
            work: of.work,
        }
    }
}

impl From<EachSolution> for PairSolution {
    /// That of sphere 1.
    fn from(of: EachSolution) -> Self {
        let [ActiveLoads { pair, swirl, .. }, _] = of.loads;
        Self {
            loads: pair,
            swirl,
            nodes: of.nodes[0],
            solves: of.solves,
            seconds: of.seconds,
            work: of.work,
        }
    }
}

/// What the systems found, and the seconds of their factorisations and substitutions added up.
pub(super) fn added_up<R>(solved: Vec<(R, [f64; 2])>) -> (Vec<R>, [f64; 2]) {
    let mut seconds = [0.0; 2];
    let add = |(responses, [factorisation, substitution]): (R, [f64; 2])| {
        seconds[0] += factorisation;
        seconds[1] += substitution;
        responses
    };
    (solved.into_iter().map(add).collect(), seconds)
}
