//! Functions with known integrals, to measure integration errors on.
//!
//! Three degrees of roughness in 2, 8 and 32 dimensions each. A. Genz, "Testing multidimensional
//! integration routines" (1984): the Gaussian, the oscillatory and the continuous function. I. M.
//! Sobol', "Sensitivity estimates for nonlinear mathematical models" (1993): the g-function. P.
//! Christensen, A. Kensler, C. Kilpatrick, "Progressive multi-jittered sample sequences" (EGSR
//! 2018): the quarter disk. The volumes of cut cubes are P. Hall's, "The distribution of means for
//! samples of size n drawn from a population in which the variate takes values between 0 and 1"
//! (1927).
//!
//! Kinks and jumps stay clear of fractions with small denominators: on the borders of the cells
//! that a net fills evenly they would go unnoticed.

use core::f64::consts::{FRAC_PI_4, TAU};

/// How rough a function is, which decides how fast errors can fall.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Roughness {
    /// All derivatives exist.
    Smooth,
    /// Continuous, with a jump of the first derivative, like illuminance at the edge of a penumbra.
    Kink,
    /// With a jump, like the edge of a shadow.
    Jump,
}

impl Roughness {
    /// The word for it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Smooth => "smooth",
            Self::Kink => "kink",
            Self::Jump => "jump",
        }
    }
}

/// A function on the unit cube.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Integrand {
    /// Two dimensions, smooth: exp(-sum a^2 (u_j - w_j)^2) (Genz).
    Gaussian,
    /// Eight dimensions, smooth: cos(2 pi w + sum u_j) (Genz).
    Oscillatory,
    /// 32 dimensions, smooth: prod c_j exp(c_j u_j) / (exp(c_j) - 1), c_j = 1/j.
    Exponential,
    /// Two dimensions, kinks along the axes: exp(-sum a |u_j - w_j|) (Genz, "continuous").
    Ridge,
    /// Eight dimensions, a kink across the diagonal: max(0, sum u_j - 3).
    Hinge,
    /// 32 dimensions, kinks along the axes: prod (|4 v_j - 2| + j) / (1 + j) (Sobol').
    ///
    /// Deviation: v_j is u_j plus the golden ratio modulo 1; the original has its kinks at 1/2.
    GFunction,
    /// Two dimensions, a curved edge: 1 in the quarter of the unit disk.
    QuarterDisk,
    /// Eight dimensions, an edge across the diagonal: 1 where sum u_j < 3.
    HalfSpace,
    /// 32 dimensions, edges along the axes: `prod (1 + ((u_j < w) - w) / j)`.
    Steps,
}

/// The fractional part of the golden ratio, of all numbers the farthest from fractions.
const GOLDEN: f64 = 0.618_033_988_749_894_9;
/// Genz's w_j: where the first two functions have their peaks.
const PEAK: [f64; 2] = [0.37, 0.58];
const GAUSSIAN_A: f64 = 4.0;
const RIDGE_A: f64 = 3.0;
const OSCILLATORY_W: f64 = 0.3;
/// prod (exp(c_j) - 1) / c_j over 32 dimensions.
const EXPONENTIAL_MEAN: f64 = 8.134_662_635_189_577;
/// Where the diagonal of the eight-dimensional cube is cut.
const CUT: f64 = 3.0;

impl Integrand {
    /// All of them: smooth, kink, jump, and each of these in 2, 8 and 32 dimensions.
    pub const ALL: [Self; 9] = [
        Self::Gaussian,
        Self::Oscillatory,
        Self::Exponential,
        Self::Ridge,
        Self::Hinge,
        Self::GFunction,
        Self::QuarterDisk,
        Self::HalfSpace,
        Self::Steps,
    ];
    /// The largest number of dimensions among them.
    pub const MAX_DIMENSIONS: usize = 32;

    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Gaussian => "gaussian",
            Self::Oscillatory => "oscillatory",
            Self::Exponential => "exponential",
            Self::Ridge => "ridge",
            Self::Hinge => "hinge",
            Self::GFunction => "g-function",
            Self::QuarterDisk => "quarter-disk",
            Self::HalfSpace => "half-space",
            Self::Steps => "steps",
        }
    }

    /// How rough it is.
    #[must_use]
    pub const fn roughness(self) -> Roughness {
        match self {
            Self::Gaussian | Self::Oscillatory | Self::Exponential => Roughness::Smooth,
            Self::Ridge | Self::Hinge | Self::GFunction => Roughness::Kink,
            Self::QuarterDisk | Self::HalfSpace | Self::Steps => Roughness::Jump,
        }
    }

    /// The number of its dimensions.
    #[must_use]
    pub const fn dimensions(self) -> usize {
        match self {
            Self::Gaussian | Self::Ridge | Self::QuarterDisk => 2,
            Self::Oscillatory | Self::Hinge | Self::HalfSpace => 8,
            Self::Exponential | Self::GFunction | Self::Steps => Self::MAX_DIMENSIONS,
        }
    }

    /// Its value; coordinates past its dimensions are ignored.
    ///
    /// # Panics
    /// When there are fewer coordinates than dimensions.
    #[must_use]
    pub fn value(self, u: &[f64]) -> f64 {
        let u = &u[..self.dimensions()];
        let sum = || u.iter().sum::<f64>();
        let from_peak = || u.iter().zip(PEAK).map(|(u, w)| u - w);
        let numbered = || (1_u32..).map(f64::from).zip(u.iter().copied());
        match self {
            Self::Gaussian => {
                libm::exp(-GAUSSIAN_A * GAUSSIAN_A * from_peak().map(|z| z * z).sum::<f64>())
            }
            Self::Oscillatory => libm::cos(TAU * OSCILLATORY_W + sum()),
            Self::Exponential => {
                let exponent: f64 = numbered().map(|(j, u)| u / j).sum();
                libm::exp(exponent) / EXPONENTIAL_MEAN
            }
            Self::Ridge => libm::exp(-RIDGE_A * from_peak().map(f64::abs).sum::<f64>()),
            Self::Hinge => (sum() - CUT).max(0.0),
            Self::GFunction => numbered()
                .map(|(j, u)| {
                    let v = if u + GOLDEN < 1.0 { u + GOLDEN } else { u + GOLDEN - 1.0 };
                    ((4.0 * v - 2.0).abs() + j) / (1.0 + j)
                })
                .product(),
            Self::QuarterDisk => indicator(u[0] * u[0] + u[1] * u[1] < 1.0),
            Self::HalfSpace => indicator(sum() < CUT),
            Self::Steps => {
                numbered().map(|(j, u)| 1.0 + (indicator(u < GOLDEN) - GOLDEN) / j).product()
            }
        }
    }

    /// Its integral over the unit cube.
    #[must_use]
    pub fn integral(self) -> f64 {
        match self {
            Self::Gaussian => PEAK.into_iter().map(gaussian_integral).product(),
            // The real part of exp(2 pi i w) prod (exp(i) - 1) / i.
            Self::Oscillatory => {
                let factor = 2.0 * libm::sin(0.5);
                libm::cos(TAU * OSCILLATORY_W + 4.0) * (0..8).map(|_| factor).product::<f64>()
            }
            Self::Ridge => PEAK.into_iter().map(ridge_integral).product(),
            // The mean of sum - 3, plus that of max(0, 3 - sum): (3^9 - 8 2^9 + 28) / 9!.
            Self::Hinge => 1.0 + 15_615.0 / 362_880.0,
            Self::QuarterDisk => FRAC_PI_4,
            // (3^8 - 8 2^8 + 28) / 8!.
            Self::HalfSpace => 4541.0 / 40_320.0,
            Self::Exponential | Self::GFunction | Self::Steps => 1.0,
        }
    }
}

fn indicator(inside: bool) -> f64 {
    f64::from(u8::from(inside))
}

fn gaussian_integral(w: f64) -> f64 {
    let ends = libm::erf(GAUSSIAN_A * (1.0 - w)) + libm::erf(GAUSSIAN_A * w);
    ends / (core::f64::consts::FRAC_2_SQRT_PI * GAUSSIAN_A)
}

fn ridge_integral(w: f64) -> f64 {
    let tail = |length: f64| -libm::expm1(-RIDGE_A * length);
    (tail(w) + tail(1.0 - w)) / RIDGE_A
}
