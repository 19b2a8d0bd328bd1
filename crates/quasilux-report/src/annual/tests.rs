//! A made-up year of few hours, whose measures can be counted.

use super::*;
use crate::Figure;
use crate::number::exact;
use glam::DVec3;
use quasilux_scene::{
    Blinds, BlindsControl, BlindsGroup, BlindsPosition, ElectricLight, Environment, Occupancy,
    Scene, Sensor, SensorPoint, SensorShape, Thresholds,
};
use quasilux_sky::{Distribution, Site, Sky, SkyLevel, Weather};
use quasilux_transport::interval::t_quantile_for;
use quasilux_transport::{PointOfYear, Settings};

/// The head of an EPW file.
const HEAD: &str = "LOCATION,Nowhere,-,DEU,made up,000000,52.5,13.4,1.0,34.0\n\
        DESIGN CONDITIONS,0\nTYPICAL/EXTREME PERIODS,0\nGROUND TEMPERATURES,0\n\
        HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0\nCOMMENTS 1,made up\nCOMMENTS 2,\n\
        DATA PERIODS,1,1,Data,Sunday, 1/ 1,12/31\n";

/// Two days, of which one hour is unknown: in EPW lines of month, day, hour, direct and diffuse.
fn calendar() -> Calendar {
    let mut text = HEAD.to_owned();
    for day in 20..22 {
        for hour in 1..=24 {
            let light = match (day, hour) {
                (20, 9) => "0,100",
                (20, 12) => "500,200",
                (20, 20) => "0,50",
                (21, 12) => "9999,9999",
                _ => "0,0",
            };
            let before = "?9?9,9.0,7.0,87,102000,0,0,305,0";
            text += &format!("2026,6,{day},{hour},0,{before},{light},0,0\n");
        }
    }
    let weather = Weather::parse(text.as_bytes()).unwrap().weather;
    Calendar::new(&weather, &Occupancy::default()).unwrap()
}

/// A point whose three hours with light have these illuminances in each replicate.
fn point(illuminance_lx: Vec<Vec<f32>>, sun_lx: [f32; 3]) -> PointOfYear {
    let sun_lx = vec![sun_lx.to_vec(); illuminance_lx.len()];
    PointOfYear {
        number: 0,
        unseen_lx: vec![0.0; illuminance_lx.first().map_or(0, Vec::len)],
        illuminance_lx,
        sun_lx,
        samples: 128,
        relative_half_width: Some(0.01),
        is_done: true,
        invalid: 0,
        miss_probability: 0.04,
    }
}

fn value(figure: Figure) -> f64 {
    figure.value.unwrap()
}

#[test]
fn hours_count_for_what_they_are() {
    let calendar = calendar();
    assert_eq!((calendar.intervals.len(), calendar.skies.len(), calendar.interval_h), (48, 3, 1.0));
    assert_eq!(calendar.count(|interval| !interval.is_known), 1);
    // Ten hours a day, one of them unknown.
    assert_eq!(calendar.count(|interval| interval.is_occupied), 19);
    // The brighter half of 47 hours, those with light among them.
    assert_eq!(calendar.count(|interval| interval.is_daylit), 24);
    let lit = calendar.count(|interval| interval.is_daylit && interval.sky.is_some());
    assert_eq!(lit, 3);
}

#[test]
fn measures_are_counted_over_occupied_hours() {
    let calendar = calendar();
    // The evening is not occupied.
    let of_year = point(vec![vec![150.0, 4000.0, 90.0]; 2], [0.0, 1500.0, 0.0]);
    let hours = PointOfHours::new(of_year, &calendar, &Thresholds::default());
    let measure = |measure| value(hours.summary.measure(measure));
    let share = 1.0 / 19.0;
    assert!((measure(Measure::Autonomy) - share).abs() < 1e-12);
    assert!((measure(Measure::ContinuousAutonomy) - 1.5 * share).abs() < 1e-12);
    assert!((measure(Measure::TooLittle) - 17.0 * share).abs() < 1e-12);
    assert!((measure(Measure::Supplementary) - share).abs() < 1e-12);
    assert_eq!(measure(Measure::Autonomous), 0.0);
    assert!((measure(Measure::TooMuch) - share).abs() < 1e-12);
    assert_eq!((measure(Measure::SunlitHours), measure(Measure::Exposure)), (1.0, 4240.0));
    assert_eq!(measure(Measure::MedianDaylight), 0.0);
    assert_eq!(hours.summary.hours, HourCounts { above: 1, below: 18, undecided: 0 });
    let noon = calendar.intervals.iter().position(|it| it.sky == Some(1)).unwrap();
    assert_eq!((hours.illuminance_lx[noon], hours.illuminance_lx[0]), (4000.0, 0.0));
    assert!(hours.illuminance_lx[24 + 11].is_nan());
}

/// The interval of what is linear in the illuminances is that of a mean; a threshold within the
/// interval of an hour leaves it undecided.
#[test]
fn intervals_come_from_replicates() {
    let calendar = calendar();
    let noon = [290.0, 302.0, 310.0, 304.0_f32];
    let replicates = noon.map(|lx| vec![100.0, lx, 0.5 * lx]).to_vec();
    let hours = PointOfHours::new(point(replicates, [0.0; 3]), &calendar, &Thresholds::default());
    let t = t_quantile_for(4, 0.04).unwrap();
    let mean = 301.5;
    let off = |lx: &f32| f64::from(*lx) - mean;
    let squares: f64 = noon.iter().map(|lx| off(lx) * off(lx)).sum();
    let half_width = t * (squares / 12.0).sqrt();
    let at = calendar.intervals.iter().position(|it| it.sky == Some(1)).unwrap();
    assert!((f64::from(hours.half_width_lx[at]) - half_width).abs() < 1e-4);
    let exposure = hours.summary.measure(Measure::Exposure);
    assert!((value(exposure) - (100.0 + 1.5 * mean)).abs() < 1e-9);
    // The hour that is not known may be as bright as the brightest.
    assert!((exposure.half_width.unwrap() - 1.5 * half_width - mean).abs() < 1e-6);
    let too_much = hours.summary.measure(Measure::TooMuch);
    assert_eq!((too_much.value, too_much.half_width), (Some(0.0), Some(1.0 / 20.0)));
    assert_eq!(hours.summary.hours, HourCounts { above: 0, below: 18, undecided: 1 });
    let alone = point(vec![vec![100.0, 400.0, 50.0]], [0.0; 3]);
    let alone = PointOfHours::new(alone.clone(), &calendar, &Thresholds::default());
    assert!(alone.summary.measures.iter().all(|figure| figure.half_width.is_none()));
}

/// Numbers in [0, 1).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// About normal, with a standard deviation of 1.
    fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.next()).sum::<f64>() - 6.0
    }
}

/// A made-up year of 200 hours of which the truth is known, estimated in 16 replicates with errors
/// that hours share, and others of their own.
fn noisy_year(numbers: &mut Numbers) -> [PointOfYear; 2] {
    let truth: Vec<f64> = (0..200).map(|_| 20.0 * libm::exp(6.0 * numbers.next())).collect();
    let [shared, own] = [(); 2].map(|()| 0.06 * numbers.next());
    let replicate = |numbers: &mut Numbers| {
        let all = 1.0 + shared * numbers.normal();
        truth.iter().map(|lx| (lx * (all + own * numbers.normal())) as f32).collect::<Vec<_>>()
    };
    let noisy = (0..16).map(|_| replicate(numbers)).collect();
    let truth: Vec<f32> = truth.iter().map(|lx| *lx as f32).collect();
    let of = |illuminance_lx: Vec<Vec<f32>>| PointOfYear {
        sun_lx: illuminance_lx.clone(),
        ..point(illuminance_lx, [0.0; 3])
    };
    [of(vec![truth; 2]), of(noisy)]
}

/// Counts of hours near a threshold are off by what their intervals say, in most of the years, and
/// the intervals are of use.
#[test]
fn counts_of_hours_hold_the_truth() {
    let mut calendar = calendar();
    let hour = calendar.intervals[11];
    calendar.intervals = (0..200)
        .map(|sky| Interval { sky: Some(sky), is_occupied: true, is_known: true, ..hour })
        .collect();
    calendar.skies = vec![calendar.skies[0].clone(); 200];
    let mut numbers = Numbers(3);
    const YEARS: u32 = 400;
    let mut covered = [0; Measure::ALL.len()];
    let mut wide = [0.0; Measure::ALL.len()];
    for _ in 0..YEARS {
        let [truth, found] = noisy_year(&mut numbers)
            .map(|point| PointOfHours::new(point, &calendar, &Thresholds::default()).summary);
        for (number, measure) in Measure::ALL.into_iter().enumerate() {
            let [truth, found] = [&truth, &found].map(|summary| summary.measure(measure));
            let half_width = found.half_width.unwrap();
            let is_covered = (value(found) - value(truth)).abs() <= half_width + 1e-9;
            covered[number] += u32::from(is_covered);
            wide[number] += half_width / f64::from(YEARS);
        }
    }
    for (number, measure) in Measure::ALL.into_iter().enumerate() {
        // Of 400 intervals of 95 %, 20 miss on average, and 34 once in a thousand.
        assert!(covered[number] + 34 > YEARS, "{measure:?}: {covered:?}");
        assert!(!measure.is_share() || wide[number] < 0.03, "{measure:?}: {wide:?}");
    }
}

/// Bounds of shares of points follow from the intervals of the points.
#[test]
fn shares_of_points_have_bounds() {
    let of = |autonomy: [f64; 2], sunlit: [f64; 2], median: [f64; 2]| {
        let mut measures = [Figure { value: Some(0.0), half_width: Some(0.0) }; Measure::ALL.len()];
        let mut set = |measure: Measure, [value, half_width]: [f64; 2]| {
            let place = Measure::ALL.iter().position(|other| *other == measure).unwrap();
            measures[place] = Figure { value: Some(value), half_width: Some(half_width) };
        };
        set(Measure::Autonomy, autonomy);
        set(Measure::SunlitHours, sunlit);
        set(Measure::MedianDaylight, median);
        PointSummary {
            measures,
            hours: HourCounts::default(),
            samples: 1,
            relative_half_width: None,
            is_done: true,
        }
    };
    let points = [
        of([0.6, 0.01], [300.0, 5.0], [760.0, 5.0]),
        of([0.51, 0.02], [252.0, 5.0], [510.0, 15.0]),
        of([0.49, 0.02], [249.0, 5.0], [310.0, 5.0]),
        of([0.3, 0.01], [0.0, 0.0], [310.0, 5.0]),
    ];
    let sensor = SensorOfYear::new(&points, &[], true);
    assert_eq!(sensor.autonomy, ShareOfPoints { value: 0.5, low: 0.25, high: 0.75 });
    assert_eq!(sensor.sunlight, ShareOfPoints { value: 0.5, low: 0.25, high: 0.75 });
    // Half of the points have 500 lx, one of them not surely; all have 300 lx.
    assert_eq!(sensor.en17037, Some(DaylightLevel { level: 2, bounds: [1, 2] }));
    assert_eq!(SensorOfYear::new(&points, &[], false).en17037, None);
    // Of 10 m2, 3 surely have enough light, 2 more perhaps, and 1 more perhaps not.
    let sensor = SensorOfYear::new(&points, &[3.0, 2.0, 1.0, 4.0], true);
    assert_eq!(sensor.autonomy, ShareOfPoints { value: 0.5, low: 0.3, high: 0.6 });
    assert_eq!(sensor.en17037, Some(DaylightLevel { level: 2, bounds: [1, 2] }));
    // Half of the plane lacks 500 lx where the first two points stand for less than half.
    let sensor = SensorOfYear::new(&points, &[2.0, 2.0, 1.0, 5.0], true);
    assert_eq!(sensor.en17037, Some(DaylightLevel { level: 1, bounds: [1, 1] }));
}

/// Occupied hours without daylight take all power, those with a part of the target a part of it,
/// others the least; the interval is that of the differences between replicates.
#[test]
fn daylight_dims_lamps() {
    let calendar = calendar();
    let light = light(1000.0);
    let t = t_quantile_for(2, 0.04);
    let mut dimming = Dimming::begin(light.clone(), &scene_of_points(2));
    dimming.add(0, &[vec![50.0, 900.0, 0.0], vec![70.0, 900.0, 0.0]], t);
    dimming.add(1, &[vec![150.0, 900.0, 0.0], vec![130.0, 900.0, 0.0]], t);
    dimming.add(2, &[vec![1e6; 3], vec![1e6; 3]], t);
    // 17 hours in the dark, one with a quarter of the target, one with more than it.
    let EnergyOfYear { dimmed_kwh, full_kwh } = dimming.energy(&calendar);
    let expected = 17.0 + (0.1 + 0.9 * 0.75) + 0.1;
    assert!((value(dimmed_kwh) - expected).abs() < 1e-9, "{dimmed_kwh:?}");
    assert_eq!((full_kwh, dimmed_kwh.half_width), (19.0, Some(0.0)));
    let mut noisy = Dimming::begin(light, &scene_of_points(1));
    noisy.add(0, &[vec![100.0, 900.0, 0.0], vec![140.0, 900.0, 0.0]], t);
    // Means of 100 and 140 lx are 20 lx from their mean: this many times the slope is the error.
    let error = 20.0 / 400.0 * 0.9;
    let found = noisy.energy(&calendar).dimmed_kwh.half_width.unwrap();
    assert!((found / (t.unwrap() * error) - 1.0).abs() < 1e-9, "{found}");
}

fn light(power_w: f64) -> ElectricLight {
    let name = "desks".to_owned();
    ElectricLight { name, sensor: 0, target_lx: 400.0, power_w, min_power_w: 0.1 * power_w }
}

fn scene_of_points(count: usize) -> Scene {
    let point = SensorPoint { position: DVec3::ZERO, normal: DVec3::Z };
    let shape = SensorShape::Points(vec![point; count]);
    Scene { sensors: vec![Sensor { name: "desk".to_owned(), shape }], ..Scene::default() }
}

/// A schedule says it of all intervals, those without light, too; groups make a room of each set
/// of positions that comes together.
#[test]
fn schedules_move_groups_of_blinds() {
    let calendar = calendar();
    let with_sky = |sky| calendar.intervals.iter().position(|it| it.sky == Some(sky)).unwrap();
    let group = |name: &str, by_sky: [usize; 3]| {
        let mut positions = vec![1; 48];
        (0..3).for_each(|sky| positions[with_sky(sky)] = by_sky[sky]);
        let position =
            |name: &str| BlindsPosition { name: name.to_owned(), room: Scene::default() };
        BlindsGroup {
            name: name.to_owned(),
            positions: ["half", "closed"].map(position).to_vec(),
            control: BlindsControl::Schedule { positions },
        }
    };
    let blinds = Blinds { groups: vec![group("south", [2, 0, 2]), group("west", [1, 0, 1])] };
    let settings = Settings::default();
    let year = BlindsOfYear::new(&blinds, &Scene::default(), &calendar, &settings);
    assert_eq!(year.groups[0].by_hour, [2, 0, 2]);
    let room = RoomOfYear { positions: vec![2, 1], is_own: vec![true, false, true] };
    assert_eq!(year.rooms(), Ok(vec![room]));
    assert_eq!(year.closed(&calendar, |_| true), 2);
    let alone = Blinds { groups: vec![group("south", [0, 1, 2])] };
    let rooms = BlindsOfYear::new(&alone, &Scene::default(), &calendar, &settings).rooms().unwrap();
    let own: Vec<&[bool]> = rooms.iter().map(|room| room.is_own.as_slice()).collect();
    assert_eq!(own, [[false, true, false], [false, false, true]]);
}

/// Half-widths of zones add up: nothing says that their errors are apart.
#[test]
fn zones_of_electric_light_add_up() {
    let calendar = calendar();
    let zone = |power_w: f64| {
        let mut zone = Dimming::begin(light(power_w), &scene_of_points(1));
        zone.add(0, &[vec![100.0, 900.0, 0.0], vec![140.0, 900.0, 0.0]], t_quantile_for(2, 0.04));
        zone
    };
    let both = EnergyOfYear::of_all(&[zone(1000.0), zone(500.0)], &calendar);
    let [large, small] = [1000.0, 500.0].map(|power_w| zone(power_w).energy(&calendar));
    let sum = value(large.dimmed_kwh) + value(small.dimmed_kwh);
    assert!((value(both.dimmed_kwh) - sum).abs() < 1e-9);
    let widths = [large, small, both].map(|it| it.dimmed_kwh.half_width.unwrap());
    assert!((widths[0] + widths[1] - widths[2]).abs() < 1e-12 && widths[2] > 0.0);
    assert_eq!(both.full_kwh, large.full_kwh + small.full_kwh);
}

/// Under the open sky all that the calendar has is seen, and on the equinox half of a day.
#[test]
fn open_points_are_in_the_sun_all_day() {
    let calendar = calendar();
    let site = Site::new(52.5, 13.4, 1.0).unwrap();
    let mut scene = scene_of_points(1);
    let sky = Sky::new(Distribution::uniform(), SkyLevel::ZenithLuminance { cd_m2: 1.0 }).unwrap();
    let openings = Vec::new();
    scene.environment =
        Some(Environment { sky, sun: None, ground_reflectance: 0.2, north_deg: 0.0, openings });
    let found = sun_hours(&scene, &calendar, &site, &Settings::default()).unwrap();
    let [SunHours { sunlit_h, clear_sky_sunlit_h, equinox_sunlit_h }] = found[..] else {
        panic!("one point: {found:?}")
    };
    let up = calendar.skies.iter().filter(|sky| sky.sun.altitude_deg > 0.0);
    assert_eq!(clear_sky_sunlit_h, up.clone().count() as f64);
    let bright = up.filter(|sky| sky.sun_normal_illuminance_lx > 12_000.0);
    assert_eq!(sunlit_h, bright.count() as f64);
    assert!(sunlit_h >= 1.0 && (equinox_sunlit_h - 12.0).abs() < 0.2, "{found:?}");
}

/// The sheets are of the clear day within a fortnight of the equinox, not of a brighter one later.
#[test]
fn a_year_without_radiation_has_no_level() {
    let mut text = HEAD.to_owned();
    let days = [31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31];
    for (month, days) in (1..).zip(days) {
        for (day, hour) in (1..=days).flat_map(|day| (1..=24).map(move |hour| (day, hour))) {
            let before = "?9?9,9.0,7.0,87,102000,0,0,305,0";
            text += &format!("2026,{month},{day},{hour},0,{before},9999,9999,0,0\n");
        }
    }
    let weather = Weather::parse(text.as_bytes()).unwrap().weather;
    let calendar = Calendar::new(&weather, &Occupancy::default()).unwrap();
    assert!(calendar.is_of_a_year);
    // Night is night: half of the year but for twilight.
    let dark = calendar.count(|interval| interval.is_known);
    assert!((3200..4000).contains(&dark), "{dark}");
    let nothing = point(vec![Vec::new(); 4], [0.0; 3]);
    let nothing = PointOfYear { sun_lx: vec![Vec::new(); 4], ..nothing };
    let hours = PointOfHours::new(nothing, &calendar, &Thresholds::default());
    let sensor = SensorOfYear::new(&[hours.summary], &[], calendar.is_of_a_year);
    assert_eq!(sensor.en17037, Some(DaylightLevel { level: 0, bounds: [0, 3] }));
    assert_eq!((sensor.autonomy.low, sensor.autonomy.high), (0.0, 1.0));
}

#[test]
fn sheets_of_the_equinox_are_of_the_clearest_day() {
    let mut text = HEAD.to_owned();
    for (month, day, direct) in [(3, 10, 200), (3, 25, 700), (4, 20, 900), (9, 20, 0)] {
        for hour in 1..=24 {
            let direct = if (8..=17).contains(&hour) { direct } else { 0 };
            let before = "?9?9,9.0,7.0,87,102000,0,0,305,0";
            text += &format!("2026,{month},{day},{hour},0,{before},{direct},90,0,0\n");
        }
    }
    let weather = Weather::parse(text.as_bytes()).unwrap().weather;
    let calendar = Calendar::new(&weather, &Occupancy::default()).unwrap();
    let mut sheets = EquinoxSheets::begin(&calendar);
    let hours = calendar.skies.len();
    let lx: Vec<f32> = (0..hours).map(|hour| hour as f32).collect();
    let of_year =
        PointOfYear { sun_lx: vec![vec![0.0; hours]; 2], ..point(vec![lx.clone(), lx], [0.0; 3]) };
    let hours = PointOfHours::new(of_year, &calendar, &Thresholds::default());
    sheets.push(&hours);
    let text = sheets.csv(&scene_of_points(1).sensors[0], 0, &calendar).unwrap();
    let [head, line] = [0, 1].map(|n| text.lines().nth(n).unwrap());
    assert_eq!(head.split(',').count(), 6 + 2 * 6);
    assert!(head.contains(",03-25T09:30_lx,03-25T09:30_half_width_lx,"), "{head}");
    assert!(head.ends_with(",03-25T14:30_half_width_lx"), "{head}");
    let noon = calendar.intervals.iter().find(|it| (it.month, it.middle_h) == (3, 9.5));
    assert!(noon.is_some() && line.starts_with("0.0,0.0,0.0,0.0,0.0,1.0,"), "{line}");
    let first = calendar.intervals[24 + 9].sky.unwrap();
    assert_eq!(line.split(',').nth(6), Some(exact(first as f64).as_str()), "{line}");
}
