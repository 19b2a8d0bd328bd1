//! The families of rooms, from easy to hopeless.

mod boxes;
mod corridor;
mod cove;
mod holes;
mod many;
mod mirrors;
mod spots;
mod windows;

use super::dice::Dice;
use super::room::Room;

/// A way to make rooms.
pub(super) struct Family {
    pub(super) name: &'static str,
    pub(super) make: fn(&mut Dice) -> Room,
}

/// All of them: the family of a room is its number modulo theirs.
pub(super) const ALL: [Family; 17] = [
    Family { name: "plain box", make: boxes::plain },
    Family { name: "furnished office", make: boxes::office },
    Family { name: "corridor", make: corridor::corridor },
    Family { name: "door ajar", make: holes::door },
    Family { name: "keyhole", make: holes::keyhole },
    Family { name: "white room with a hole", make: boxes::white },
    Family { name: "louvres", make: windows::louvres },
    Family { name: "baffle and mirror", make: mirrors::baffle },
    Family { name: "mirror periscope", make: mirrors::periscope },
    Family { name: "bright beam", make: spots::beam },
    Family { name: "many luminaires", make: many::cells },
    Family { name: "five decades", make: holes::decades },
    Family { name: "cove", make: cove::cove },
    Family { name: "slit of daylight", make: windows::slit },
    Family { name: "lamp in a tube", make: spots::tube },
    Family { name: "small panel", make: spots::panel },
    Family { name: "shaft", make: windows::shaft },
];
