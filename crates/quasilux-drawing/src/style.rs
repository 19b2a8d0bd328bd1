//! How lines and texts look: colours, strokes, dashes, anchors.

/// sRGB, 8 bits a channel.
pub type Colour = [u8; 3];

/// Okabe and Ito's colours ("Color universal design", 2008), in an order in which neighbours differ
/// in lightness too. Their yellow is left out: it cannot be seen on white.
pub const PALETTE: [Colour; 7] = [
    [0x00, 0x72, 0xb2],
    [0xd5, 0x5e, 0x00],
    [0x00, 0x9e, 0x73],
    [0xcc, 0x79, 0xa7],
    [0xe6, 0x9f, 0x00],
    [0x56, 0xb4, 0xe9],
    [0x00, 0x00, 0x00],
];

pub(crate) const WHITE: Colour = [255; 3];
/// Colour of ordinary text.
pub(crate) const INK: Colour = [0x22; 3];
/// Colour of remarks.
pub(crate) const GREY: Colour = [0x68; 3];
/// Size of ordinary text.
pub(crate) const TEXT_PX: f64 = 12.0;

/// How a line is broken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dash {
    /// Not at all.
    Solid,
    /// Long dashes.
    Dashed,
    /// Dots.
    Dotted,
    /// Dashes and dots in turn.
    DashDot,
}

impl Dash {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Solid, Self::Dashed, Self::DashDot, Self::Dotted];

    /// Lengths of dashes and gaps, in multiples of the line's width.
    pub(crate) const fn lengths(self) -> &'static [f64] {
        match self {
            Self::Solid => &[],
            Self::Dashed => &[5.0, 3.0],
            Self::Dotted => &[1.0, 2.0],
            Self::DashDot => &[6.0, 2.0, 1.0, 2.0],
        }
    }
}

/// How a line is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    /// Its colour.
    pub colour: Colour,
    /// Its width in pixels.
    pub width_px: f64,
    /// How it is broken.
    pub dash: Dash,
}

impl Stroke {
    /// An unbroken line.
    #[must_use]
    pub const fn solid(colour: Colour, width_px: f64) -> Self {
        Self { colour, width_px, dash: Dash::Solid }
    }
}

/// Which part of a text stands at its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// Its start.
    Start,
    /// Its middle.
    Middle,
    /// Its end.
    End,
}

/// How a text is written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextStyle {
    /// The font size in pixels: one em.
    pub size_px: f64,
    /// Colour of the letters.
    pub colour: Colour,
    /// Which part stands at the text's place.
    pub anchor: Anchor,
    /// Direction of the base line, a unit vector; y runs down.
    pub direction: [f64; 2],
    /// Colour of a border that sets the letters off from what they cover.
    pub halo: Option<Colour>,
}

impl TextStyle {
    /// Ordinary level text.
    #[must_use]
    pub const fn plain(anchor: Anchor) -> Self {
        Self::new(TEXT_PX, INK, anchor)
    }

    /// Level text of a size and colour.
    #[must_use]
    pub const fn new(size_px: f64, colour: Colour, anchor: Anchor) -> Self {
        Self { size_px, colour, anchor, direction: [1.0, 0.0], halo: None }
    }

    /// The same text running upward.
    #[must_use]
    pub const fn upward(self) -> Self {
        Self { direction: [0.0, -1.0], ..self }
    }
}
