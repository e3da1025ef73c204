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

/// The same with the derivative `dW_n/dc` of each order.
pub(crate) fn legendre_with_slope(c: f64) -> impl Iterator<Item = (Legendre, f64)> {
    // P_(n+1)'' = P_(n-1)'' + (2 n + 1) P_n'; of n, P_n'', P_(n-1)''.
    let mut state = (1.0, 0.0, 0.0);
    legendre(c).map(move |order| {
        let (n, second, before) = state;
        state = (n + 1.0, before + (2.0 * n + 1.0) * order.derivative, second);
        (order, 2.0 * second / (n * (n + 1.0)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn val_slopes_of_the_squirming_functions_by_central_differences() {
        for c in [-1.0, -0.3, 0.0, 0.7, 1.0] {
            let h = 1e-3;
            let around = legendre(c + h).zip(legendre(c - h));
            for (n, ((_, slope), (above, below))) in
                legendre_with_slope(c).zip(around).enumerate().take(6)
            {
                let difference = (above.w - below.w) / (2.0 * h);
                assert!((slope - difference).abs() < 1e-3, "order {} at {c}", n + 1);
            }
        }
        // W_3 = (5 c^2 - 1)/4 in full.
        assert!((legendre_with_slope(0.3).nth(2).unwrap().1 - 0.75).abs() < 1e-15);
    }
}
