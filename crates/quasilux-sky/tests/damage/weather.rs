//! Weather files: small undamaged ones, and what must hold of the reader's answer to any bytes.

use super::measured;
use quasilux_sky::{Weather, WeatherSky};
use quasilux_stats::damage::{Outcome, Seeds, check_message};

/// What the documentation of the reader states: bytes for each byte of a file, and besides.
const BYTES_PER_BYTE: usize = 128;
const BYTES_BESIDES: usize = 64 << 10;

/// An EPW and a WEA file, each of a few intervals.
pub(crate) fn samples() -> Seeds {
    let row = |date: &str, dew_point: &str, light: &str| {
        format!(
            "{date},?9?9,12.0,{dew_point},55,101300,0,1415,300,420,{light},46000,70000,11000,\
                 5000,180,2.0,3,3,9999,9999,9,999999999,150,0.1,0,0,0.2,0,0\n"
        )
    };
    let epw = "LOCATION,Somewhere,-,-,made up,0,52.5,13.4,1.0,34.0\nDESIGN CONDITIONS,0\n\
               TYPICAL/EXTREME PERIODS,0\nGROUND TEMPERATURES,0\n\
               HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0\nCOMMENTS 1,x\nCOMMENTS 2,y\n\
               DATA PERIODS,1,1,Data,Sunday, 1/ 1,12/31\n";
    let rows = [
        row("2026,1,1,1,0", "7.0", "0,0"),
        row("2026,6,21,12,60", "99.9", "700,95"),
        row("2026,2,29,16,60", "-3.5", "9999,130"),
    ];
    let wea = "place somewhere\nlatitude 52.5\nlongitude -13.4\ntime_zone -15\n\
               site_elevation 34\nweather_data_file_units 1\n\
               1 1 0.5 0 0\n6 21 11.5 712.5 95\n12 31 23.5 0 0\n";
    let lx = wea.replace("units 1", "units 3").replace("712.5 95", "70000 12000");
    Seeds::new(vec![[epw, &rows.concat()].concat().into_bytes(), wea.into(), lx.into_bytes()])
}

/// The same with the published files; without them where `QUASILUX_CORPUS=none` says so.
pub(crate) fn seeds() -> Seeds {
    let folder = quasilux_corpus::find("daylight");
    let published = folder.into_iter().flat_map(|folder| {
        ["frads-test.wea", "radiance-test.wea"]
            .map(|name| std::fs::read(folder.join(name)).unwrap())
    });
    samples().with_files(published)
}

/// Reads any bytes and checks the answer: no more memory than stated, messages with a position in
/// the file, and skies of numbers.
pub(crate) fn examine(bytes: &[u8]) -> Outcome {
    let (answer, peak_bytes) = measured(|| Weather::parse(bytes));
    let max = BYTES_PER_BYTE * bytes.len() + BYTES_BESIDES;
    assert!(peak_bytes <= max, "{peak_bytes} bytes for a file of {}, over {max}", bytes.len());
    let is_read = answer.is_ok();
    match answer {
        Ok(read) => {
            for warning in &read.warnings {
                check_message(warning.line(), warning.column(), &warning.to_string(), bytes);
            }
            let hours = &read.weather.hours;
            assert!(hours.iter().all(|hour| (0.0..=86_400.0).contains(&hour.seconds)));
            // A sky is an integral, which takes longer than the file.
            let sky = hours.get(hours.len() / 2).map(|hour| read.weather.sky_of(hour));
            if let Some(Ok(Some(sky))) = sky {
                check_sky(&sky);
            }
        }
        Err(error) => check_message(error.line(), error.column(), &error.to_string(), bytes),
    }
    Outcome { is_read, peak_bytes }
}

fn check_sky(sky: &WeatherSky) {
    let WeatherSky { sky, sun, sun_normal_illuminance_lx: lx } = sky;
    assert!(lx.is_finite() && *lx >= 0.0, "{lx} lx");
    assert!((-90.0..=90.0).contains(&sun.altitude_deg), "{sun:?}");
    for direction in [[0.0, 0.0, 1.0], [0.6, 0.0, 0.8], [-0.6, -0.8, 0.0]] {
        let cd_m2 = sky.luminance_cd_m2(direction);
        assert!(cd_m2.is_finite() && cd_m2 >= 0.0, "{cd_m2} at {direction:?}");
    }
}
