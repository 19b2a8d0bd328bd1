//! All results of a year.

use super::blinds::BlindsOfYear;
use super::calendar::Calendar;
use super::dimming::Dimming;
use super::equinox::EquinoxSheets;
use super::point::{PointOfHours, PointSummary};
use super::sensor::SensorOfYear;
use super::sun_hours::SunHours;
use quasilux_scene::{Occupancy, Scene, Sensor, Thresholds, YearTerms};
use quasilux_sky::{Site, Weather};
use quasilux_transport::{Settings, YearWork};

/// What a year was made of.
#[derive(Clone, Debug)]
pub struct AnnualRun {
    /// The version of the program.
    pub version: String,
    /// SHA-256 of all that the scene was read from.
    pub scene_sha256: String,
    /// How long it took, in s.
    pub seconds: f64,
    /// On this many threads.
    pub threads: usize,
    /// The settings.
    pub settings: Settings,
    /// What it took.
    pub work: YearWork,
    /// What a reader should know.
    pub warnings: Vec<String>,
}

/// A sensor with what its points have of the year, as far as they were simulated.
#[derive(Clone, Copy, Debug)]
pub struct SensorPoints<'a> {
    /// The sensor.
    pub sensor: &'a Sensor,
    /// Its points.
    pub points: &'a [PointSummary],
    /// How long the sun shines on them; empty where nobody looked.
    pub sun_hours: &'a [SunHours],
    /// The number of the first of them.
    pub first: usize,
}

/// The results of a year.
#[derive(Clone, Debug)]
pub struct AnnualReport<'a> {
    /// The scene with its sensors.
    pub scene: &'a Scene,
    /// What the weather file calls the place.
    pub place: &'a str,
    /// Where it is.
    pub site: Site,
    /// The hours.
    pub calendar: &'a Calendar,
    /// When people are there.
    pub occupancy: Occupancy,
    /// Where blinds are; `None` where there are none.
    pub blinds: Option<BlindsOfYear>,
    /// Zones of electric light that daylight dims.
    pub dimmings: Vec<Dimming>,
    /// What illuminances were compared with.
    pub thresholds: Thresholds,
    /// By sensor, the area that each point stands for; empty where all are alike.
    pub areas: Vec<Vec<f64>>,
    /// All points, through all sensors.
    pub points: Vec<PointSummary>,
    /// How long the sun shines on them, through all sensors, if anybody looked.
    pub sun_hours: Vec<SunHours>,
    /// What they get near the equinoxes.
    pub equinox: EquinoxSheets,
    /// By sensor, the mean illuminance over its points in lx, interval by interval.
    pub mean_lx: Vec<Vec<f64>>,
    /// What it was made of.
    pub run: AnnualRun,
}

impl<'a> AnnualReport<'a> {
    /// Each sensor with its points.
    pub fn sensors(&self) -> impl Iterator<Item = SensorPoints<'_>> {
        let mut first = 0;
        self.scene.sensors.iter().map(move |sensor| {
            let own = first..(first + sensor.len()).min(self.points.len());
            let points = self.points.get(own.clone()).unwrap_or_default();
            let sun_hours = self.sun_hours.get(own.clone()).unwrap_or_default();
            first += sensor.len();
            SensorPoints { sensor, points, sun_hours, first: own.start }
        })
    }

    /// What each sensor has of the year.
    pub fn summaries(&self) -> impl Iterator<Item = SensorOfYear> {
        let alike: &[f64] = &[];
        self.sensors().enumerate().map(move |(number, of)| {
            let areas = self.areas.get(number).map_or(alike, Vec::as_slice);
            SensorOfYear::new(of.points, areas, self.calendar.is_of_a_year)
        })
    }

    /// Whether all points reached the tolerance.
    #[must_use]
    pub fn is_done(&self) -> bool {
        self.run.work.is_complete && self.points.iter().all(|point| point.is_done)
    }

    /// A report without results, of a room without blinds and electric light.
    #[must_use]
    pub fn begin(
        scene: &'a Scene,
        weather: &'a Weather,
        calendar: &'a Calendar,
        terms: YearTerms,
        run: AnnualRun,
    ) -> Self {
        let hours = calendar.intervals.len();
        Self {
            scene,
            place: &weather.place,
            site: weather.site,
            calendar,
            occupancy: terms.occupancy,
            blinds: None,
            dimmings: Vec::new(),
            thresholds: terms.thresholds,
            areas: terms.areas,
            points: Vec::new(),
            sun_hours: Vec::new(),
            equinox: EquinoxSheets::begin(calendar),
            mean_lx: vec![vec![0.0; hours]; scene.sensors.len()],
            run,
        }
    }

    /// Adds the next point.
    pub fn push(&mut self, point: &PointOfHours) {
        for dimming in &mut self.dimmings {
            dimming.add(self.points.len(), &point.by_replicate, point.t);
        }
        self.equinox.push(point);
        let mut number = self.points.len();
        for (sensor, mean_lx) in self.scene.sensors.iter().zip(&mut self.mean_lx) {
            if number < sensor.len() {
                let share = 1.0 / sensor.len() as f64;
                let hours = mean_lx.iter_mut().zip(&point.illuminance_lx);
                hours.for_each(|(mean, lx)| *mean += share * f64::from(*lx));
                break;
            }
            number -= sensor.len();
        }
        self.points.push(point.summary.clone());
    }
}
