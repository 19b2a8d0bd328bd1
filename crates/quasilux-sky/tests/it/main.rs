//! The skies and the sun against closed forms, quadrature of another kind, and other programs.

mod cie;
mod levels;
mod made;
mod odd_files;
mod panorama;
mod perez;
mod sun;
mod tabulated;
mod weather;

use quasilux_sky::SkyPoint;

/// Suns at random, by a generator of no quality but reproducible.
fn suns(count: usize) -> impl Iterator<Item = SkyPoint> {
    let mut state = 12_345_u64;
    let mut next = move || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let sun = move |_| SkyPoint { altitude_deg: 90.0 * next(), azimuth_deg: 360.0 * next() };
    (0..count).map(sun)
}

/// The integral of f cos(zenith angle) over the sky: midpoints of squares in sin^2 of the zenith
/// angle and in the azimuth.
fn projected(f: impl Fn([f64; 3]) -> f64) -> f64 {
    const N: usize = 700;
    let mut sum = 0.0;
    for i in 0..N {
        let t = (i as f64 + 0.5) / N as f64;
        let (sine, cosine) = (libm::sqrt(t), libm::sqrt(1.0 - t));
        for j in 0..N {
            let azimuth = std::f64::consts::TAU * (j as f64 + 0.5) / N as f64;
            sum += f([sine * libm::sin(azimuth), sine * libm::cos(azimuth), cosine]);
        }
    }
    sum * std::f64::consts::PI / (N * N) as f64
}
