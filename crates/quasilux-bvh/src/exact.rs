//! Edge functions of triangles seen so nearly edge-on that rounding would be most of them.
//!
//! Numbers are integers times powers of two. A product of two is exact in 106 bits, and a
//! difference of products is exact in 128 unless one of them is so much smaller that it cannot
//! change the sign.

/// Bits that a mantissa is moved up by before something smaller is taken away.
const ROOM: i32 = 20;

/// `mantissa 2^exponent`.
#[derive(Clone, Copy)]
struct Wide {
    mantissa: i128,
    exponent: i32,
}

/// The edge functions of the corners `a`, `b` and `c` about zero, to a common power of two.
///
/// Their signs are right and their relative errors below `2^-52`, but for such as are below
/// `2^-800` of the largest, which may come out as zero.
pub(crate) fn edge_functions([a, b, c]: [[f64; 2]; 3]) -> [f64; 3] {
    let edges = [(c, b), (a, c), (b, a)].map(|(p, q)| {
        let (left, right) = (Wide::product(p[0], q[1]), Wide::product(p[1], q[0]));
        left.minus(right)
    });
    let top = edges.iter().filter(|edge| edge.mantissa != 0).map(Wide::top).max().unwrap_or(0);
    // Only a zero, whose exponent says nothing, can have one above the top.
    edges.map(|edge| edge.mantissa as f64 * power_of_two((edge.exponent - top).min(0)))
}

impl Wide {
    /// The product of two finite numbers; its mantissa is zero or at least `2^104`.
    fn product(x: f64, y: f64) -> Self {
        let (x, y) = (Self::new(x), Self::new(y));
        Self { mantissa: x.mantissa * y.mantissa, exponent: x.exponent + y.exponent }
    }

    /// A finite number; its mantissa is zero or at least `2^52`.
    fn new(x: f64) -> Self {
        const FRACTION: u64 = (1 << 52) - 1;
        const UP: f64 = (1_u64 << 52) as f64;
        if x == 0.0 {
            return Self { mantissa: 0, exponent: 0 };
        }
        let (x, moved) = if x.abs() < f64::MIN_POSITIVE { (x * UP, 52) } else { (x, 0) };
        let size = i128::from(x.to_bits() & FRACTION | (FRACTION + 1));
        let exponent = (x.abs().to_bits() >> 52) as i32 - 1075 - moved;
        Self { mantissa: if x < 0.0 { -size } else { size }, exponent }
    }

    /// The difference of two products.
    fn minus(self, other: Self) -> Self {
        let other = Self { mantissa: -other.mantissa, ..other };
        if self.mantissa == 0 || other.mantissa == 0 {
            return if self.mantissa == 0 { other } else { self };
        }
        let (high, low) =
            if self.exponent >= other.exponent { (self, other) } else { (other, self) };
        let exponent = high.exponent - ROOM;
        // Bits fall off only where `low` is below 2^-18 of `high`, and 2^-124 of that at most.
        let low = match low.exponent - exponent {
            up @ 0.. => low.mantissa << up,
            down => low.mantissa >> (-down).min(127),
        };
        Self { mantissa: (high.mantissa << ROOM) + low, exponent }
    }

    /// The exponent of the least power of two above its size.
    fn top(&self) -> i32 {
        self.exponent + 128 - self.mantissa.unsigned_abs().leading_zeros() as i32
    }
}

/// `2^exponent` for an exponent that is not positive, zero where that is below `2^-1000`.
fn power_of_two(exponent: i32) -> f64 {
    if exponent < -1000 { 0.0 } else { f64::from_bits(((1023 + exponent) as u64) << 52) }
}

#[cfg(test)]
mod tests {
    use super::edge_functions;

    #[test]
    fn ties_are_broken() {
        // (1) (1) - (1 - e) (1 + 2 e) = -e + 2 e^2, which rounded products make a tie.
        let e = 0.5 * f64::EPSILON;
        let (b, c) = ([1.0 + 2.0 * e, 1.0], [1.0, 1.0 - e]);
        assert_eq!(c[0] * b[1], c[1] * b[0]);
        let [u, v, w] = edge_functions([[-3.0, -3.0], b, c]);
        // v = -3 (1 - e) + 3 = 3 e, w = -3 (1 + 2 e) + 3 = -6 e.
        assert!(u < 0.0 && (v / u + 3.0).abs() < 1e-15, "{u}");
        assert_eq!(w / v, -2.0);
    }

    #[test]
    fn scale_does_not_matter() {
        let corners = [[-0.3, -0.2], [0.7, -0.1], [-0.2, 0.9]];
        let wanted = edge_functions(corners);
        assert!(wanted.iter().all(|&edge| edge < 0.0));
        for (scale, times) in [(0.125, 345), (0.125, 333), (0.125, 150), (8.0, 150), (8.0, 340)] {
            let grown = |x| (0..times).fold(x, |x, _| x * scale);
            let got = edge_functions(corners.map(|corner| corner.map(grown)));
            // At 2^-1035 numbers have forty bits.
            let tolerance = if times == 345 { 1e-10 } else { 0.0 };
            for i in 0..3 {
                let (got, wanted) = (got[i] / got[0], wanted[i] / wanted[0]);
                assert!((got - wanted).abs() <= tolerance, "{scale}^{times}: {got}, not {wanted}");
            }
        }
    }

    #[test]
    fn small_products_keep_the_sign_and_large_ones_the_value() {
        let tiny = 1e-300;
        assert!(edge_functions([[0.0, 0.0], [1.0, tiny], [1.0, 2.0 * tiny]])[0] < 0.0);
        let edges = edge_functions([[0.0, 1.0], [1.0, 1.0], [1.0, tiny]]);
        assert_eq!(edges[0], edges[2]);
        assert!(edges[1] < 0.0);
        assert_eq!(edge_functions([[0.0, 0.0]; 3]), [0.0; 3]);
        assert_eq!(edge_functions([[1.0, 1.0], [2.0, 2.0], [-5.0, -5.0]]), [0.0; 3]);
    }

    #[test]
    fn products_that_cancel_do_not_show_how_large_they_were() {
        let power = |exponent: i32| {
            (0..exponent.abs()).fold(1.0, |x, _| if exponent < 0 { 0.5 * x } else { 2.0 * x })
        };
        for exponent in 600..950 {
            let (small, large) = (power(-450), power(exponent));
            let edges = edge_functions([[small, 0.0], [large, large], [0.5 * large, 0.5 * large]]);
            assert_eq!(edges[0], 0.0);
            assert_eq!(edges[1] / edges[2], -0.5, "2^{exponent}");
        }
    }
}
