//! What changes in a room over a year of hours: blinds, and electric light that daylight dims; and
//! what the year is judged by.

use crate::{Mesh, Scene};
use std::ops::Range;

/// When people are at work, in h from midnight (IES LM-83).
pub(crate) const WORKING_HOURS: Range<f64> = 8.0..18.0;

/// Terms that a year is judged by.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct YearTerms {
    /// When people are there.
    pub occupancy: Occupancy,
    /// Thresholds that illuminances are compared with.
    pub thresholds: Thresholds,
    /// By sensor, the area that each point stands for, in any unit; empty where all are alike.
    pub areas: Vec<Vec<f64>>,
}

/// When people are there.
#[derive(Clone, Debug, PartialEq)]
pub enum Occupancy {
    /// By the clock.
    Hours {
        /// Within these hours of the day.
        hours: Range<f64>,
        /// On which days.
        days: OccupiedDays,
    },
    /// Said for each interval of the weather file.
    Schedule {
        /// Whether they are.
        is_there: Vec<bool>,
    },
}

/// Days of a year.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OccupiedDays {
    /// All of them.
    All,
    /// From Monday to Friday, in a year that begins with this day of the week, from 0 for Monday.
    Weekdays {
        /// The day of the week of 1 January.
        new_year: u32,
    },
}

/// Thresholds in lx that illuminances are compared with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thresholds {
    /// Enough light: 300 lx (IES LM-83).
    pub enough_lx: f64,
    /// Below it daylight is of no use, and above the other it is too much: 100 and 3000 lx (A.
    /// Nabil and J. Mardaljevic, "Useful daylight illuminances", Energy and Buildings 38, 2006,
    /// with the bounds in use since 2012).
    pub useful_lx: [f64; 2],
    /// Sunlight that glares or heats, straight from the sun: 1000 lx (LM-83).
    pub sunlight_lx: f64,
}

impl Occupancy {
    /// Hours of the clock, on all days.
    #[must_use]
    pub fn daily(hours: Range<f64>) -> Self {
        Self::Hours { hours, days: OccupiedDays::All }
    }

    /// Whether people are there in an interval: its number in the weather file, the day of the
    /// year, from 1, and the middle in h from midnight.
    #[must_use]
    pub fn holds(&self, interval: usize, day_of_year: u32, middle_h: f64) -> bool {
        match self {
            Self::Hours { hours, days } => hours.contains(&middle_h) && days.holds(day_of_year),
            Self::Schedule { is_there } => is_there.get(interval).is_some_and(|is_there| *is_there),
        }
    }
}

impl OccupiedDays {
    fn holds(self, day_of_year: u32) -> bool {
        match self {
            Self::All => true,
            Self::Weekdays { new_year } => (new_year + day_of_year + 6) % 7 < 5,
        }
    }
}

/// Working hours, on all days (LM-83).
impl Default for Occupancy {
    fn default() -> Self {
        Self::daily(WORKING_HOURS)
    }
}

impl Default for Thresholds {
    fn default() -> Self {
        Self { enough_lx: 300.0, useful_lx: [100.0, 3000.0], sunlight_lx: 1000.0 }
    }
}

/// Blinds: groups of them, each of which moves by itself.
#[derive(Clone, Debug)]
pub struct Blinds {
    /// The groups, in the order of the project file.
    pub groups: Vec<BlindsGroup>,
}

/// Blinds that move together.
#[derive(Clone, Debug)]
pub struct BlindsGroup {
    /// Their name; `blinds` where a project that has one group gives none.
    pub name: String,
    /// Where they may be other than open, the last the one that they close to.
    pub positions: Vec<BlindsPosition>,
    /// When they are where.
    pub control: BlindsControl,
}

/// A position of blinds.
#[derive(Clone, Debug)]
pub struct BlindsPosition {
    /// Its name.
    pub name: String,
    /// The room with the group there and all others open. It has the sensors of the open room, in
    /// the same order, and its triangles and materials before any others.
    pub room: Scene,
}

/// When blinds are where. Positions are numbered: 0 is open, 1 the first of the group's.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum BlindsControl {
    /// The first position in which at most 2 % of the points of a sensor get more than 1000 lx
    /// straight from the sun through the group (IES LM-83); of all sensors together without a
    /// number.
    Sunlight {
        /// The number of the sensor.
        sensor: Option<usize>,
    },
    /// Said for each interval of the weather file.
    Schedule {
        /// The numbers of the positions.
        positions: Vec<usize>,
    },
}

/// Electric light that brings a sensor to its target where daylight does not.
#[derive(Clone, Debug, PartialEq)]
pub struct ElectricLight {
    /// The name of the zone that it lights; `electric_light` where a project that has one gives
    /// none.
    pub name: String,
    /// The number of the sensor whose average counts.
    pub sensor: usize,
    /// The illuminance that it is to have, in lx: at full power the lamps give it alone.
    pub target_lx: f64,
    /// At full power, in W.
    pub power_w: f64,
    /// In W while people are there, however much daylight there is.
    pub min_power_w: f64,
}

impl Blinds {
    /// The room with its groups in these positions, by number; `open` is the room with all of them
    /// open.
    #[must_use]
    pub fn room(&self, open: &Scene, positions: &[usize]) -> Scene {
        let mut room = open.clone();
        for (group, number) in self.groups.iter().zip(positions) {
            let position = number.checked_sub(1).and_then(|number| group.positions.get(number));
            position.into_iter().for_each(|position| add(&mut room, open, &position.room));
        }
        room
    }
}

/// Puts what another room has beside the open one into a room that has the open one's parts first.
fn add(room: &mut Scene, open: &Scene, other: &Scene) {
    for (number, material) in other.materials.iter().enumerate() {
        match open.materials.get(number) {
            Some(before) if before != material => room.materials[number] = material.clone(),
            _ => {}
        }
    }
    let own = open.materials.len();
    let mut material_of: Vec<u32> = (0..own as u32).collect();
    for material in other.materials.iter().skip(own) {
        let known = room.materials.iter().position(|known| known == material);
        material_of.push(known.unwrap_or(room.materials.len()) as u32);
        if known.is_none() {
            room.materials.push(material.clone());
        }
    }
    let (to, from, before) = (&mut room.mesh, &other.mesh, &open.mesh);
    let behind = |to: usize, before: usize, index: u32| match index as usize {
        index if index < before => index as u32,
        index => (index - before + to) as u32,
    };
    let (vertices, objects) = (to.positions.len(), to.objects.len());
    let first = before.triangles.len();
    let Mesh { triangles, material_of: materials, object_of, .. } = from;
    let corners = triangles[first..].iter();
    to.triangles
        .extend(corners.map(|it| it.map(|it| behind(vertices, before.positions.len(), it))));
    to.material_of.extend(materials[first..].iter().map(|it| material_of[*it as usize]));
    to.object_of
        .extend(object_of[first..].iter().map(|it| behind(objects, before.objects.len(), *it)));
    to.positions.extend_from_slice(&from.positions[before.positions.len()..]);
    to.objects.extend_from_slice(&from.objects[before.objects.len()..]);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 1 January 2024 was a Monday, 2 March 2024 a Saturday.
    #[test]
    fn weekends_are_free() {
        let occupancy = |new_year| Occupancy::Hours {
            hours: 8.0..18.0,
            days: OccupiedDays::Weekdays { new_year },
        };
        for (day, is_there) in
            [(1, true), (5, true), (6, false), (7, false), (8, true), (62, false)]
        {
            assert_eq!(occupancy(0).holds(0, day, 12.0), is_there, "{day}");
            assert_eq!(
                occupancy(2).holds(0, day.max(3) - 2, 12.0),
                occupancy(0).holds(0, day.max(3), 12.0)
            );
        }
        assert!(!occupancy(0).holds(0, 1, 18.0) && occupancy(0).holds(0, 1, 8.0));
        let schedule = Occupancy::Schedule { is_there: vec![false, true] };
        assert_eq!([0, 1, 2].map(|number| schedule.holds(number, 6, 3.0)), [false, true, false]);
    }
}
