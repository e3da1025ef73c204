//! The kernels that a trajectory and a solve spend their time in:
//! `cargo bench -p squirmers-compare --bench kernels`.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the bench")]

use std::sync::{Arc, OnceLock};

use compare::EXACT_TABLE_TOLERANCE;
use divan::{Bencher, black_box};
use exact::Exact;
use lt::{Form, Lubrication};
use scene::mobility::{
    External, Heading, MobilitySet, ModeMobility, PairMobility, PairVelocity, pair_velocity,
};
use scene::ode::Stepper;
use scene::{Gap, Hydrodynamics, LoadSet, Repulsion, Squirmer, TableOptions, Tabulated};

fn main() {
    divan::main();
}

/// What a planar collision reads.
const READ: MobilitySet = MobilitySet {
    loads: LoadSet::planar(2),
    torque: false,
};

/// Logarithms of gaps from where repulsion holds the pair to where lubrication theory is cut.
const LN_GAPS: [f64; 8] = [-5.3, -0.2, -3.1, -4.6, -1.7, -0.9, -2.4, -3.9];

/// The table of the exact loads that every bench here reads, built once.
fn table() -> &'static Tabulated {
    static TABLE: OnceLock<Tabulated> = OnceLock::new();
    TABLE.get_or_init(|| {
        let options = TableOptions {
            set: LoadSet::all(2),
            tolerance: EXACT_TABLE_TOLERANCE,
            smallest_gap: 1e-4,
        };
        Tabulated::build(Arc::new(Exact::new()), options, &|_| ()).unwrap()
    })
}

fn velocity<M: Hydrodynamics>(
    model: &M,
    squirmers: &[Squirmer; 2],
    ln_gap: f64,
    angles: [f64; 2],
    repulsion: Repulsion,
) -> PairVelocity<f64> {
    let gap = Gap::from_ln(ln_gap);
    let (mut pair, mut modes) = <(PairMobility, [ModeMobility; 2])>::default();
    (model.interacting_mobility(gap, READ, (&mut pair, &mut modes))).unwrap();
    let headings = angles.map(|angle: f64| Heading {
        cosine: angle.cos(),
        transverse: angle.sin(),
    });
    let external = External {
        repulsion: repulsion.force(gap),
        torque: None,
    };
    pair_velocity((&pair, &modes), squirmers, &headings, &external)
}

fn bench_velocity<M: Hydrodynamics>(bencher: Bencher<'_, '_>, model: &M) {
    let squirmers = [Squirmer::with_beta(1.0, 5.0).unwrap(); 2];
    bencher.counter(LN_GAPS.len()).bench(|| {
        for ln_gap in LN_GAPS {
            let angles = [ln_gap, 1.0 + ln_gap];
            black_box(velocity(
                model,
                black_box(&squirmers),
                black_box(ln_gap),
                angles,
                Repulsion::PAPER,
            ));
        }
    });
}

/// Mobilities, sines and sums over the causes of one right-hand side.
#[divan::bench]
fn right_hand_side_lubrication(bencher: Bencher<'_, '_>) {
    bench_velocity(bencher, &Lubrication::new(Form::Published));
}

#[divan::bench]
fn right_hand_side_table(bencher: Bencher<'_, '_>) {
    bench_velocity(bencher, table());
}

#[divan::bench]
fn table_look_up(bencher: Bencher<'_, '_>) {
    let table = table();
    bencher.counter(LN_GAPS.len()).bench(|| {
        for ln_gap in LN_GAPS {
            black_box(
                table
                    .mobility(Gap::from_ln(black_box(ln_gap)), READ)
                    .unwrap(),
            );
        }
    });
}

#[divan::bench]
fn mobility_lubrication(bencher: Bencher<'_, '_>) {
    let model = Lubrication::new(Form::Published);
    bencher.counter(LN_GAPS.len()).bench(|| {
        for ln_gap in LN_GAPS {
            black_box(
                model
                    .mobility(Gap::from_ln(black_box(ln_gap)), READ)
                    .unwrap(),
            );
        }
    });
}

#[divan::bench]
fn velocity_by_mobility(bencher: Bencher<'_, '_>) {
    let squirmers = [Squirmer::with_beta(1.0, 5.0).unwrap(); 2];
    let model = Lubrication::new(Form::Published);
    let gap = Gap::new(0.01).unwrap();
    let mobility = model.mobility(gap, READ).unwrap();
    let headings = [0.3, 1.1].map(|angle: f64| Heading {
        cosine: angle.cos(),
        transverse: angle.sin(),
    });
    let external = External {
        repulsion: 0.1,
        torque: None,
    };
    bencher.bench(|| {
        pair_velocity(
            black_box((&mobility.pair, &mobility.modes[..2])),
            black_box(&squirmers),
            black_box(&headings),
            &external,
        )
    });
}

/// A whole collision of the paper's Fig. 6 at tolerance 1e-8.
mod collision {
    use super::*;
    use compare::{Approach, Case};
    use scene::{Plan, Run, RunOptions, run_observed};

    fn bench(bencher: Bencher<'_, '_>, run: &dyn Fn(&Plan, &RunOptions) -> Run, dx: f64) {
        let case = Case {
            approach: Approach::HeadOn,
            beta: 5.0,
            dx,
            dz: 0.0,
        };
        let scene = case.scene().unwrap();
        let options = RunOptions::default();
        bencher.bench_local(|| run(&Plan::new(black_box(&scene)).unwrap(), &options));
    }

    #[divan::bench(args = [1.0, 2.0, 3.0])]
    fn lubrication(bencher: Bencher<'_, '_>, dx: f64) {
        let model = Lubrication::new(Form::Published);
        let run =
            |plan: &Plan, options: &RunOptions| model.run(plan, options, &mut |_| {}).unwrap();
        bench(bencher, &run, dx);
    }

    #[divan::bench(args = [1.0, 2.0, 3.0])]
    fn tabulated_exact(bencher: Bencher<'_, '_>, dx: f64) {
        let run = |plan: &Plan, options: &RunOptions| {
            run_observed(plan, table(), options, &mut |_| {}).unwrap()
        };
        bench(bencher, &run, dx);
    }
}

/// The stepper's own work: a step of a system of six equations that costs next to nothing.
#[divan::bench]
fn stepper(bencher: Bencher<'_, '_>) {
    let mut system = |_: f64, y: &[f64; 6]| y.map(|v| -v);
    bencher.bench_local(|| {
        let start = black_box([1.0, 0.5, -0.5, 0.2, 0.1, -1.0]);
        let mut stepper = Stepper::new(&mut system, 0.0, start, 1e-8, 1.0).unwrap();
        stepper.step(&mut system, 1.0).unwrap()
    });
}

/// Exact loads of both spheres at a gap of 0.01 radii of the smaller one, by the ratio of the radii.
mod exact_loads {
    use super::*;

    #[divan::bench(args = [1.0, 2.0, 10.0, 100.0], max_time = 3)]
    fn of_each(bencher: Bencher<'_, '_>, ratio: f64) {
        let exact = Exact::of_ratio(ratio).unwrap();
        let gap = Gap::new(0.01).unwrap();
        let set = LoadSet::all(2);
        bencher.bench(|| {
            exact
                .interacting_loads_of_each(black_box(gap), set)
                .unwrap()
        });
    }
}

/// Boundary elements, by refinement level.
mod boundary_elements {
    use bem::Bem;
    use bem::surface::{Block, Profile, Surface, Target, Work};

    use super::*;

    /// Panel quadrature: the velocities at one node by all hat functions of its own sphere.
    #[divan::bench(args = [1, 2, 3])]
    fn panel_quadrature(bencher: Bencher<'_, '_>, level: usize) {
        let model = Bem::new(level).unwrap();
        let gap = Gap::new(0.1).unwrap();
        let family = model.family(gap);
        let profile = || Profile::beside_mirror_image(gap.eps());
        let mesh = family.at(gap.eps());
        let surface: Surface = Surface::new((mesh.clone(), profile()), (&mesh, profile()));
        let target = Target {
            point: mesh.vertices[0],
            reference: mesh.vertices[0],
            node: Some(0),
        };
        let nodes = surface.nodes().len();
        let mut row = vec![Block::default(); nodes];
        bencher
            .counter(nodes)
            .bench_local(|| surface.add_row(black_box(&target), &mut row, &mut Work::default()));
    }

    /// Assembly and factorisation of all symmetry classes.
    #[divan::bench(args = [1, 2], max_time = 3)]
    fn assembly_and_factorisation(bencher: Bencher<'_, '_>, level: usize) {
        let model = Bem::new(level).unwrap();
        let gap = Gap::new(0.1).unwrap();
        bencher.bench(|| model.solve(black_box(gap), LoadSet::all(2)).unwrap());
    }

    /// The dense factorisation alone, as large as the largest symmetry class.
    #[divan::bench(args = [100, 200, 400])]
    fn factorisation(bencher: Bencher<'_, '_>, unknowns: usize) {
        let entry = |i: usize, j: usize| {
            let diagonal = if i == j { 2.0 } else { 0.0 };
            diagonal + 1.0 / (1.0 + (i as f64 - j as f64).abs())
        };
        let matrix = faer::Mat::from_fn(unknowns, unknowns, entry);
        bencher.bench(|| black_box(&matrix).partial_piv_lu());
    }
}
