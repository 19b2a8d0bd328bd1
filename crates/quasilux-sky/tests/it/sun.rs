//! The position of the sun.

use quasilux_sky::{
    LocalTime, SUN_RADIUS_DEG, Site, solid_angle_of_the_sun_sr, sun_luminance_cd_m2,
};

fn sun(site: [f64; 3], time: &str) -> [f64; 2] {
    let [latitude, longitude, zone] = site;
    let time: LocalTime = time.parse().unwrap();
    let sun = Site::new(latitude, longitude, zone).unwrap().sun_at(&time).unwrap();
    [sun.altitude_deg, sun.azimuth_deg]
}

/// The example of Reda and Andreas (NREL/TP-560-34302, table A5.1), without its refraction.
#[test]
fn positions_are_those_of_the_published_example() {
    let [altitude, azimuth] = sun([39.742_476, -105.178_6, -7.0], "2003-10-17T12:30:30");
    assert!((altitude - 39.872_046).abs() < 1e-3, "{altitude}");
    assert!((azimuth - 194.340_24).abs() < 1e-3, "{azimuth}");
}

/// A clock of another time zone shows another time at the same time.
#[test]
fn time_zones_shift_the_clock_alone() {
    for zone in -12..=14 {
        for (hour, day) in [(9, 20), (15, 20)] {
            let there: i32 = hour + zone;
            let (day, there) = (day + there.div_euclid(24), there.rem_euclid(24));
            let here = sun([48.0, 11.0, f64::from(zone)], &format!("2026-05-{day}T{there:02}:20"));
            let utc = sun([48.0, 11.0, 0.0], &format!("2026-05-20T{hour:02}:20"));
            assert!(here.iter().zip(utc).all(|(a, b)| (a - b).abs() < 1e-6), "{zone}: {here:?}");
        }
    }
}

/// Culminations at solstices and equinoxes; north and south of the equator, at the pole, and where
/// the sun shines at midnight.
#[test]
fn the_sun_is_where_geometry_has_it() {
    let highest = |site: [f64; 3], day: &str| {
        let times = (0..288).map(|n| format!("{day}T{:02}:{:02}", n / 12, 5 * (n % 12)));
        let all = times.map(|time| sun(site, &time));
        all.max_by(|a, b| a[0].total_cmp(&b[0])).unwrap()
    };
    let obliquity = 23.436;
    for (site, day, altitude, azimuth) in [
        ([50.0, 0.0, 0.0], "2026-06-21", 40.0 + obliquity, 180.0),
        ([50.0, 0.0, 0.0], "2026-12-21", 40.0 - obliquity, 180.0),
        ([-35.0, 150.0, 10.0], "2026-12-21", 55.0 + obliquity, 0.0),
        ([-35.0, 150.0, 10.0], "2026-06-21", 55.0 - obliquity, 0.0),
    ] {
        let [found, at] = highest(site, day);
        assert!((found - altitude).abs() < 0.02, "{site:?}: {found}");
        let off = (at - azimuth + 180.0).rem_euclid(360.0) - 180.0;
        assert!(off.abs() < 3.0, "{site:?}: {at}");
    }
    let [midnight, _] = sun([78.2, 15.6, 2.0], "2026-06-21T01:00");
    assert!((midnight - (obliquity - 11.8)).abs() < 0.2, "{midnight}");
    let pole = ["03:00", "09:00", "15:00", "21:00"].map(|time| {
        let [altitude, _] = sun([90.0, 0.0, 0.0], &format!("2026-06-21T{time}"));
        altitude
    });
    assert!(pole.iter().all(|altitude| (altitude - obliquity).abs() < 0.01), "{pole:?}");
}

#[test]
fn sites_beyond_the_earth_are_refused() {
    for [latitude, longitude, zone] in
        [[91.0, 0.0, 0.0], [0.0, 181.0, 0.0], [0.0, 0.0, 16.0], [f64::NAN, 0.0, 0.0]]
    {
        assert!(Site::new(latitude, longitude, zone).is_err());
    }
}

/// A disk seen face on: pi r^2 but for the curvature of the sky.
#[test]
fn the_disk_gives_its_illuminance() {
    let radius = SUN_RADIUS_DEG.to_radians();
    let flat = std::f64::consts::PI * radius * radius;
    assert!((solid_angle_of_the_sun_sr() / flat - 1.0).abs() < 1e-5);
    assert!((sun_luminance_cd_m2(100_000.0) * flat / 100_000.0 - 1.0).abs() < 1e-5);
}
