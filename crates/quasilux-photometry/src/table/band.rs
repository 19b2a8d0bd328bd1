//! One polar band: the density `lerp(theta) sin(theta)`, its exact integral and quantile.
//!
//! Between two parallels the integral over the azimuth of a bilinear function is linear in theta,
//! so that the marginal density of theta is `(a (1 - s/d) + b s/d) sin(theta)`, `s` measured from
//! the end of the band that is nearer to a pole, `d` the width (Voloboy, Dmitriev and Kopylov 2003
//! give the per-cell form). With the moments `J0 = int sin`, `J1 = int s sin` its integral is `a
//! (J0 - J1/d) + b J1/d`: all terms are non-negative, so nothing cancels, however narrow the band
//! and however near the pole. Deviation: the printed formula, in `sin t - t cos t`, loses half of
//! all digits there.

use super::linear::linear_quantile;

/// Directions are kept this far inside their band or cell, in radians: a few units in the last
/// place of pi, so that rounding never leads to the far side, where the density may be zero.
pub(super) const EDGE_RAD: f64 = 4e-15;

/// A polar band between two parallels.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Band {
    start_rad: f64,
    end_rad: f64,
    /// Whether `s` runs from the end towards the start: the south pole is nearer.
    from_end: bool,
    /// Sine and cosine of the angle between the origin of `s` and the nearer pole.
    sin: f64,
    cos: f64,
    /// The linear factor at the origin of `s`, and at the other end.
    near: f64,
    far: f64,
    /// The whole density at that end, sine included.
    density_at_far: f64,
    integral: f64,
}

/// The integral up to a place in the band, and the density there.
struct Reach {
    integral: f64,
    density: f64,
}

/// `sin x`, `1 - cos x`, `int_0^x s cos s ds` and `int_0^x s sin s ds`.
struct Moments {
    sin: f64,
    versine: f64,
    s_cos: f64,
    s_sin: f64,
}

impl Band {
    /// The band between polar angles `start_rad < end_rad`, in [0, pi], with the linear factor
    /// `at_start` and `at_end`.
    pub(super) fn new(start_rad: f64, end_rad: f64, at_start: f64, at_end: f64) -> Self {
        let from_end = start_rad + end_rad > std::f64::consts::PI;
        let (pole_angle, near, far) = if from_end {
            (std::f64::consts::PI - end_rad, at_end, at_start)
        } else {
            (start_rad, at_start, at_end)
        };
        let (sin, cos) = libm::sincos(pole_angle);
        let mut band = Self {
            start_rad,
            end_rad,
            from_end,
            sin,
            cos,
            near,
            far,
            density_at_far: 0.0,
            integral: 0.0,
        };
        let whole = band.at(band.width_rad());
        band.density_at_far = whole.density;
        band.integral = whole.integral;
        band
    }

    /// Integral of the density over the band.
    pub(super) fn integral(&self) -> f64 {
        self.integral
    }

    /// The part of the integral, 0 to 1, that lies between the start of the band and `theta_rad`.
    pub(super) fn fraction_below(&self, theta_rad: f64) -> f64 {
        if self.integral <= 0.0 {
            return (theta_rad - self.start_rad) / self.width_rad();
        }
        if self.from_end {
            1.0 - self.integral_to(self.end_rad - theta_rad) / self.integral
        } else {
            self.integral_to(theta_rad - self.start_rad) / self.integral
        }
    }

    /// The polar angle below which lies `fraction` of the integral.
    pub(super) fn theta_at(&self, fraction: f64) -> f64 {
        let theta_rad = if self.from_end {
            self.end_rad - self.quantile(1.0 - fraction)
        } else {
            self.start_rad + self.quantile(fraction)
        };
        let (low, high) =
            (self.start_rad + polar_edge(self.start_rad), self.end_rad - polar_edge(self.end_rad));
        if low < high { theta_rad.clamp(low, high) } else { self.start_rad.midpoint(self.end_rad) }
    }

    /// Newton's method inside a bracket that shrinks at each step, by bisection where Newton leaves
    /// it.
    fn quantile(&self, fraction: f64) -> f64 {
        let width = self.width_rad();
        let target = fraction * self.integral;
        let (mut low, mut high) = (0.0, width);
        let mut x = width * linear_quantile(self.near * self.sin, self.density_at_far, fraction);
        for _ in 0..100 {
            let Reach { integral, density } = self.at(x);
            let excess = integral - target;
            if excess > 0.0 {
                high = x;
            } else {
                low = x;
            }
            let newton = x - excess / density;
            let is_newton = newton >= low && newton <= high;
            let next = if is_newton { newton } else { 0.5 * (low + high) };
            let step = (next - x).abs();
            x = next;
            // After a Newton step the error is below step^2 over the distance to the nearer end,
            // for the density vanishes nowhere else.
            let converged = is_newton && step <= 1e-8 * x.min(width - x);
            if converged || step <= 1e-15 * width {
                break;
            }
        }
        x
    }

    fn width_rad(&self) -> f64 {
        self.end_rad - self.start_rad
    }

    /// Integral of the density over a distance `x` from the origin of `s`.
    fn integral_to(&self, x: f64) -> f64 {
        self.at(x).integral
    }

    fn at(&self, x: f64) -> Reach {
        let m = Moments::to(x);
        let j0 = self.sin * m.sin + self.cos * m.versine;
        let j1 = (self.sin * m.s_cos + self.cos * m.s_sin) / self.width_rad();
        let t = x / self.width_rad();
        let sin_theta = self.sin * (1.0 - m.versine) + self.cos * m.sin;
        Reach {
            integral: self.near * (j0 - j1) + self.far * j1,
            density: (self.near * (1.0 - t) + self.far * t) * sin_theta.max(0.0),
        }
    }
}

impl Moments {
    fn to(x: f64) -> Self {
        let x2 = x * x;
        // Below half a radian the Maclaurin series reach the last digit with these terms.
        let (sin, versine, s_sin) = if x < 0.5 {
            (
                x * alternating(
                    x2,
                    [1.0 / 6.0, 1.0 / 20.0, 1.0 / 42.0, 1.0 / 72.0, 1.0 / 110.0, 1.0 / 156.0],
                ),
                0.5 * x2
                    * alternating(
                        x2,
                        [1.0 / 12.0, 1.0 / 30.0, 1.0 / 56.0, 1.0 / 90.0, 1.0 / 132.0, 1.0 / 182.0],
                    ),
                x * x2 / 3.0
                    * alternating(
                        x2,
                        [1.0 / 10.0, 1.0 / 28.0, 1.0 / 54.0, 1.0 / 88.0, 1.0 / 130.0, 1.0 / 180.0],
                    ),
            )
        } else {
            let (sin, cos) = libm::sincos(x);
            let half = libm::sin(0.5 * x);
            (sin, 2.0 * half * half, sin - x * cos)
        };
        Self { sin, versine, s_cos: x * sin - versine, s_sin }
    }
}

/// `1 - r0 y (1 - r1 y (1 - ...))`.
fn alternating(y: f64, ratios: [f64; 6]) -> f64 {
    ratios.iter().rev().fold(1.0, |tail, ratio| 1.0 - ratio * y * tail)
}

/// How far from a parallel directions are kept. Near theta = 0 a direction keeps its polar angle to
/// a part of itself; at 0 the distance still is not zero, for the density may be.
fn polar_edge(theta_rad: f64) -> f64 {
    EDGE_RAD * theta_rad.clamp(1e-16, 1.0)
}

/// `x` kept [`EDGE_RAD`] inside `start..end`, or halfway where that leaves no room.
pub(super) fn inside(x: f64, start: f64, end: f64) -> f64 {
    if end - start > 4.0 * EDGE_RAD {
        x.clamp(start + EDGE_RAD, end - EDGE_RAD)
    } else {
        0.5 * (start + end)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// Gauss-Legendre with five nodes on `n` panels.
    fn quadrature(n: usize, start: f64, end: f64, f: impl Fn(f64) -> f64) -> f64 {
        let nodes = [
            (0.0, 128.0 / 225.0),
            (0.538_469_310_105_683, 0.478_628_670_499_366_5),
            (-0.538_469_310_105_683, 0.478_628_670_499_366_5),
            (0.906_179_845_938_664, 0.236_926_885_056_189_1),
            (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
        ];
        let h = (end - start) / n as f64;
        (0..n)
            .flat_map(|i| nodes.map(|(x, w)| (start + h * (i as f64 + 0.5 + 0.5 * x), w)))
            .map(|(x, w)| 0.5 * h * w * f(x))
            .sum()
    }

    #[test]
    fn integral_agrees_with_quadrature() {
        for (start, end) in
            [(0.0, 0.5), (0.3, 2.9), (0.0, PI), (2.0, PI), (1.5, 1.6), (0.0, 0.0017)]
        {
            for (a, b) in [(1.0, 1.0), (0.0, 3.0), (2.0, 0.0), (5.0, 1.0)] {
                let band = Band::new(start, end, a, b);
                let lerp = |t: f64| (a * (end - t) + b * (t - start)) / (end - start);
                let expected = quadrature(64, start, end, |t| lerp(t) * libm::sin(t));
                assert!(
                    (band.integral() - expected).abs() < 1e-13 * expected,
                    "{start}..{end} {a} {b}: {} {expected}",
                    band.integral()
                );
            }
        }
    }

    #[test]
    fn a_sliver_at_the_pole_keeps_all_digits() {
        // For d -> 0 at theta = 0: a d^2/6 + b d^2/3, with a relative error of d^2/12.
        for d in [1e-4, 1e-6, 1e-8] {
            for band in [Band::new(0.0, d, 1.0, 2.0), Band::new(PI - d, PI, 2.0, 1.0)] {
                let width = band.width_rad();
                let expected = width * width * (1.0 / 6.0 + 2.0 / 3.0);
                assert!((band.integral() / expected - 1.0).abs() < d * d + 1e-7, "{d}");
            }
            let north = Band::new(0.0, d, 1.0, 2.0);
            let expected = d * d * (5.0 / 6.0) - d * d * d * d * (1.0 / 120.0 + 2.0 / 30.0);
            assert!((north.integral() / expected - 1.0).abs() < 1e-14, "{d}");
        }
    }

    #[test]
    fn quantile_and_fraction_are_inverse() {
        for (start, end) in [(0.0, 0.001_745), (0.0, PI), (3.0, PI), (1.0, 1.2), (0.2, 3.0)] {
            for (a, b) in [(1.0, 1.0), (0.0, 3.0), (2.0, 0.0), (1e-12, 1.0)] {
                let band = Band::new(start, end, a, b);
                for i in 0..=1000 {
                    let fraction = f64::from(i) / 1000.0;
                    let back = band.fraction_below(band.theta_at(fraction));
                    assert!(
                        (back - fraction).abs() < 1e-11,
                        "{start}..{end} {a} {b} {fraction} {back}"
                    );
                }
            }
        }
    }

    #[test]
    fn series_and_closed_forms_of_the_moments_meet() {
        let (below, above) = (Moments::to(0.5_f64.next_down()), Moments::to(0.5));
        assert!((below.sin - above.sin).abs() < 4e-16);
        assert!((below.versine - above.versine).abs() < 4e-16);
        assert!((below.s_cos - above.s_cos).abs() < 4e-16);
        assert!((below.s_sin - above.s_sin).abs() < 4e-16);
    }
}
