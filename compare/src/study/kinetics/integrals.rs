//! Collision integrals over isotropic incoming headings: means over encounters, and the coefficients that follow from them.
//!
//! In a suspension of `n` squirmers in a unit of volume, each with the speed `V_s` and an independent isotropic heading, one of them has
//! encounters of an impact parameter up to `b` at the rate `nu = n pi b^2 <|V|>`, and `<|V|> = 4/3 V_s`. The average `< >` over encounters
//! weighs each pair of headings by its relative speed, and points of the impact disc by their area. With a prime for what comes out:
//!
//! - rotation: headings lose their memory as `exp(-2 D_R t)`, and each encounter keeps `p.p'` of it on average, `2 D_R = nu <1 - p.p'>`.
//!   Random outgoing headings give `D_R = nu/2`;
//! - translation: swimming at `V_s` along such headings, `D_T = V_s^2/(6 D_R)`, which goes as `1/n`;
//! - displacement: jumps `d = integral of (dx/dt - V_s p) dt`, by which the other squirmer carries one besides its own swimming,
//!   `D = nu <|d|^2>/6`. With a far field `d` falls as `1/b`, and `D` grows without bound as `ln b`;
//! - alignment: `<p1'.p2' - p1.p2>`;
//! - growth: where headings have a slight polar order `P`, that is the density `(1 + 3 P.p)/(4 pi)`, encounters change it at the rate
//!   `dP/dt = L P`. Of each pair the sum `s = p1 + p2` changes, so that `L = (nu/2) <s.(s' - s)>`. Random outgoing headings give `-4/5 nu`.
//!
//! Pairs that do not part have no outgoing state. They add nothing to rates, and are left out of the means `tau` and `alignment`.

use std::f64::consts::PI;

use scene::Outcome;
use serde::{Deserialize, Serialize};

use super::collider::Outgoing;
use super::incoming::{Impact, Incoming};
use super::points::point;
use crate::CompareError;
use crate::no_run::FAILED;
use crate::sweep::Row;

/// What an encounter does: from incoming to outgoing.
pub type Kernel<'a> = dyn Fn(&Incoming) -> Result<Outgoing, CompareError> + Sync + 'a;

/// Mean relative speed of two isotropic headings, in swimming speeds.
pub const MEAN_SPEED: f64 = 4.0 / 3.0;

/// Averages over encounters. Pairs that do not part count as zero.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Means {
    /// Share of pairs that part.
    pub parting: f64,
    /// Share of pairs that stay together.
    pub bound: f64,
    /// Share of pairs that touch, or come nearer than the model resolves.
    pub contact: f64,
    /// Share of runs that failed.
    pub failed: f64,
    /// Share of pairs that come within the gap 1.
    pub meeting: f64,
    /// Time at gaps up to 1.
    pub tau: f64,
    /// `1 - p.p'`.
    pub turned: f64,
    /// Square of the displacement besides swimming.
    pub carried: f64,
    /// Change of `p1.p2`.
    pub alignment: f64,
    /// `s.(s' - s)`.
    pub growth: f64,
    /// Number of runs that failed.
    pub failures: usize,
}

/// A weighted sum over encounters.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sums {
    weight: f64,
    means: Means,
}

impl Sums {
    /// Adds an encounter; `None` is a run that failed.
    pub fn add(&mut self, weight: f64, incoming: &Incoming, outgoing: Option<&Outgoing>) {
        self.weight += weight;
        let sum = &mut self.means;
        let Some(outgoing) = outgoing else {
            sum.failed += weight;
            sum.failures += 1;
            return;
        };
        if outgoing.min_gap <= 1.0 {
            sum.meeting += weight;
        }
        if outgoing.is_lost() {
            sum.contact += weight;
            return;
        }
        if outgoing.outcome != Outcome::Scattered {
            sum.bound += weight;
            return;
        }
        let ([p1, p2], [q1, q2]) = (incoming.headings, outgoing.headings);
        let half = 0.5 * weight;
        sum.parting += weight;
        sum.tau += weight * outgoing.tau;
        // Half the square of a difference: without loss of digits where little is turned.
        sum.turned += half * 0.5 * ((q1 - p1).norm_squared() + (q2 - p2).norm_squared());
        let [one, two] = outgoing.carried.map(|d| d.norm_squared());
        sum.carried += half * (one + two);
        let (s, changed) = (p1 + p2, (q1 - p1) + (q2 - p2));
        sum.growth += weight * s.dot(&changed);
        // 2 p1.p2 = |s|^2 - 2.
        sum.alignment += weight * (s.dot(&changed) + 0.5 * changed.norm_squared());
    }

    /// The averages.
    #[must_use]
    pub fn means(&self) -> Means {
        let Self { weight, means } = *self;
        let of = |sum: f64| sum / weight;
        Means {
            parting: of(means.parting),
            bound: of(means.bound),
            contact: of(means.contact),
            failed: of(means.failed),
            meeting: of(means.meeting),
            tau: of(means.tau),
            turned: of(means.turned),
            carried: of(means.carried),
            alignment: of(means.alignment),
            growth: of(means.growth),
            failures: means.failures,
        }
    }
}

impl Means {
    /// The averages over `points` quasi-random encounters with impact parameters from `ring.0` to `ring.1`, and why the last of those that
    /// failed did. Only a quarter of the disc is sampled: mirror and exchange of the two squirmers give the others.
    #[must_use]
    pub fn sampled(
        kernel: &Kernel<'_>,
        ring: (f64, f64),
        points: usize,
        seed: u32,
    ) -> (Self, Option<String>) {
        let (mut sums, mut failure) = (Sums::default(), None);
        for index in 0..points {
            let [u, v, w] = point(index, seed);
            let incoming = Impact::of_point([u, v, 0.25 * w], ring).incoming();
            let outgoing = kernel(&incoming);
            sums.add(1.0, &incoming, outgoing.as_ref().ok());
            if let Err(error) = outgoing {
                failure = Some(error.in_one_line());
            }
        }
        (sums.means(), failure)
    }
}

impl Row for Means {
    fn outcomes(&self) -> impl Iterator<Item = &str> {
        std::iter::repeat_n(FAILED, self.failures)
    }
}

/// Rate of encounters of one squirmer with impact parameters in a ring, over `n`, in `a^2 V_s`.
#[must_use]
pub fn rate((inner, outer): (f64, f64)) -> f64 {
    MEAN_SPEED * PI * (outer * outer - inner * inner)
}

/// Coefficients of a dilute suspension, in radii and swimming speeds; `n` is the number of squirmers in a unit of volume.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coefficients {
    /// Rate of encounters of one squirmer over `n`.
    pub encounters: f64,
    /// Averages over encounters.
    pub means: Means,
    /// Mean interaction time of pairs that part.
    pub tau: f64,
    /// Rotational diffusivity by encounters over `n`.
    pub rotation: f64,
    /// Translational diffusivity that follows from it, times `n`.
    pub translation: f64,
    /// Diffusivity by displacements over `n`.
    pub displacement: f64,
    /// Mean change of `p1.p2` of pairs that part.
    pub alignment: f64,
    /// Growth rate of polar order over `n`.
    pub growth: f64,
}

/// A coefficient: its name, and its value.
pub type Quantity = (&'static str, fn(&Coefficients) -> f64);

impl Coefficients {
    /// Those of interest.
    pub const ALL: [Quantity; 6] = [
        ("tau", |of| of.tau),
        ("rotation", |of| of.rotation),
        ("translation", |of| of.translation),
        ("displacement", |of| of.displacement),
        ("alignment", |of| of.alignment),
        ("growth", |of| of.growth),
    ];

    /// From the averages over rings that make up the impact disc.
    #[must_use]
    pub fn of(rings: &[((f64, f64), Means)]) -> Self {
        let sum = |of: fn(&Means) -> f64| -> f64 {
            rings
                .iter()
                .map(|(ring, means)| rate(*ring) * of(means))
                .sum()
        };
        let encounters: f64 = rings.iter().map(|(ring, _)| rate(*ring)).sum();
        let mean = |of: fn(&Means) -> f64| sum(of) / encounters;
        let means = Means {
            parting: mean(|of| of.parting),
            bound: mean(|of| of.bound),
            contact: mean(|of| of.contact),
            failed: mean(|of| of.failed),
            meeting: mean(|of| of.meeting),
            tau: mean(|of| of.tau),
            turned: mean(|of| of.turned),
            carried: mean(|of| of.carried),
            alignment: mean(|of| of.alignment),
            growth: mean(|of| of.growth),
            failures: rings.iter().map(|(_, means)| means.failures).sum(),
        };
        let rotation = 0.5 * encounters * means.turned;
        Self {
            encounters,
            means,
            tau: means.tau / means.parting,
            rotation,
            translation: 1.0 / (6.0 * rotation),
            displacement: encounters * means.carried / 6.0,
            alignment: means.alignment / means.parting,
            growth: 0.5 * encounters * means.growth,
        }
    }
}

/// A mean over independent replications, and its standard error; the latter is NaN for one replication.
#[must_use]
pub fn mean_and_error(values: &[f64]) -> (f64, f64) {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
    (mean, (squares / (count - 1.0) / count).sqrt())
}
