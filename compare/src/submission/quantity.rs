//! What a submission may say of a pair at a gap: named numbers, each for the sphere that moves or squirms and for the other one.

use std::collections::HashMap;
use std::sync::LazyLock;

use scene::{Gap, Hydrodynamics, LoadSet, MAX_MODES, PairLoads, SceneError, SelfOther, SwirlLoads};

/// Loads that are not by swirl, each for self and other, in the order of [`PairLoads::columns`].
pub(super) const SQUIRMING: usize = LoadSet::all(MAX_MODES).column_count() / 2;

/// The same and the loads by swirl, in the order of [`SwirlLoads::columns`].
pub(super) const LOADS: usize = SQUIRMING + 3 * MAX_MODES;

/// The same and the mobilities.
pub(super) const RIGID: usize = LOADS + MOBILITIES.len();

/// The same and the velocities by each squirming mode.
pub(super) const PAIRS: usize = RIGID + VELOCITIES.len() * MAX_MODES;

/// All quantities.
pub const QUANTITIES: usize = 2 * PAIRS;

/// The mobilities, as axis and kind of their names, in the order of the resistance scalars.
const MOBILITIES: [(char, char); 5] = [('x', 'a'), ('y', 'a'), ('y', 'b'), ('x', 'c'), ('y', 'c')];

/// The velocities by a squirming mode.
const VELOCITIES: [&str; 3] = ["UX", "UY", "OY"];

/// Every kind of quantity with its meaning, for viscosity 1 and radius 1. `d` is the unit vector from sphere 1 to sphere 2, `t` one across it; sphere 1
/// moves, is pulled or squirms; `c = p . d`, `p_t = p . t`, `W_n = 2 P_n'(c)/(n (n + 1))`.
pub const KINDS: [(&str, &str); 20] = [
    (
        "X11A, X12A",
        "force along -d on sphere 1, 2 per 6 pi U1 along d, sphere 2 still",
    ),
    (
        "Y11A, Y12A",
        "force along -t on sphere 1, 2 per 6 pi U1 along t",
    ),
    (
        "Y11B, Y12B",
        "force along t on sphere 1, 2 per 4 pi spin of sphere 1 about d x t",
    ),
    (
        "X11C, X12C",
        "torque about -d on sphere 1, 2 per 8 pi spin of sphere 1 about d",
    ),
    (
        "Y11C, Y12C",
        "torque about -(d x t) on sphere 1, 2 per 8 pi spin of sphere 1 about d x t",
    ),
    (
        "XF1_n, XF2_n",
        "force along d on sphere 1, 2 per pi B_n P_n(c), both still",
    ),
    (
        "YF1_n, YF2_n",
        "force along t on sphere 1, 2 per pi B_n W_n(c) p_t, both still",
    ),
    (
        "YT1_n, YT2_n",
        "torque about d x t on sphere 1, 2 per pi B_n W_n(c) p_t, both still",
    ),
    (
        "XTC1_n, XTC2_n",
        "torque about d on sphere 1, 2 per pi C_n P_n(c), both still",
    ),
    (
        "YFC1_n, YFC2_n",
        "force along d x t on sphere 1, 2 per pi C_n W_n(c) p_t, both still",
    ),
    (
        "YTC1_n, YTC2_n",
        "torque about t on sphere 1, 2 per pi C_n W_n(c) p_t, both still",
    ),
    (
        "x11a, x12a",
        "6 pi times the velocity of sphere 1, 2 along d per force on sphere 1 along d",
    ),
    (
        "y11a, y12a",
        "6 pi times the velocity of sphere 1, 2 along t per force on sphere 1 along t",
    ),
    (
        "y11b, y12b",
        "4 pi times the spin of sphere 1, 2 about d x t per force on sphere 1 along t",
    ),
    (
        "x11c, x12c",
        "8 pi times the spin of sphere 1, 2 about d per torque on sphere 1 about d",
    ),
    (
        "y11c, y12c",
        "8 pi times the spin of sphere 1, 2 about d x t per torque on sphere 1 about d x t",
    ),
    (
        "UX1_n, UX2_n",
        "velocity of sphere 1, 2 along d per B_n P_n(c), both free",
    ),
    (
        "UY1_n, UY2_n",
        "velocity of sphere 1, 2 along t per B_n W_n(c) p_t, both free",
    ),
    (
        "OY1_n, OY2_n",
        "spin of sphere 1, 2 about d x t per B_n W_n(c) p_t, both free",
    ),
    ("n", "slip mode, 1 to 8"),
];

static NAMES: LazyLock<Vec<String>> = LazyLock::new(|| {
    let set = LoadSet::all(MAX_MODES).with_swirl(MAX_MODES);
    let loads = (PairLoads::zero(set).named().into_iter()).chain(SwirlLoads::zero(set).named());
    let mobilities =
        MOBILITIES.map(|(axis, kind)| ["11", "12"].map(|k| format!("{axis}{k}{kind}")));
    let velocities = (1..=MAX_MODES)
        .flat_map(|n| VELOCITIES.map(|kind| [1, 2].map(|sphere| format!("{kind}{sphere}_{n}"))));
    (loads.map(|(name, _)| name))
        .chain(mobilities.into_iter().flatten())
        .chain(velocities.flatten())
        .collect()
});

static INDICES: LazyLock<HashMap<&'static str, usize>> = LazyLock::new(|| {
    let names = NAMES.iter().map(String::as_str);
    names.zip(0..).collect()
});

/// One of the named numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Quantity(pub(super) usize);

impl Quantity {
    /// All of them: loads, loads by swirl, mobilities, velocities.
    pub fn all() -> impl Iterator<Item = Self> {
        (0..QUANTITIES).map(Self)
    }

    /// The quantity of this name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        INDICES.get(name).map(|&index| Self(index))
    }

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        &NAMES[self.0]
    }

    /// Whether it is a load on spheres whose motion is given, and not a velocity of free ones.
    #[must_use]
    pub fn is_load(self) -> bool {
        self.0 < 2 * LOADS
    }

    /// The slip mode that causes it, if it is by slip.
    #[must_use]
    pub fn mode(self) -> Option<usize> {
        let (_, mode) = self.name().split_once('_')?;
        mode.parse().ok()
    }

    /// Whether it is by swirl.
    #[must_use]
    pub fn is_by_swirl(self) -> bool {
        (2 * SQUIRMING..2 * LOADS).contains(&self.0)
    }

    /// Whether it is a torque by a translation or by slip, or a force by a spin, or a spin by a force or slip.
    #[must_use]
    pub fn is_torque(self) -> bool {
        let name = self.name();
        ["YT", "XT", "OY"].iter().any(|kind| name.starts_with(kind))
            || name.ends_with(['B', 'C', 'b', 'c'])
    }

    /// Whether it belongs to the sphere that moves or squirms, and not to the other one.
    #[must_use]
    pub fn is_own(self) -> bool {
        self.0.is_multiple_of(2)
    }

    /// The same quantity of the other sphere.
    #[must_use]
    pub fn partner(self) -> Self {
        Self(self.0 ^ 1)
    }

    /// Its value for two spheres infinitely far apart.
    #[must_use]
    pub fn isolated(self) -> f64 {
        match self.name() {
            "X11A" | "Y11A" | "X11C" | "Y11C" | "x11a" | "y11a" | "x11c" | "y11c" => 1.0,
            "XF1_1" | "YF1_1" => 4.0,
            "XTC1_1" | "YTC1_1" => -8.0,
            "UX1_1" | "UY1_1" => 2.0 / 3.0,
            _ => 0.0,
        }
    }

    /// What errors are measured in: the larger of the true value and that of a lone sphere, which is 4 for thrusts, 2/3 for all velocities by slip, 1 else.
    #[must_use]
    pub fn scale(self, truth: f64) -> f64 {
        let lone = match self.isolated().abs() {
            _ if self.0 >= 2 * RIGID => 2.0 / 3.0,
            none if none <= 0.0 => 1.0,
            some => some,
        };
        truth.abs().max(lone)
    }
}

impl std::fmt::Display for Quantity {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.pad(self.name())
    }
}

/// The quantities of a pair at one gap, of which some may be missing.
#[derive(Clone, Debug, PartialEq)]
pub struct Values(Box<[f64; QUANTITIES]>);

impl Default for Values {
    /// None.
    fn default() -> Self {
        Self(Box::new([f64::NAN; QUANTITIES]))
    }
}

impl Values {
    /// The loads of a model of equal spheres.
    ///
    /// # Errors
    /// Those of the model.
    pub(crate) fn of_model(
        model: &dyn Hydrodynamics,
        gap: Gap,
        set: LoadSet,
    ) -> Result<Self, SceneError> {
        let (loads, swirl) = model.loads_with_swirl(gap, set)?;
        let mut values = Self::default();
        for (name, value) in loads.named().into_iter().chain(swirl.named()) {
            if let Some(quantity) = Quantity::named(&name) {
                values.set(quantity, value);
            }
        }
        Ok(values)
    }

    /// A quantity that is there.
    #[must_use]
    pub fn get(&self, quantity: Quantity) -> Option<f64> {
        let value = self.0[quantity.0];
        value.is_finite().then_some(value)
    }

    /// Puts a finite value in its place.
    pub fn set(&mut self, quantity: Quantity, value: f64) {
        self.0[quantity.0] = value;
    }

    /// Those that are there.
    pub fn iter(&self) -> impl Iterator<Item = (Quantity, f64)> + '_ {
        Quantity::all().filter_map(|quantity| Some((quantity, self.get(quantity)?)))
    }

    /// One that units have made too large for a number, if there is any.
    pub(super) fn overflow(&self) -> Option<Quantity> {
        Quantity::all().find(|quantity| self.0[quantity.0].is_infinite())
    }

    /// Of the sphere itself and of the other one, if both are there.
    pub(super) fn pair(&self, pair: usize) -> Option<SelfOther> {
        let own = self.get(Quantity(2 * pair))?;
        Some(SelfOther::new(own, self.get(Quantity(2 * pair + 1))?))
    }

    pub(super) fn set_pair(&mut self, pair: usize, value: SelfOther) {
        self.set(Quantity(2 * pair), value.own());
        self.set(Quantity(2 * pair + 1), value.other());
    }
}
