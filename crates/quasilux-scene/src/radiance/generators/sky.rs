//! `gensky`: the sun's place, and a sky of the brightness that the program makes up or is told.
//!
//! Declination and equation of time are those of the IES (Kaufman 1984, IES Lighting Handbook,
//! reference volume); zenith luminances those of Nagata and Krochmann as `gensky` has them.

use super::number;
use crate::radiance::document::{Primitive, shown};
use glam::DVec3;
use std::f64::consts::PI;

/// Sky of a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::radiance) enum Clouds {
    Clear,
    Overcast,
    Uniform,
    Intermediate,
}

#[derive(Clone, Debug)]
pub(in crate::radiance) struct Gensky {
    sun: DVec3,
    clouds: Clouds,
    has_sun: bool,
    ground_reflectance: f64,
    turbidity: f64,
    zenith: Option<Level>,
    solar: Option<Level>,
    pub(super) remarks: Vec<&'static str>,
}

/// A brightness in W/m2/sr, or an irradiance of the horizontal in W/m2.
#[derive(Clone, Copy, Debug)]
enum Level {
    Radiance(f64),
    Irradiance(f64),
}

/// Month, day and hour, or the angles of the sun, and the site.
pub(super) struct When {
    pub(super) sun: DVec3,
    /// Arguments behind them.
    pub(super) used: usize,
}

/// Site of programs that are told none, and hours west of Greenwich, in degrees.
struct Site {
    latitude_deg: f64,
    west_deg: f64,
    meridian_deg: f64,
}

/// The highest sun of a clear sky.
const MAX_ALTITUDE_DEG: f64 = 87.0;
/// Of the option for a year.
pub(super) const NO_YEAR: &str = "the year (-y) is left out: the sun is where it is in any year";
/// Zones by their names, in degrees west of Greenwich, as `gensky` knows them.
const ZONES: [(&str, f64); 28] = [
    ("YST", 135.0),
    ("YDT", 120.0),
    ("PST", 120.0),
    ("PDT", 105.0),
    ("MST", 105.0),
    ("MDT", 90.0),
    ("CST", 90.0),
    ("CDT", 75.0),
    ("EST", 75.0),
    ("EDT", 60.0),
    ("AST", 60.0),
    ("ADT", 45.0),
    ("NST", 52.5),
    ("NDT", 37.5),
    ("GMT", 0.0),
    ("BST", -15.0),
    ("CET", -15.0),
    ("CEST", -30.0),
    ("EET", -30.0),
    ("EEST", -45.0),
    ("GST", -60.0),
    ("GDT", -75.0),
    ("IST", -82.5),
    ("JST", -135.0),
    ("NZST", -180.0),
    ("NZDT", -195.0),
    ("MSK", -45.0),
    ("UTC", 0.0),
];

/// Solid angle of the sun's disk of half a degree, in sr.
const SUN_SR: f64 = 5.981_161_3e-5;
/// Its rounded value, by which `gensky` lights the ground.
const SUN_ON_GROUND_SR: f64 = 6e-5;
/// Watts to lumens of the sky, and of the sun, as `gensky` has them.
const SKY_LM_W: f64 = 203.0;
const SUN_LM_W: f64 = 208.0;

impl Gensky {
    pub(super) fn parse(words: &[String]) -> Result<Self, String> {
        let When { sun, used } = when("gensky", words)?;
        let mut sky = Self {
            sun,
            clouds: Clouds::Clear,
            has_sun: true,
            ground_reflectance: 0.2,
            turbidity: 2.45,
            zenith: None,
            solar: None,
            remarks: Vec::new(),
        };
        let mut at = used;
        while let Some(option) = words.get(at) {
            at += 1;
            if sky.take_model(option) {
                continue;
            }
            let value = || number(words, at, &format!("{option} of gensky"));
            match option.as_str() {
                "-g" => sky.ground_reflectance = value()?,
                "-t" => sky.turbidity = value()?,
                "-b" => sky.zenith = Some(Level::Radiance(value()?)),
                "-B" => sky.zenith = Some(Level::Irradiance(value()?)),
                "-r" => sky.solar = Some(Level::Radiance(value()?)),
                "-R" => sky.solar = Some(Level::Irradiance(value()?)),
                // Of the site.
                "-a" | "-o" | "-m" => {}
                "-y" => sky.remarks.push(NO_YEAR),
                _ => return Err(format!("the option {} of gensky is not read", shown(option))),
            }
            at += 1;
        }
        sky.keep_off_the_zenith();
        Ok(sky)
    }

    /// Clear skies are not known with the sun near the zenith: it stays below, as in the program.
    fn keep_off_the_zenith(&mut self) {
        let most = MAX_ALTITUDE_DEG.to_radians();
        let is_clear = matches!(self.clouds, Clouds::Clear | Clouds::Intermediate);
        if is_clear && self.sun.z > libm::sin(most) {
            self.remarks.push("the sun is above 87 degrees, and taken to be there, as gensky does");
            let flat = DVec3::new(self.sun.x, self.sun.y, 0.0);
            let flat = flat.try_normalize().unwrap_or(DVec3::NEG_Y);
            self.sun = flat * libm::cos(most) + DVec3::Z * libm::sin(most);
        }
    }

    fn take_model(&mut self, option: &str) -> bool {
        let (clouds, has_sun) = match option {
            "-s" => (Clouds::Clear, false),
            "+s" => (Clouds::Clear, true),
            "-c" => (Clouds::Overcast, false),
            "-u" => (Clouds::Uniform, false),
            "-i" => (Clouds::Intermediate, false),
            "+i" => (Clouds::Intermediate, true),
            _ => return false,
        };
        (self.clouds, self.has_sun) = (clouds, has_sun);
        true
    }

    /// Of the brightness over the hemisphere to that of the zenith.
    fn norm(&self) -> f64 {
        let altitude = libm::asin(self.sun.z.clamp(-1.0, 1.0));
        let x = (altitude - PI / 4.0) / (PI / 4.0);
        let polynomial = |of: [f64; 5]| of.iter().rev().fold(0.0, |sum, it| sum * x + it);
        let clear = [2.766_521, 0.547_665, -0.369_832, 0.009_237, 0.059_229];
        let intermediate = [3.5556, -2.7152, -1.3081, 1.0660, 0.602_27];
        match self.clouds {
            Clouds::Overcast => 7.0 / 9.0,
            Clouds::Uniform => 1.0,
            Clouds::Clear => polynomial(clear) / self.zenith_factor() / PI,
            Clouds::Intermediate => polynomial(intermediate) / self.zenith_factor() / PI,
        }
    }

    /// Factor of the model's formula at the zenith, by which it is divided.
    fn zenith_factor(&self) -> f64 {
        let altitude = libm::asin(self.sun.z.clamp(-1.0, 1.0));
        let from_zenith = PI / 2.0 - altitude;
        match self.clouds {
            Clouds::Clear => {
                let around = 10.0 * libm::exp(-3.0 * from_zenith);
                0.274 * (0.91 + around + 0.45 * self.sun.z * self.sun.z)
            }
            Clouds::Intermediate => {
                (2.739 + 0.9891 * libm::sin(0.3119 + 2.6 * altitude))
                    * libm::exp(-from_zenith * (0.4441 + 1.48 * altitude))
            }
            Clouds::Overcast | Clouds::Uniform => 1.0,
        }
    }

    fn zenith_radiance(&self) -> f64 {
        match self.zenith {
            Some(Level::Radiance(radiance)) => return radiance,
            Some(Level::Irradiance(irradiance)) => return irradiance / PI / self.norm(),
            None => {}
        }
        let z = self.sun.z;
        let tangent = z / (1.0 - z * z).max(1e-12).sqrt();
        let clear = (1.376 * self.turbidity - 1.81) * tangent + 0.38;
        let overcast = 8.6 * z + 0.123;
        let thousands = match self.clouds {
            Clouds::Clear => clear,
            Clouds::Overcast | Clouds::Uniform => overcast,
            Clouds::Intermediate => 0.5 * (clear + overcast),
        };
        thousands.max(0.0) * 1000.0 / SKY_LM_W
    }

    fn solar_radiance(&self) -> f64 {
        let z = self.sun.z;
        if z <= 0.0 || matches!(self.clouds, Clouds::Overcast | Clouds::Uniform) {
            return 0.0;
        }
        match self.solar {
            Some(Level::Radiance(radiance)) => radiance,
            Some(Level::Irradiance(irradiance)) => irradiance / SUN_SR / z,
            None => {
                let clear = 1.5e9 / SUN_LM_W * (1.147 - 0.147 / z.max(0.16));
                if self.clouds == Clouds::Intermediate { 0.15 * clear } else { clear }
            }
        }
    }

    pub(super) fn primitives(&self) -> Vec<Primitive> {
        let (zenith, solar) = (self.zenith_radiance(), self.solar_radiance());
        let horizontal = zenith * self.norm() + SUN_ON_GROUND_SR / PI * solar * self.sun.z.max(0.0);
        let ground = self.ground_reflectance * horizontal;
        let number = match self.clouds {
            Clouds::Clear => 1.0,
            Clouds::Overcast => 2.0,
            Clouds::Uniform => 3.0,
            Clouds::Intermediate => 4.0,
        };
        let mut reals = vec![number, zenith, ground];
        if matches!(self.clouds, Clouds::Clear | Clouds::Intermediate) {
            reals.push(self.zenith_factor());
            reals.extend(self.sun.to_array());
        }
        let mut all = Vec::new();
        if self.has_sun && solar > 0.0 {
            all.push(primitive("void", "light", "solar", vec![solar; 3]));
            let [x, y, z] = self.sun.to_array();
            all.push(primitive("solar", "source", "sun", vec![x, y, z, 0.5]));
        }
        let strings = vec!["skybr".into(), "skybright.cal".into()];
        all.push(Primitive { strings, ..primitive("void", "brightfunc", "skyfunc", reals) });
        all
    }
}

pub(super) fn primitive(modifier: &str, kind: &str, name: &str, reals: Vec<f64>) -> Primitive {
    let (modifier, kind, name) = (modifier.into(), kind.into(), name.into());
    Primitive { modifier, kind, name, strings: Vec::new(), reals }
}

/// Where the sun is, by `month day hour` and a site or by `-ang altitude azimuth`. Hours with a `+`
/// in front are solar time; behind them may stand a time zone.
pub(super) fn when(of: &str, words: &[String]) -> Result<When, String> {
    if words.first().is_some_and(|word| word == "-ang") {
        let angle = |at| number(words, at, of);
        return Ok(When { sun: direction(angle(1)?, angle(2)?), used: 3 });
    }
    if words.first().is_some_and(|word| word == "-defaults") {
        return Err(format!("{of} -defaults makes no sky; expected month, day and hour"));
    }
    let (month, day) = (number(words, 0, of)?, number(words, 1, of)?);
    let hour = words.get(2).ok_or_else(|| format!("{of} lacks an argument; expected an hour"))?;
    let is_solar = hour.starts_with('+');
    let digits = |c: char| c.is_ascii_digit() || "+-.:".contains(c);
    let end = hour.find(|c| !digits(c)).unwrap_or(hour.len());
    let (hour, zone) = hour.split_at(end);
    let known = ZONES.iter().find(|(name, _)| name.eq_ignore_ascii_case(zone));
    let meridian_deg = known.map_or(120.0, |(_, west_deg)| *west_deg);
    if !zone.is_empty() && (known.is_none() || is_solar) {
        let zone = shown(zone);
        return Err(format!("the time zone {zone} of {of} is not read; give it in degrees as -m"));
    }
    let hour = clock(hour).ok_or_else(|| format!("{of} has the hour {}", shown(hour)))?;
    let date = [month, day];
    if !(1.0..=12.0).contains(&month) || !(1.0..=31.0).contains(&day) {
        return Err(format!("{of} has month {month} and day {day}; expected a date"));
    }
    let site = Site::from_arguments(of, words, meridian_deg)?;
    Ok(When { sun: site.sun(date, hour, is_solar), used: 3 })
}

/// Hours, as a number or as hours and minutes.
fn clock(text: &str) -> Option<f64> {
    let hour = match text.split_once(':') {
        Some((hours, minutes)) => hours.parse::<f64>().ok()? + minutes.parse::<f64>().ok()? / 60.0,
        None => text.parse::<f64>().ok()?,
    };
    (-24.0..=48.0).contains(&hour).then_some(hour)
}

/// Towards an altitude, and an azimuth from south to west.
fn direction(altitude_deg: f64, azimuth_deg: f64) -> DVec3 {
    let (z, across) = libm::sincos(altitude_deg.to_radians());
    let (sin, cos) = libm::sincos(azimuth_deg.to_radians());
    DVec3::new(-sin * across, -cos * across, z)
}

impl Site {
    fn from_arguments(of: &str, words: &[String], meridian_deg: f64) -> Result<Self, String> {
        let option = |name: &str, usual: f64| {
            let at = words.iter().rposition(|word| word == name);
            at.map_or(Ok(usual), |at| number(words, at + 1, of))
        };
        Ok(Self {
            latitude_deg: option("-a", 0.66_f64.to_degrees())?,
            west_deg: option("-o", 2.13_f64.to_degrees())?,
            meridian_deg: option("-m", meridian_deg)?,
        })
    }

    fn sun(&self, [month, day]: [f64; 2], hour: f64, is_solar: bool) -> DVec3 {
        const BEFORE: [f64; 12] =
            [0.0, 31.0, 59.0, 90.0, 120.0, 151.0, 181.0, 212.0, 243.0, 273.0, 304.0, 334.0];
        let date = BEFORE[month as usize - 1] + day;
        let turn = |days: f64, from: f64| libm::sin(2.0 * PI / days * (date - from));
        let declination = 0.4093 * turn(365.0, 81.0);
        let equation_h = 0.170 * turn(186.5, 80.0) - 0.129 * turn(355.0, 8.0);
        let solar = if is_solar {
            hour
        } else {
            hour + equation_h + (self.meridian_deg - self.west_deg) / 15.0
        };
        let (sin_l, cos_l) = libm::sincos(self.latitude_deg.to_radians());
        let (sin_d, cos_d) = libm::sincos(declination);
        let (sin_t, cos_t) = libm::sincos(solar * PI / 12.0);
        let z = sin_l * sin_d - cos_l * cos_d * cos_t;
        // From midnight: the sun goes from the east over the south to the west.
        DVec3::new(cos_d * sin_t, cos_l * sin_d + sin_l * cos_d * cos_t, z)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sky(text: &str) -> Vec<f64> {
        let words: Vec<String> = text.split(' ').map(str::to_owned).collect();
        let primitives = Gensky::parse(&words).unwrap().primitives();
        let mut all = primitives.last().unwrap().reals.clone();
        if primitives.len() > 1 {
            all.push(primitives[0].reals[0]);
        }
        all
    }

    /// The program takes the sun down to 87 degrees: its zenith is that of there.
    #[test]
    fn the_sun_stays_off_the_zenith() {
        // Of `gensky -ang 90 0 +s` of Radiance 6.1.
        assert!((sky("-ang 90 0 +s")[1] / 148.6 - 1.0).abs() < 1e-3);
        let lower = sky("-ang 87 20 +s");
        for (a, b) in sky("-ang 88 20 +s").iter().zip(lower) {
            assert!((a - b).abs() <= 1e-9 * b.abs().max(1.0), "{a} is not {b}");
        }
        assert!(sky("-ang 88 20 -c")[1] > sky("-ang 87 20 -c")[1]);
    }

    #[test]
    fn hours_have_signs_and_zones() {
        assert_eq!(sky("6 21 14CEST -a 50 -o -10"), sky("6 21 14 -a 50 -o -10 -m -30"));
        assert_eq!(sky("6 21 12EST"), sky("6 21 12 -m 75"));
        // Solar noon: in the south, whatever the site.
        assert!(sky("6 21 +12 -a 50 -o -10")[4].abs() < 1e-12);
        assert!(sky("6 21 12 -a 50 -o -10 -m -15")[4].abs() > 1e-3);
        let words = |text: &str| text.split(' ').map(str::to_owned).collect::<Vec<String>>();
        assert!(Gensky::parse(&words("6 21 12XYZ")).unwrap_err().contains("time zone XYZ"));
        assert_eq!(Gensky::parse(&words("6 21 12 -y 2020")).unwrap().remarks, [NO_YEAR]);
    }

    /// Against figures that `gensky` of Radiance 6.1 prints, with their digits.
    #[test]
    fn skies_are_those_of_the_program() {
        let cases: [(&str, &[f64]); 8] = [
            ("6 21 12 +s", &[1.0, 31.59, 30.18, 1.647, 0.038267, -0.247596, 0.968107, 7.177e6]),
            ("-ang 45 30 -c", &[2.0, 30.56, 4.754]),
            ("-ang 40 10 -u -B 100", &[3.0, 31.83, 6.366]),
            ("-ang 30 20 +i", &[4.0, 14.05, 5.451, 1.039, -0.296198, -0.813798, 0.5, 9.227e5]),
            ("-ang 45 30 +s -R 500 -B 100", &[1.0, 20.63, 38.30, 0.5707]),
            ("-ang 45 30 +s -r 1e6 -b 10", &[1.0, 10.0, 5.787, 0.5707]),
            ("1 5 9.5 -a 50 -o -10 -m -15 -c", &[2.0, 6.228, 0.9687]),
            ("12 1 10 -t 5 +s", &[1.0, 13.03, 14.50, 0.3567, 0.452433, -0.793025, 0.407942]),
        ];
        for (arguments, expected) in cases {
            let found = sky(arguments);
            for (found, expected) in found.iter().zip(expected) {
                let error = (found - expected).abs() / expected.abs().max(0.1);
                assert!(error < 1e-3, "{arguments}: {found} is not {expected}");
            }
        }
    }
}
