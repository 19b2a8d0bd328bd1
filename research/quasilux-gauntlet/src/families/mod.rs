//! The families of rooms, from easy to hopeless.

mod boxes;
mod corridor;
mod cove;
mod holes;
mod many;
mod mirrors;
mod spots;
mod windows;

use crate::dice::Dice;
use crate::room::{Room, Witness};

/// A way to make rooms.
pub(crate) struct Family {
    pub(crate) name: &'static str,
    pub(crate) make: fn(&mut Dice) -> Room,
    /// What the reference relies on.
    pub(crate) witness: Witness,
}

/// All of them, in the order in which rooms take turns.
pub(crate) const ALL: [Family; 17] = [
    Family { name: "plain box", make: boxes::plain, witness: Witness::Paths },
    Family { name: "furnished office", make: boxes::office, witness: Witness::Paths },
    Family { name: "corridor", make: corridor::corridor, witness: Witness::ToldPaths },
    Family { name: "door ajar", make: holes::door, witness: Witness::ToldPaths },
    Family { name: "keyhole", make: holes::keyhole, witness: Witness::ToldPaths },
    Family { name: "white room with a hole", make: boxes::white, witness: Witness::Paths },
    Family { name: "louvres", make: windows::louvres, witness: Witness::ToldPaths },
    Family { name: "baffle and mirror", make: mirrors::baffle, witness: Witness::ToldPaths },
    Family { name: "mirror periscope", make: mirrors::periscope, witness: Witness::ToldPaths },
    Family { name: "bright beam", make: spots::beam, witness: Witness::ToldPaths },
    Family { name: "many luminaires", make: many::cells, witness: Witness::ToldPaths },
    Family { name: "five decades", make: holes::decades, witness: Witness::ToldPaths },
    Family { name: "cove", make: cove::cove, witness: Witness::ToldPaths },
    Family { name: "slit of daylight", make: windows::slit, witness: Witness::ToldPaths },
    Family { name: "lamp in a tube", make: spots::tube, witness: Witness::ToldPaths },
    Family { name: "small panel", make: spots::panel, witness: Witness::Paths },
    Family { name: "shaft", make: windows::shaft, witness: Witness::ToldPaths },
];
