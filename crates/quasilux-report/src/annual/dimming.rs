//! The energy of electric light that daylight dims.

use super::calendar::Calendar;
use crate::Figure;
use quasilux_scene::{ElectricLight, Scene, Sensor};
use std::ops::Range;

/// Electric light, with the daylight of its sensor as far as it is known.
#[derive(Clone, Debug)]
pub struct Dimming {
    /// What is dimmed.
    pub light: ElectricLight,
    /// The points of its sensor, numbered through all sensors.
    points: Range<usize>,
    /// The mean over the sensor in lx, by replicate and hour with light.
    mean_lx: Vec<Vec<f64>>,
    /// Half-width over standard error of the intervals of points.
    t: Option<f64>,
}

/// What lamps take in a year.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnergyOfYear {
    /// Dimmed, in kWh.
    pub dimmed_kwh: Figure,
    /// At full power in all occupied hours, in kWh.
    pub full_kwh: f64,
}

impl EnergyOfYear {
    /// Of all zones together. What is not known of them may go the same way: half-widths add up.
    #[must_use]
    pub fn of_all(zones: &[Dimming], calendar: &Calendar) -> Self {
        let all: Vec<Self> = zones.iter().map(|dimming| dimming.energy(calendar)).collect();
        let value = all.iter().map(|energy| energy.dimmed_kwh.value).sum();
        let half_width = all.iter().map(|energy| energy.dimmed_kwh.half_width).sum();
        let full_kwh = all.iter().map(|energy| energy.full_kwh).sum();
        Self { dimmed_kwh: Figure { value, half_width }, full_kwh }
    }
}

impl Dimming {
    /// Without any daylight yet.
    #[must_use]
    pub fn begin(light: ElectricLight, scene: &Scene) -> Self {
        let first = scene.sensors.iter().take(light.sensor).map(Sensor::len).sum();
        let count = scene.sensors.get(light.sensor).map_or(0, Sensor::len);
        Self { light, points: first..first + count, mean_lx: Vec::new(), t: None }
    }

    /// Adds the illuminances of a point in lx, by replicate and hour with light, if it is one of
    /// the sensor's, and half-width over standard error of its intervals.
    pub(super) fn add(&mut self, number: usize, illuminance_lx: &[Vec<f32>], t: Option<f64>) {
        if !self.looks_at(number) {
            return;
        }
        self.t = t;
        let share = 1.0 / self.points.len() as f64;
        self.mean_lx.resize_with(illuminance_lx.len(), Vec::new);
        for (means, hours) in self.mean_lx.iter_mut().zip(illuminance_lx) {
            means.resize(hours.len(), 0.0);
            means.iter_mut().zip(hours).for_each(|(mean, lx)| *mean += share * f64::from(*lx));
        }
    }

    /// Whether a point, numbered through all sensors, is one of the sensor's.
    #[must_use]
    pub fn looks_at(&self, number: usize) -> bool {
        self.points.contains(&number)
    }

    /// The energy of the occupied hours. Power falls in a straight line from all of it without
    /// daylight to the least where daylight reaches the target. The half-width is that of the
    /// jackknife over replicates.
    #[must_use]
    pub fn energy(&self, calendar: &Calendar) -> EnergyOfYear {
        let replicates = self.mean_lx.len();
        let hours = self.mean_lx.first().map_or(0, Vec::len);
        let sum = |hour: usize| self.mean_lx.iter().map(|means| means[hour]).sum::<f64>();
        let sums: Vec<f64> = (0..hours).map(sum).collect();
        let of = |lx: &dyn Fn(usize) -> f64| self.dimmed_kwh(calendar, lx);
        let value = of(&|hour| sums.get(hour).map_or(0.0, |sum| sum / replicates as f64));
        let others = (replicates as f64 - 1.0).max(1.0);
        let squares = self.mean_lx.iter().map(|own| {
            let without = of(&|hour| (sums[hour] - own[hour]) / others);
            (without - value) * (without - value)
        });
        let error = (squares.sum::<f64>() * others / replicates.max(1) as f64).sqrt();
        let dimmed_kwh = Figure { value: Some(value), half_width: self.t.map(|t| t * error) };
        let occupied_h = calendar.interval_h * calendar.count(|it| it.is_occupied) as f64;
        EnergyOfYear { dimmed_kwh, full_kwh: 1e-3 * self.light.power_w * occupied_h }
    }

    fn dimmed_kwh(&self, calendar: &Calendar, lx: &dyn Fn(usize) -> f64) -> f64 {
        let ElectricLight { target_lx, power_w, min_power_w, .. } = self.light;
        let occupied = calendar.intervals.iter().filter(|interval| interval.is_occupied);
        let power = occupied.map(|interval| {
            let daylight_lx = interval.sky.map_or(0.0, lx);
            let missing = (1.0 - daylight_lx / target_lx).clamp(0.0, 1.0);
            min_power_w + (power_w - min_power_w) * missing
        });
        1e-3 * calendar.interval_h * power.sum::<f64>()
    }
}
