//! What is odd in a weather file that can be read: told, and read as it is.

use super::possible::Possible;
use super::{Weather, WeatherHour, WeatherLight, WeatherUnits, WeatherWarning};
use quasilux_text::{Position, Warnings};

/// Less is the noise of instruments, in W/m2 and in lx.
const NOISE_W_M2: f64 = 10.0;
const NOISE_LX: f64 = 1000.0;

/// Warns by the places of the intervals in the file.
pub(super) fn tell(
    weather: &Weather,
    places: &[Position],
    warnings: &mut Warnings<WeatherWarning>,
) {
    tell_of_the_zone(weather, warnings);
    let pairs = weather.hours.windows(2).zip(&places[1.min(places.len())..]);
    let mut turns = 0;
    for (pair, place) in pairs {
        // One turn of the year is where a file begins in the middle of it, to a time before that.
        let is_before_all = pair[1].time() < weather.hours[0].time();
        let is_turn = pair[0].month == 12 && pair[1].month == 1 && is_before_all;
        turns += u32::from(is_turn);
        if pair[1].time() <= pair[0].time() && !(is_turn && turns == 1) {
            let found = format!("{} after {}", said(&pair[1]), said(&pair[0]));
            let expected = "intervals one after the other, each once (read as they are)";
            warnings.push(WeatherWarning::OutOfOrder, *place, found, expected);
        }
    }
    for (hour, place) in weather.hours.iter().zip(places) {
        let Some(light) = hour.light.filter(|light| light.direct + light.diffuse > 0.0) else {
            continue;
        };
        let is_odd =
            |possible: &Possible| !possible.holds(light, weather.units) || possible.is_night();
        let odd = Possible::of_middle(weather, hour).ok().filter(is_odd);
        let odd = odd.and_then(|_| Possible::of_all(weather, hour).ok());
        if let Some(possible) = odd {
            tell_of_light(weather.units, hour, light, &possible, *place, warnings);
        }
    }
}

fn tell_of_the_zone(weather: &Weather, warnings: &mut Warnings<WeatherWarning>) {
    let (zone_h, longitude_deg) = (weather.site.time_zone_h(), weather.site.longitude_deg());
    if weather.site.has_clock_of_another_place() {
        let found =
            format!("a clock {zone_h} h ahead of Greenwich at {longitude_deg} degrees east");
        let expected = format!("about {:.0} h (the sun stands by the clock)", longitude_deg / 15.0);
        warnings.push(WeatherWarning::ZoneOfAnotherPlace, Position::START, found, expected);
    }
}

fn tell_of_light(
    units: WeatherUnits,
    hour: &WeatherHour,
    light: WeatherLight,
    possible: &Possible,
    place: Position,
    warnings: &mut Warnings<WeatherWarning>,
) {
    let altitude_deg = possible.altitude_deg;
    let (unit, noise) = match units {
        WeatherUnits::Illuminance => ("lx", NOISE_LX),
        WeatherUnits::Irradiance | WeatherUnits::HorizontalIrradiance => ("W/m2", NOISE_W_M2),
    };
    let WeatherLight { direct, diffuse } = light;
    let found =
        format!("{direct} {unit} of the sun and {diffuse} {unit} of the sky {}", said(hour));
    if possible.is_night() && direct + diffuse > noise {
        let expected = format!(
            "none with the sun {:.0} degrees below the horizon by the clock and the place of the \
             file (read as it is)",
            -altitude_deg
        );
        warnings.push(WeatherWarning::LightByNight, place, found, expected);
    } else if !possible.holds(light, units) {
        let most = possible.most(units);
        let expected = format!(
            "at most {:.0} and {:.0}, {:.0} {unit} together on a horizontal plane, with the sun at \
             {altitude_deg:.0} degrees (read as it is)",
            most.direct,
            most.diffuse,
            possible.most_global(units)
        );
        warnings.push(WeatherWarning::MoreThanPossible, place, found, expected);
    }
}

/// A date and a time as people write them.
fn said(hour: &WeatherHour) -> String {
    let minutes = (hour.seconds / 60.0).round() as u32;
    format!("at {:02}:{:02} on {}/{}", minutes / 60, minutes % 60, hour.month, hour.day)
}
