//! Right files at random of which nothing is told, and the same with one oddity each: their light
//! comes out right, or what is odd is told.

use crate::made::{DIFFUSE, DIRECT, Exposure, File, MINUTE, Made, Span, Station, told};
use quasilux_sky::{ParsedWeather, Weather, WeatherWarning};
use quasilux_stats::SplitMix64;

/// This many from a first one on, or ten times as many.
fn seeds(first: u64, count: u64) -> std::ops::Range<u64> {
    let factor = if quasilux_stats::deep() { 10 } else { 1 };
    first..first + factor * count
}

/// An hour a line, of a year.
fn year(dice: &mut SplitMix64, most_deg: f64) -> Made {
    let place = Station::random(dice, most_deg);
    Made::random(dice, place, Span::YEAR)
}

/// Some weeks of any season, with this many intervals an hour.
fn season(dice: &mut SplitMix64, an_hour: u32, days: u32) -> Made {
    let place = Station::random(dice, 60.0);
    let first = dice.below(365 - days as usize) as u32;
    let span = Span { first, days, an_hour, ..Span::YEAR };
    Made::random(dice, place, span)
}

fn expect(name: &str, parsed: &ParsedWeather, exposure: Exposure, kinds: &[WeatherWarning]) {
    assert_eq!(told(parsed), kinds, "{name}: {:?}", parsed.warnings);
    let found = Exposure::read(&parsed.weather);
    assert!(found.is(&exposure), "{name}: {found:?} for {exposure:?}");
}

/// EPW and WEA, all line ends, with and without leap day and nights, in all units.
#[test]
fn right_files_are_quiet() {
    for seed in seeds(0, 12) {
        let mut dice = SplitMix64::new(seed);
        let place = Station::random(&mut dice, 82.0);
        let has_leap_day = seed % 3 == 0;
        let days = if has_leap_day { 366 } else { 365 };
        let made = Made::random(&mut dice, place, Span { has_leap_day, days, ..Span::YEAR });
        let mut epw = made.epw(1.0);
        epw.line_end = dice.pick(&["\n", "\r\n", "\r"]);
        // The minute of whole hours means nothing.
        let minute = dice.pick(&["0", "60", "30"]);
        epw.rows.iter_mut().for_each(|row| row[MINUTE] = minute.to_owned());
        let name = format!("{seed} {place:?}");
        let read = epw.read();
        expect(&name, &read, made.exposure(), &[]);
        assert!(read.weather.is_of_a_year(), "{name}");
        for units in [1, 3] {
            let mut wea = made.wea(units);
            wea.line_end = epw.line_end;
            let lm_w = if units == 3 { 100.0 } else { 1.0 };
            let Exposure { direct, diffuse, unknown_h } = made.exposure();
            let exposure = Exposure { direct: lm_w * direct, diffuse: lm_w * diffuse, unknown_h };
            expect(&name, &wea.read(), exposure, &[]);
        }
    }
}

/// As Ladybug and Honeybee write them.
#[test]
fn hours_of_sun_alone_make_a_year() {
    for seed in seeds(100, 8) {
        let mut dice = SplitMix64::new(seed);
        let mut made = year(&mut dice, 75.0);
        made.slots.retain(|slot| slot.altitude_deg > 0.0);
        let read = made.wea(1).read();
        expect(&format!("{seed} {:?}", made.place), &read, made.exposure(), &[]);
        assert!(read.weather.is_of_a_year(), "{seed}: {}", read.weather.hours.len());
    }
}

/// How the minutes of shorter intervals are written.
#[derive(Clone, Copy, Debug)]
enum Minutes {
    /// 15, 30, 45, 60.
    End,
    /// 15, 30, 45, 0.
    EndOfHourIsZero,
    /// 0, 15, 30, 45.
    Begin,
    /// 60 everywhere.
    Meaningless,
}

fn with_minutes(mut file: File, minutes: Minutes, an_hour: u32) -> File {
    let step = 60 / an_hour;
    for row in &mut file.rows {
        let end: u32 = row[MINUTE].parse().expect("a minute");
        let minute = match minutes {
            Minutes::End => end,
            Minutes::EndOfHourIsZero => end % 60,
            Minutes::Begin => end - step,
            Minutes::Meaningless => 60,
        };
        row[MINUTE] = minute.to_string();
    }
    file
}

/// Whatever the header and the minutes say, as powers or energies.
#[test]
fn shorter_intervals_keep_light_and_times() {
    use Minutes::{Begin, End, EndOfHourIsZero, Meaningless};
    use WeatherWarning::{OtherThanAYear, OtherThanDeclared, PowerOrEnergy};
    for seed in seeds(200, 9) {
        let mut dice = SplitMix64::new(seed);
        let an_hour = dice.pick(&[2, 3, 4, 6]);
        let made = season(&mut dice, an_hour, 35);
        let unit = dice.pick(&[1.0, 1.0 / f64::from(an_hour)]);
        let declared = dice.pick(&[1, an_hour, 12]);
        for minutes in [End, EndOfHourIsZero, Begin, Meaningless] {
            let file = with_minutes(made.epw(unit), minutes, an_hour);
            let says = format!("PERIODS,1,{an_hour},");
            let file = file.say(&says, &format!("PERIODS,1,{declared},"));
            let read = file.read();
            let name = format!("{seed}: {an_hour} for {declared}, {unit}, {minutes:?}");
            let mut kinds = vec![OtherThanDeclared, PowerOrEnergy, OtherThanAYear];
            if declared == an_hour {
                kinds.remove(0);
            }
            expect(&name, &read, made.exposure(), &kinds);
            for (hour, slot) in read.weather.hours.iter().zip(&made.slots) {
                assert!((hour.seconds / 3600.0 - slot.middle_h).abs() < 1e-6, "{name}");
            }
        }
    }
}

/// Hours where the header has shorter intervals.
#[test]
fn declared_intervals_that_are_not_there_are_told() {
    for seed in seeds(300, 10) {
        let mut dice = SplitMix64::new(seed);
        let made = season(&mut dice, 1, 60);
        let declared = dice.pick(&[2, 4, 6, 60]);
        let minute = dice.pick(&["0", "60", "30"]);
        let mut file = made.epw(1.0).say("PERIODS,1,1,", &format!("PERIODS,1,{declared},"));
        file.rows.iter_mut().for_each(|row| row[MINUTE] = minute.to_owned());
        let kinds = [WeatherWarning::OtherThanDeclared, WeatherWarning::OtherThanAYear];
        expect(&format!("{seed}: {declared}"), &file.read(), made.exposure(), &kinds);
    }
}

/// Nothing is known of these hours, and all of the others.
#[test]
fn missing_marks_are_no_light() {
    const MARKS: [&str; 9] = ["9999", "9999.0", "99999", "60000", "-9999", "-999", "-99", "", "  "];
    for seed in seeds(400, 9) {
        let mut dice = SplitMix64::new(seed);
        let mut made = season(&mut dice, 1, 60);
        let mut file = made.epw(1.0);
        let mark = MARKS[seed as usize % MARKS.len()];
        let mut unknown_h = 0.0;
        for number in 0..made.slots.len() {
            if dice.below(7) > 0 {
                continue;
            }
            unknown_h += 1.0;
            let fields = dice.pick(&[[DIRECT, DIRECT], [DIFFUSE, DIFFUSE], [DIRECT, DIFFUSE]]);
            fields.iter().for_each(|&field| file.rows[number][field] = mark.to_owned());
            made.slots[number].direct = 0.0;
            made.slots[number].diffuse = 0.0;
        }
        let exposure = Exposure { unknown_h, ..made.exposure() };
        let kinds = [WeatherWarning::MissingLight, WeatherWarning::OtherThanAYear];
        expect(&format!("{seed} {mark:?}"), &file.read(), exposure, &kinds);
    }
}

#[test]
fn lines_out_of_order_or_twice_are_told() {
    use WeatherWarning::{OtherThanAYear, OutOfOrder};
    for seed in seeds(500, 4) {
        let mut dice = SplitMix64::new(seed);
        let made = year(&mut dice, 70.0);
        let mut swapped = made.epw(1.0);
        let count = swapped.rows.len();
        let [a, b] = [dice.below(count / 2), count / 2 + dice.below(count / 2)];
        swapped.rows.swap(a, b);
        expect(&format!("{seed}: {a} {b}"), &swapped.read(), made.exposure(), &[OutOfOrder]);
        // Months in another order.
        let mut turned = made.epw(1.0);
        turned.rows[..1416].rotate_left(744);
        expect(&format!("{seed}: months"), &turned.read(), made.exposure(), &[OutOfOrder]);
        // A year that begins in the middle of one is right.
        let mut fiscal = made.epw(1.0);
        fiscal.rows.rotate_left(24 * (1 + dice.below(363)));
        expect(&format!("{seed}: fiscal"), &fiscal.read(), made.exposure(), &[]);
        let mut twice = made.epw(1.0);
        let row = twice.rows[a].clone();
        twice.rows.insert(a, row);
        assert_eq!(told(&twice.read()), [OutOfOrder, OtherThanAYear], "{seed}: {a} twice");
        // One that is another day's.
        let mut instead = made.epw(1.0);
        instead.rows[b] = instead.rows[a].clone();
        assert_eq!(told(&instead.read()), [OutOfOrder], "{seed}: {a} for {b}");
    }
}

#[test]
fn light_beyond_what_can_be_is_told() {
    use WeatherWarning::{LightByNight, MoreThanPossible};
    for seed in seeds(600, 7) {
        let mut dice = SplitMix64::new(seed);
        let made = year(&mut dice, 65.0);
        let by_day = made.above(10.0);
        let night: Vec<usize> =
            (0..made.slots.len()).filter(|&n| made.slots[n].altitude_deg < -16.0).collect();
        let spoilt = |number: usize, field: usize, value: f64| {
            let mut file = made.epw(1.0);
            file.rows[number][field] = format!("{value:.0}");
            told(&file.read())
        };
        let noon = by_day[dice.below(by_day.len())];
        let sine = libm::sin((made.slots[noon].altitude_deg + 10.0).to_radians()).min(1.0);
        // Above the air the sun has 1317 to 1407 W/m2.
        let direct = dice.within(1420.0, 2000.0);
        assert_eq!(spoilt(noon, DIRECT, direct), [MoreThanPossible], "{seed} {direct}");
        let diffuse = 0.95 * 1410.0 * libm::pow(sine, 1.2) + 60.0;
        let diffuse = dice.within(diffuse, 2000.0);
        assert_eq!(spoilt(noon, DIFFUSE, diffuse), [MoreThanPossible], "{seed} {diffuse}");
        if let Some(&midnight) = night.get(dice.below(night.len().max(1))) {
            let field = dice.pick(&[DIRECT, DIFFUSE]);
            let light = dice.within(15.0, 900.0);
            assert_eq!(spoilt(midnight, field, light), [LightByNight], "{seed} {light}");
        }
    }
}

/// The clock or the longitude of another continent.
#[test]
fn clocks_of_other_places_are_told() {
    for seed in seeds(700, 15) {
        let mut dice = SplitMix64::new(seed);
        let mut made = season(&mut dice, 1, 40);
        made.place.zone_h += dice.pick(&[-1.0, 1.0]) * dice.within(5.0, 11.0).round();
        made.place.zone_h = (made.place.zone_h + 36.0).rem_euclid(24.0) - 12.0;
        let read = match seed % 2 {
            0 => made.epw(1.0).read(),
            _ => made.wea(1).read(),
        };
        let kinds = told(&read);
        let is_told = kinds.contains(&WeatherWarning::ZoneOfAnotherPlace);
        assert!(is_told, "{seed} {:?}: {kinds:?}", made.place);
    }
}

/// Times of Greenwich under the clock of the place. An hour is not asked for: light of published
/// years comes up to 0.7 h before or after the sun (Mannheim; seven others half an hour at most),
/// by its weather and by what its hours mean. Of 49 made years 37 were told that are an hour off,
/// and all but those beyond 50 degrees of latitude.
#[test]
fn light_off_the_clock_is_told() {
    let mut tried = 0;
    for seed in seeds(800, 20) {
        let mut dice = SplitMix64::new(seed);
        let place = Station::random(&mut dice, 70.0);
        if place.zone_h.abs() < 2.0 {
            continue;
        }
        tried += 1;
        let made = Made::random(&mut dice, place, Span::YEAR);
        let mut file = made.epw(1.0);
        let light: Vec<[String; 2]> =
            file.rows.iter().map(|row| [row[DIRECT].clone(), row[DIFFUSE].clone()]).collect();
        let count = light.len();
        for (number, row) in file.rows.iter_mut().enumerate() {
            let from = (number as i64 + place.zone_h as i64).rem_euclid(count as i64) as usize;
            row[DIRECT].clone_from(&light[from][0]);
            row[DIFFUSE].clone_from(&light[from][1]);
        }
        let kinds = told(&file.read());
        assert!(kinds.contains(&WeatherWarning::LightByNight), "{seed} {place:?}: {kinds:?}");
    }
    assert!(tried > 8, "{tried}");
}

#[test]
fn a_week_is_no_year() {
    for seed in seeds(900, 10) {
        let mut dice = SplitMix64::new(seed);
        let days = 1 + dice.below(30) as u32;
        let made = season(&mut dice, 1, days);
        for read in [made.epw(1.0).read(), made.wea(1).read()] {
            let kinds = [WeatherWarning::OtherThanAYear];
            expect(&format!("{seed}: {days} days"), &read, made.exposure(), &kinds);
            assert!(!read.weather.is_of_a_year());
        }
    }
}

/// Decimal commas, hours from 0, separators of spreadsheets: refused with the line.
#[test]
fn what_is_written_otherwise_is_refused() {
    for seed in seeds(1000, 10) {
        let mut dice = SplitMix64::new(seed);
        let made = season(&mut dice, 1, 5);
        let refused =
            |name: &str, file: &File, line: usize| match Weather::parse(file.text().as_bytes()) {
                Ok(read) => panic!("{seed} {name}: {:?}", read.warnings),
                Err(error) => assert_eq!(error.line(), line, "{seed} {name}: {error}"),
            };
        let with_commas = |mut file: File| {
            let fields = file.rows.iter_mut().flatten();
            fields.for_each(|field| *field = field.replace('.', ","));
            file
        };
        refused("commas in EPW", &with_commas(made.epw(1.0)), 9);
        refused("commas in WEA", &with_commas(made.wea(1)), 7);
        let mut one = made.epw(1.0);
        let number = dice.below(one.rows.len());
        let field = dice.pick(&[6, 7, DIRECT, DIFFUSE, 21, 29]);
        one.rows[number][field] = "12,5".to_owned();
        refused("one comma in EPW", &one, 9 + number);
        let mut semicolons = made.epw(1.0);
        semicolons.separator = ';';
        refused("semicolons", &semicolons, 9);
        let mut from_zero = made.epw(1.0);
        from_zero.rows.iter_mut().for_each(|row| {
            row[3] = (row[3].parse::<u32>().expect("an hour") - 1).to_string();
        });
        refused("hours from 0", &from_zero, 9);
    }
}

/// Hours of two or three decimals, with and without nights, and with lines that are not there.
#[test]
fn parts_of_hours_in_wea_keep_their_light() {
    for seed in seeds(1100, 12) {
        let mut dice = SplitMix64::new(seed);
        let an_hour = dice.pick(&[2, 3, 4, 6]);
        let mut made = season(&mut dice, an_hour, 30);
        if seed % 2 == 0 {
            made.slots.retain(|slot| slot.altitude_deg > 0.0);
        }
        if seed % 4 > 1 {
            made.slots.retain(|_| dice.below(5) > 0);
        }
        let mut file = made.wea(1);
        let is_short = dice.below(2) == 0;
        for (row, slot) in file.rows.iter_mut().zip(&made.slots).filter(|_| is_short) {
            row[2] = format!("{:.2}", slot.middle_h);
        }
        let kinds = [WeatherWarning::OtherThanAYear];
        expect(&format!("{seed}: {an_hour} {is_short}"), &file.read(), made.exposure(), &kinds);
    }
}
