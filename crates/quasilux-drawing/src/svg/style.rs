//! How lines and text look.

/// Okabe and Ito's colours ("Color universal design", 2008), in an order in which neighbours differ
/// in lightness too. Their yellow is left out: it cannot be seen on white.
pub const PALETTE: [&str; 7] =
    ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"];

pub(super) const INK: &str = "#222222";
pub(super) const FAINT: &str = "#e4e4e4";
pub(super) const GREY: &str = "#767676";
pub(super) const FONT: &str = "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif";
/// Size of ordinary text.
pub(super) const TEXT_PX: f64 = 12.0;

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
    pub(super) const fn lengths(self) -> &'static [f64] {
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
    /// A colour as SVG writes it.
    pub colour: &'static str,
    /// Its width.
    pub width_px: f64,
    /// How it is broken.
    pub dash: Dash,
}

impl Stroke {
    /// An unbroken line.
    #[must_use]
    pub const fn solid(colour: &'static str, width_px: f64) -> Self {
        Self { colour, width_px, dash: Dash::Solid }
    }
}

/// Which part of a text is at its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// Its start.
    Start,
    /// Its middle.
    Middle,
    /// Its end.
    End,
}

impl Anchor {
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Start => "start",
            Self::Middle => "middle",
            Self::End => "end",
        }
    }
}

/// How a text is written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextStyle {
    /// Height of the letters, as fonts measure it.
    pub size_px: f64,
    /// A colour as SVG writes it.
    pub colour: &'static str,
    /// Which part is at the text's place.
    pub anchor: Anchor,
    /// Whether it runs upwards.
    pub upwards: bool,
}

impl TextStyle {
    /// Ordinary text.
    #[must_use]
    pub const fn plain(anchor: Anchor) -> Self {
        Self { size_px: TEXT_PX, colour: INK, anchor, upwards: false }
    }
}
