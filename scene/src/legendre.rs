//! Legendre polynomials and the squirming functions built on them.

/// Values of one order: `P_n(c)`, `P_n'(c)` and `W_n(c) = 2 P_n'(c)/(n (n + 1))`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Legendre {
    /// `P_n(c)`.
    pub p: f64,
    /// `P_n'(c)`.
    pub derivative: f64,
    /// `W_n(c)`, the angular function of Blake's (1971) tangential squirming mode.
    pub w: f64,
}

/// Orders 1, 2, 3, … at `c` in [-1, 1], by the three-term recurrences of `P_n` and `P_n'`.
///
/// ```
/// let c = 0.3;
/// let second = scene::legendre(c).nth(1).unwrap();
/// assert!((second.p - (1.5 * c * c - 0.5)).abs() < 1e-15);
/// assert_eq!(second.w, c);
/// ```
#[inline]
pub fn legendre(c: f64) -> impl Iterator<Item = Legendre> {
    // (n, P_n, P_{n-1}, P_n', P_{n-1}')
    let mut state = (1.0, c, 1.0, 1.0, 0.0);
    std::iter::from_fn(move || {
        let (n, p, p_before, d, d_before) = state;
        let next = ((2.0 * n + 1.0) * c * p - n * p_before) / (n + 1.0);
        state = (n + 1.0, next, p, d_before + (2.0 * n + 1.0) * p, d);
        Some(Legendre {
            p,
            derivative: d,
            w: 2.0 * d / (n * (n + 1.0)),
        })
    })
}
