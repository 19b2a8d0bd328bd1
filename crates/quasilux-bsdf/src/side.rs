//! The sides of a thin sheet, and the modes of scattering: reflection and transmission.

/// A side of a sheet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Side {
    /// The side that a file calls the front; the measured side of a reflection without sides.
    Front,
    /// The other side.
    Back,
}

/// Where scattered light goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Way {
    /// Back to the side that it came from.
    Reflection,
    /// To the other side.
    Transmission,
}

impl Side {
    /// Both sides.
    pub const ALL: [Self; 2] = [Self::Front, Self::Back];

    /// The other side.
    #[must_use]
    pub const fn other(self) -> Self {
        match self {
            Self::Front => Self::Back,
            Self::Back => Self::Front,
        }
    }

    /// `front` or `back`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Front => "front",
            Self::Back => "back",
        }
    }
}

impl Way {
    /// Both ways.
    pub const ALL: [Self; 2] = [Self::Reflection, Self::Transmission];

    /// `reflection` or `transmission`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Reflection => "reflection",
            Self::Transmission => "transmission",
        }
    }
}
