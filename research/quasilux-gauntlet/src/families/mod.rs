//! The families of rooms, from easy to hopeless.

mod beams;
mod bodies;
mod boxes;
mod buildings;
mod corridor;
mod cove;
mod facets;
mod holes;
mod many;
mod mirrors;
mod sky;
mod spots;
mod sun;
mod surfaces;
mod windows;

use crate::dice::Dice;
use crate::room::Room;

/// A way to make rooms.
pub(crate) struct Family {
    pub(crate) name: &'static str,
    pub(crate) make: fn(&mut Dice) -> Room,
}

/// All of them, in the order in which rooms take turns.
pub(crate) const ALL: [Family; 52] = [
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
    Family { name: "thin beams on cells", make: beams::thin_beams },
    Family { name: "dots in a recess", make: beams::dots },
    Family { name: "metal facet in a beam", make: beams::jewel },
    Family { name: "chip over metal", make: beams::chip },
    Family { name: "sun through pinholes", make: sun::pinholes },
    Family { name: "sun through a glass body", make: sun::glass_body },
    Family { name: "glass ball in a corner", make: bodies::ball },
    Family { name: "corridor with niche and screens", make: buildings::niche },
    Family { name: "white room lit through a hole", make: surfaces::lit_through_hole },
    Family { name: "light well", make: sky::well },
    Family { name: "light shelf", make: sun::shelf },
    Family { name: "light pipe", make: sky::pipe },
    Family { name: "luminous ceiling", make: surfaces::luminous_ceiling },
    Family { name: "kaleidoscope", make: facets::kaleidoscope },
    Family { name: "focusing facets", make: facets::focus },
    Family { name: "parking deck", make: buildings::parking },
    Family { name: "stairs", make: buildings::stairs },
    Family { name: "tunnel of 2 km", make: buildings::tunnel },
    Family { name: "box of millimetres", make: buildings::millimetres },
    Family { name: "glossy floor", make: surfaces::glossy_floor },
    Family { name: "close to walls and lamps", make: surfaces::close },
    Family { name: "partitions in series", make: buildings::partitions },
    Family { name: "glass slabs in series", make: bodies::slabs },
    Family { name: "keyhole and glass ball", make: bodies::keyhole_ball },
    Family { name: "mirror chip throws a beam", make: facets::thrown_beam },
    Family { name: "mirror chip shows a dot", make: facets::shown_dot },
    Family { name: "slits to the sky", make: sky::slits },
    Family { name: "door ajar to the sun", make: sun::door },
    Family { name: "corridor to the sky", make: corridor::to_the_sky },
    Family { name: "panes before the sun", make: sun::panes },
    Family { name: "blind in the sun", make: sun::blind },
    Family { name: "sun in a mirror", make: sun::mirror },
    Family { name: "skylights", make: sky::skylights },
    Family { name: "wall of mirror", make: facets::mirror_wall },
    Family { name: "facing building", make: sky::facing },
];

/// The room of this number in the family of this name; `None` where there is no such family.
#[must_use]
pub fn room_of(family: &str, number: u64) -> Option<Room> {
    let family = ALL.iter().find(|known| known.name == family)?;
    let mut dice = Dice::new(family.name, number);
    let room = (family.make)(&mut dice);
    Some(Room { number, family: family.name, parameters: dice.drawn, ..room })
}
