//! The split into symmetry classes changes nothing: the same entries, unsplit, give the same loads.

use std::f64::consts::PI;

use bem::Bem;
use bem::mesh::Nodes;
use bem::slip;
use bem::surface::{Block, Profile, Surface, Target, Work, mirrored_z};
use nalgebra::{DMatrix, DVector, Vector3};
use scene::{Gap, LoadSet, PairLoads, SelfOther};

/// Two spheres, sphere 2 in the mirrored frame, so that its nodes are those of sphere 1.
struct Unsplit {
    surface: Surface,
    matrix: DMatrix<f64>,
}

impl Unsplit {
    fn new(model: &Bem, gap: Gap) -> Self {
        let family = model.family(gap);
        let (eps, smallest) = (gap.eps(), family.smallest);
        let reference = family.at(smallest);
        let profile = if family.largest.is_finite() {
            Profile::beside_mirror_image(eps)
        } else {
            Profile::alone()
        };
        let surface: Surface = Surface::new(
            (family.at(eps), profile),
            (&reference, Profile::beside_mirror_image(smallest)),
        );
        let references = Nodes::<6>::new(&reference).points;
        let count = references.len();
        let mut matrix = DMatrix::zeros(6 * count, 6 * count);
        for (i, (point, reference)) in surface.nodes().iter().zip(&references).enumerate() {
            let own = row(&surface, point, reference, Some(i));
            let other = row(
                &surface,
                &mirrored_z(point, 2.0 + eps),
                &mirrored_z(reference, 2.0 + smallest),
                None,
            );
            for j in 0..count {
                let fixed = surface.deflation(j) / (2.0 * PI);
                for a in 0..3 {
                    let mirror = if a == 2 { -1.0 } else { 1.0 };
                    for c in 0..3 {
                        let own = own[j][a][c] + point[a] * fixed[c];
                        let other = mirror * other[j][a][c];
                        let half = 3 * count;
                        matrix[(3 * i + a, 3 * j + c)] = own;
                        matrix[(half + 3 * i + a, half + 3 * j + c)] = own;
                        matrix[(3 * i + a, half + 3 * j + c)] = other;
                        matrix[(half + 3 * i + a, 3 * j + c)] = other;
                    }
                }
            }
        }
        Self { surface, matrix }
    }

    /// Minus the densities on spheres 1 and 2 when sphere 1 moves so and sphere 2 rests.
    fn tractions(&self, u: impl Fn(&Vector3<f64>) -> Vector3<f64>) -> [Vec<Vector3<f64>>; 2] {
        let count = self.surface.nodes().len();
        let mut right = DVector::zeros(6 * count);
        for (i, normal) in self.surface.nodes().iter().enumerate() {
            right.fixed_rows_mut::<3>(3 * i).copy_from(&u(normal));
        }
        let density = self.matrix.clone().lu().solve(&right).unwrap();
        [0, count].map(|first| {
            (first..first + count)
                .map(|v| -density.fixed_rows::<3>(3 * v).into_owned())
                .collect()
        })
    }

    fn force_and_torque(&self, tractions: &[Vector3<f64>]) -> (Vector3<f64>, Vector3<f64>) {
        let mut total = (Vector3::zeros(), Vector3::zeros());
        for (v, f) in tractions.iter().enumerate() {
            let (force, torque) = self.surface.force_and_torque(v, f);
            total = (total.0 + force, total.1 + torque);
        }
        total
    }

    fn work(&self, tractions: &[Vector3<f64>], u: impl Fn(&Vector3<f64>) -> Vector3<f64>) -> f64 {
        let weights = self.surface.tangential_part(u);
        weights.iter().zip(tractions).map(|(w, f)| w.dot(f)).sum()
    }

    /// All loads, after the definitions in `scene::loads`; slip by the reciprocal theorem.
    fn loads(&self, modes: usize) -> PairLoads {
        let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
        let [axial, across, turning, twisting] = [
            self.tractions(|_| z),
            self.tractions(|_| x),
            self.tractions(|n| y.cross(n)),
            self.tractions(|n| z.cross(n)),
        ];
        let both = |t: &[Vec<Vector3<f64>>; 2]| [0, 1].map(|k| self.force_and_torque(&t[k]));
        let mut loads = PairLoads::zero(LoadSet::all(modes));
        // In the mirrored frame of sphere 2, z of forces and x, y of torques change sign.
        let pair = |[own, other]: [f64; 2], unit: f64| SelfOther::new(own / unit, other / unit);
        let [one, two] = both(&axial);
        loads.xa = pair([one.0.z, -two.0.z], -6.0 * PI);
        let [one, two] = both(&across);
        loads.ya = pair([one.0.x, two.0.x], -6.0 * PI);
        let [one, two] = both(&turning);
        loads.yb = pair([one.0.x, two.0.x], 4.0 * PI);
        loads.yc = pair([one.1.y, -two.1.y], -8.0 * PI);
        let [one, two] = both(&twisting);
        loads.xc = pair([one.1.z, two.1.z], -8.0 * PI);
        for (n, mode) in (1..).zip(loads.modes_mut()) {
            let along = |normal: &Vector3<f64>| slip::axisymmetric(n, &z, normal);
            let sideways = |normal: &Vector3<f64>| slip::transverse(n, &z, &x, normal);
            mode.xf = pair(
                [self.work(&axial[0], along), -self.work(&axial[1], along)],
                PI,
            );
            let [one, two] = [0, 1].map(|k| self.work(&across[k], sideways));
            mode.yf = pair([one, two], PI);
            let [one, two] = [0, 1].map(|k| self.work(&turning[k], sideways));
            mode.yt = pair([one, -two], PI);
        }
        loads
    }
}

fn row(
    surface: &Surface,
    point: &Vector3<f64>,
    reference: &Vector3<f64>,
    node: Option<usize>,
) -> Vec<Block> {
    let mut row = vec![Block::default(); surface.nodes().len()];
    let target = Target {
        point: *point,
        reference: *reference,
        node,
    };
    surface.add_row(&target, &mut row, &mut Work::default());
    row
}

#[test]
fn the_split_systems_give_the_loads_of_the_unsplit_one_to_rounding() {
    let model = Bem::new(1).unwrap();
    for eps in [1.5, 0.3] {
        let gap = Gap::new(eps).unwrap();
        let split = bem::pair::solve(model.family(gap), eps, LoadSet::all(2)).unwrap();
        let unsplit = Unsplit::new(&model, gap).loads(2);
        for ((name, a), (_, b)) in split.loads.named().into_iter().zip(unsplit.named()) {
            let error = (a - b).abs() / b.abs().max(1.0);
            assert!(error < 1e-10, "{name} {a} {b}: {error:e} at gap {eps}");
        }
    }
}
