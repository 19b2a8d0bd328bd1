//! Where blinds are, hour by hour, and which rooms that makes.

use super::calendar::{Calendar, Interval};
use quasilux_scene::{Blinds, BlindsControl, BlindsGroup, Scene, Sensor};
use quasilux_transport::{Settings, Sunlight, sunlit_points};
use std::collections::HashMap;

/// Sunlight that has blinds closed: on more than this share of the points more than this many lx
/// (IES LM-83).
const SUNLIT_SHARE: f64 = 0.02;
const SUNLIT_LX: f64 = 1000.0;
/// Most rooms that groups of blinds may make together over a year.
const MAX_ROOMS: usize = 256;

/// Where blinds are over a year.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BlindsOfYear {
    /// Its groups.
    pub groups: Vec<GroupOfYear>,
}

/// Where a group of blinds is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GroupOfYear {
    /// Its name.
    pub name: String,
    /// The names of its positions, the first of which is open.
    pub positions: Vec<String>,
    /// The number of its position, by hour of those with light.
    pub by_hour: Vec<usize>,
}

/// A room that blinds make, not all of them open.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RoomOfYear {
    /// The number of the position of each group.
    pub positions: Vec<usize>,
    /// Whether it is the room, by hour of those with light.
    pub is_own: Vec<bool>,
}

impl BlindsOfYear {
    /// Moves the blinds of a scene, which has them open, through a year.
    ///
    /// Runs in the rayon pool that the call is made in.
    #[must_use]
    pub fn new(blinds: &Blinds, open: &Scene, calendar: &Calendar, settings: &Settings) -> Self {
        let is_alone = blinds.groups.len() == 1;
        let of_group = |group: &BlindsGroup| {
            let names = group.positions.iter().map(|position| position.name.clone());
            let by_hour = match &group.control {
                BlindsControl::Schedule { positions } => scheduled(calendar, positions),
                BlindsControl::Sunlight { sensor } => {
                    let points = points_of(open, *sensor);
                    let day = Day { open, calendar, settings, points: &points, is_alone };
                    day.by_sunlight(group)
                }
            };
            let positions = ["open".to_owned()].into_iter().chain(names).collect();
            GroupOfYear { name: group.name.clone(), positions, by_hour }
        };
        Self { groups: blinds.groups.iter().map(of_group).collect() }
    }

    /// The rooms that they make, in the order of their first hours; not the one with all open.
    ///
    /// # Errors
    /// In words, when there are more than any machine should be asked for.
    pub fn rooms(&self) -> Result<Vec<RoomOfYear>, String> {
        let hours = self.groups.first().map_or(0, |group| group.by_hour.len());
        let mut number_of: HashMap<Vec<usize>, usize> = HashMap::new();
        let mut rooms: Vec<RoomOfYear> = Vec::new();
        for hour in 0..hours {
            let positions: Vec<usize> =
                self.groups.iter().map(|group| group.by_hour[hour]).collect();
            if positions.iter().all(|position| *position == 0) {
                continue;
            }
            let number = *number_of.entry(positions.clone()).or_insert(rooms.len());
            if number == rooms.len() {
                rooms.push(RoomOfYear { positions, is_own: vec![false; hours] });
            }
            rooms[number].is_own[hour] = true;
        }
        if rooms.len() > MAX_ROOMS {
            return Err(format!(
                "the groups of blinds make {} rooms together over the year, of {MAX_ROOMS} at \
                 most; use fewer groups, or schedules that move them together",
                rooms.len()
            ));
        }
        Ok(rooms)
    }

    /// How many intervals of a kind have a group that is not open.
    pub(super) fn closed(
        &self,
        calendar: &Calendar,
        is_of_kind: impl Fn(&Interval) -> bool,
    ) -> usize {
        let is_closed = |sky: usize| self.groups.iter().any(|group| group.by_hour[sky] > 0);
        calendar.count(|it| it.sky.is_some_and(is_closed) && is_of_kind(it))
    }
}

impl GroupOfYear {
    /// How many intervals of a kind it is in a position.
    pub(super) fn count(
        &self,
        position: usize,
        calendar: &Calendar,
        is_of_kind: impl Fn(&Interval) -> bool,
    ) -> usize {
        let is_there = |sky: usize| self.by_hour[sky] == position;
        calendar.count(|it| it.sky.is_some_and(is_there) && is_of_kind(it))
    }
}

/// What a schedule says of the hours with light.
fn scheduled(calendar: &Calendar, positions: &[usize]) -> Vec<usize> {
    let intervals = calendar.intervals.iter().zip(positions);
    intervals.filter(|(it, _)| it.sky.is_some()).map(|(_, position)| *position).collect()
}

/// The numbers of the points of a sensor, through all sensors; of all without one.
fn points_of(scene: &Scene, sensor: Option<usize>) -> std::ops::Range<usize> {
    let lengths = || scene.sensors.iter().map(Sensor::len);
    match sensor {
        Some(number) => {
            let first = lengths().take(number).sum();
            first..first + lengths().nth(number).unwrap_or(0)
        }
        None => 0..lengths().sum(),
    }
}

/// What decides where the sun has blinds.
struct Day<'d> {
    open: &'d Scene,
    calendar: &'d Calendar,
    settings: &'d Settings,
    points: &'d std::ops::Range<usize>,
    /// Whether no other group stands before the sun.
    is_alone: bool,
}

impl Day<'_> {
    /// The first position in which few points are in the sun that comes through the group, hour by
    /// hour. What comes through it is what differs with it closed.
    fn by_sunlight(&self, group: &BlindsGroup) -> Vec<usize> {
        let last = group.positions.last().map(|position| &position.room);
        let differs_from = last.filter(|_| !self.is_alone);
        let sunlight = Sunlight { above_lx: SUNLIT_LX, differs_from };
        let limit = SUNLIT_SHARE * self.points.len() as f64;
        let mut by_hour = vec![0; self.calendar.skies.len()];
        let rooms = group.positions.iter().map(|position| &position.room);
        for (number, room) in (0..group.positions.len()).zip([self.open].into_iter().chain(rooms)) {
            let Self { calendar, settings, points, .. } = *self;
            let counts = sunlit_points(room, &calendar.skies, settings, points.clone(), sunlight);
            for (position, count) in by_hour.iter_mut().zip(counts) {
                let is_too_much = *position == number && count as f64 > limit;
                *position += usize::from(is_too_much);
            }
        }
        by_hour
    }
}
