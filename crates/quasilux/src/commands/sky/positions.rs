//! Where the sun is on chosen days, hour by hour.

use crate::arguments::Days;
use crate::exit::CliError;
use quasilux_report::number::exact;
use quasilux_sky::{Site, SolarDay, SolarPosition};
use std::fmt::Write;

/// A day of the list.
pub(super) struct ListedDay {
    /// Like 2026-06-21.
    pub(super) date: String,
    pub(super) day: SolarDay,
}

impl ListedDay {
    pub(super) fn list(site: Site, days: &Days) -> Result<Vec<Self>, CliError> {
        let listed = |&[year, month, day]: &[u32; 3]| {
            let date = format!("{year:04}-{month:02}-{day:02}");
            let year = i32::try_from(year).map_err(CliError::new)?;
            let day = site.solar_day(year, month, day).map_err(CliError::new)?;
            Ok(Self { date, day })
        };
        days.0.iter().map(listed).collect()
    }

    /// When the sun is up, and a line an hour.
    pub(super) fn text(&self) -> String {
        let Self { date, day } = self;
        let highest = &day.highest;
        let mut text = format!(
            "\n  {date}: {}; highest at {}, {:.2}°\n  {:<5} {:>10} {:>9}\n",
            up_text(&day.up_s),
            clock(highest.time.seconds()),
            highest.sun.altitude_deg,
            "time",
            "altitude",
            "azimuth"
        );
        for SolarPosition { time, sun } in &day.hours {
            let altitude = format!("{:.2}°", sun.altitude_deg);
            let azimuth = format!("{:.2}°", sun.azimuth_deg);
            let time = clock(time.seconds());
            writeln!(text, "  {time:<5} {altitude:>10} {azimuth:>9}").expect("strings grow");
        }
        text
    }
}

/// From when to when the sun is up.
fn up_text(up_s: &[[f64; 2]]) -> String {
    match up_s {
        [] => "the sun does not rise".to_owned(),
        [[from, to]] if *from <= 0.0 && *to >= 86_400.0 => "the sun does not set".to_owned(),
        _ => {
            let spans = up_s.iter().map(|[from, to]| format!("{} to {}", clock(*from), clock(*to)));
            format!("the sun is up from {}", spans.collect::<Vec<_>>().join(" and from "))
        }
    }
}

/// Hours and minutes, to the nearest minute.
pub(super) fn clock(seconds: f64) -> String {
    let minutes = (seconds / 60.0).round() as u32;
    format!("{:02}:{:02}", minutes / 60, minutes % 60)
}

/// A header with units, then one line an hour.
pub(super) fn csv(days: &[ListedDay]) -> String {
    let mut text = "time,altitude_deg,azimuth_deg\n".to_owned();
    for SolarPosition { time, sun } in days.iter().flat_map(|listed| &listed.day.hours) {
        let [altitude, azimuth] = [sun.altitude_deg, sun.azimuth_deg].map(exact);
        writeln!(text, "{time},{altitude},{azimuth}").expect("strings grow");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_are_described_by_when_the_sun_is_up() {
        assert_eq!(up_text(&[]), "the sun does not rise");
        assert_eq!(up_text(&[[0.0, 86_400.0]]), "the sun does not set");
        assert_eq!(up_text(&[[21_600.0, 64_830.0]]), "the sun is up from 06:00 to 18:01");
        let wrapped = up_text(&[[0.0, 7200.0], [50_400.0, 86_400.0]]);
        assert_eq!(wrapped, "the sun is up from 00:00 to 02:00 and from 14:00 to 24:00");
    }
}
