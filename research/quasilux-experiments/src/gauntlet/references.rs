//! What the brute-force program found, as the crate ships it.
//!
//! One line a sensor point: the room's number, the point's, lx, its standard error in lx, and the
//! digest of the room. A room that another generator made has another digest and is refused.
//! `cargo run --release -p quasilux-experiments --example gauntlet-references` adds rooms.

use super::Room;

/// The lines of the cache.
const CACHE: &str = include_str!("references.csv");

/// What a sensor point gets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reference {
    /// The illuminance in lx.
    pub lx: f64,
    /// Its standard error in lx.
    pub standard_error_lx: f64,
}

/// The references of a room, one a point.
#[derive(Clone, Debug, PartialEq)]
pub struct RoomReferences {
    /// Number of the room.
    pub number: u64,
    /// Digest of the room that they are for.
    pub digest: String,
    /// In the order of its places.
    pub points: Vec<Reference>,
}

impl RoomReferences {
    /// Whether they are for this room.
    #[must_use]
    pub fn fit(&self, room: &Room) -> bool {
        self.digest == room.digest() && self.points.len() == room.places.len()
    }

    /// The lines of the cache that hold them.
    #[must_use]
    pub fn lines(&self) -> String {
        let line = |(number, point): (usize, &Reference)| {
            let Reference { lx, standard_error_lx } = point;
            format!("{},{number},{lx:e},{standard_error_lx:.3e},{}\n", self.number, self.digest)
        };
        self.points.iter().enumerate().map(line).collect()
    }
}

/// All rooms of the cache, in its order; lines that say nothing are passed over.
#[must_use]
pub fn references() -> Vec<RoomReferences> {
    read(CACHE)
}

fn read(text: &str) -> Vec<RoomReferences> {
    let mut rooms: Vec<RoomReferences> = Vec::new();
    for line in text.lines() {
        let fields: Vec<&str> = line.split(',').collect();
        let [number, _, lx, standard_error_lx, digest] = fields[..] else {
            continue;
        };
        let (Ok(number), Ok(lx), Ok(standard_error_lx)) =
            (number.parse(), lx.parse(), standard_error_lx.parse())
        else {
            continue;
        };
        let point = Reference { lx, standard_error_lx };
        match rooms.last_mut() {
            Some(last) if last.number == number => last.points.push(point),
            _ => {
                let digest = digest.to_owned();
                rooms.push(RoomReferences { number, digest, points: vec![point] });
            }
        }
    }
    rooms
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn references_come_back() {
        let point = |lx| Reference { lx, standard_error_lx: 0.25 };
        let room = |number| RoomReferences {
            number,
            digest: format!("{number}f"),
            points: vec![point(0.1 + 0.2), point(1e-7)],
        };
        let text = format!("room,point,lx,standard_error_lx,digest\n{}{}", room(3).lines(), {
            room(4).lines()
        });
        assert_eq!(read(&text), [room(3), room(4)]);
    }

    #[test]
    fn the_cache_is_of_the_rooms_that_are_made() {
        for room in references() {
            assert!(room.fit(&crate::gauntlet::room(room.number)), "room {}", room.number);
        }
    }
}
