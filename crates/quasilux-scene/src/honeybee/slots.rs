//! Uses of modifiers: what sets list them by.

/// Use of a modifier.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Slot {
    Wall { is_inside: bool },
    Floor { is_inside: bool },
    RoofCeiling { is_inside: bool },
    AirBoundary,
    Window,
    Skylight,
    Operable,
    InteriorWindow,
    Door { is_inside: bool, is_glass: bool },
    OverheadDoor,
    Shade { is_inside: bool },
    Context,
}
