//! The luminances of the CIE skies that give 10 000 lx, with the sun at 45 degrees: at the zenith,
//! at the horizon under the sun, and at the horizon opposite to it.

use quasilux_sky::{CieType, Distribution, Sky, SkyError, SkyLevel, SkyPoint};

fn main() -> Result<(), SkyError> {
    let sun = SkyPoint { altitude_deg: 45.0, azimuth_deg: 180.0 };
    println!("type  zenith  south  north  (cd/m2)");
    for number in 1..=16 {
        let cie = CieType::new(number)?;
        let level = SkyLevel::HorizontalIlluminance { lx: 10_000.0 };
        let sky = Sky::new(Distribution::cie(cie, sun), level)?;
        let [zenith, south, north] =
            [[0.0, 0.0, 1.0], [0.0, -1.0, 0.0], [0.0, 1.0, 0.0]].map(|d| sky.luminance_cd_m2(d));
        println!("{number:4}  {zenith:6.0} {south:6.0} {north:6.0}  {}", cie.description());
    }
    Ok(())
}
