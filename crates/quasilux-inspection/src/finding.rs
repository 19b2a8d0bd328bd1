//! One thing that is probably wrong, with its place and its cure.

use glam::DVec3;
use quasilux_scene::{Places, Position};
use std::fmt;

/// Findings of one kind that are listed, where each thing may have its own.
pub(crate) const MAX_LISTED: usize = 20;

/// What was looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Check {
    /// The geometry is of an implausible size, or of another size than the project's positions.
    Units,
    /// Neither lamps nor sensors stand where the geometry is.
    GeometryElsewhere,
    /// Another axis of the geometry points up than the project says.
    UpAxis,
    /// A lamp hangs outside the geometry.
    LampOutside,
    /// A lamp hangs behind a surface that keeps its light from every sensor.
    LampBehindSurface,
    /// A lamp is in the middle of a surface, and light that starts behind it is lost.
    LampInSurface,
    /// A lamp is in a closed body.
    LampInBody,
    /// A lamp is bigger than the geometry.
    LampTooBig,
    /// Two lamps are one.
    LampTwice,
    /// The light of a file is far from that of its lamps.
    LampFlux,
    /// A lamp gives more light than it can.
    LampBright,
    /// Emitting faces look at nothing.
    EmitterLooksAway,
    /// Sensor points are outside the geometry.
    SensorOutside,
    /// Sensor points lie right behind a surface.
    SensorCovered,
    /// A run found no light at sensor points.
    SensorDark,
    /// A grid has very many points, or one.
    GridSize,
    /// A horizontal grid looks down, though nothing is above it.
    GridLooksDown,
    /// A camera is outside the geometry.
    CameraOutside,
    /// A room has holes through which light is lost.
    Hole,
    /// An opening lets no light from outside into a room.
    OpeningClosed,
    /// Two surfaces are at one place.
    CoincidentFaces,
    /// A surface reflects more than any paint.
    HighReflectance,
    /// No file describes any surface.
    DefaultReflectance,
}

impl Check {
    /// All checks.
    pub const ALL: [Self; 23] = [
        Self::Units,
        Self::GeometryElsewhere,
        Self::UpAxis,
        Self::LampOutside,
        Self::LampBehindSurface,
        Self::LampInSurface,
        Self::LampInBody,
        Self::LampTooBig,
        Self::LampTwice,
        Self::LampFlux,
        Self::LampBright,
        Self::EmitterLooksAway,
        Self::SensorOutside,
        Self::SensorCovered,
        Self::SensorDark,
        Self::GridSize,
        Self::GridLooksDown,
        Self::CameraOutside,
        Self::Hole,
        Self::OpeningClosed,
        Self::CoincidentFaces,
        Self::HighReflectance,
        Self::DefaultReflectance,
    ];

    /// The name in messages and documents.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Units => "units",
            Self::GeometryElsewhere => "geometry-elsewhere",
            Self::UpAxis => "up-axis",
            Self::LampOutside => "lamp-outside",
            Self::LampBehindSurface => "lamp-behind-surface",
            Self::LampInSurface => "lamp-in-surface",
            Self::LampInBody => "lamp-in-body",
            Self::LampTooBig => "lamp-too-big",
            Self::LampTwice => "lamp-twice",
            Self::LampFlux => "lamp-flux",
            Self::LampBright => "lamp-bright",
            Self::EmitterLooksAway => "emitter-looks-away",
            Self::SensorOutside => "sensor-outside",
            Self::SensorCovered => "sensor-covered",
            Self::SensorDark => "sensor-dark",
            Self::GridSize => "grid-size",
            Self::GridLooksDown => "grid-looks-down",
            Self::CameraOutside => "camera-outside",
            Self::Hole => "hole",
            Self::OpeningClosed => "opening-closed",
            Self::CoincidentFaces => "coincident-faces",
            Self::HighReflectance => "high-reflectance",
            Self::DefaultReflectance => "default-reflectance",
        }
    }
}

/// Something that is probably wrong.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// What was looked for.
    pub check: Check,
    /// The file to mend, as messages call it.
    pub file: String,
    /// The place in it, where there is one.
    pub place: Option<Position>,
    /// What is odd.
    pub message: String,
    /// How it is mended, if it is wrong.
    pub cure: String,
    /// Where it is in the scene, in m.
    pub position_m: Option<DVec3>,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { check, file, place, message, cure, .. } = self;
        match place {
            Some(place) => write!(f, "{file}:{place}: ")?,
            None => write!(f, "{file}: ")?,
        }
        write!(f, "{message}; {cure} [{}]", check.name())
    }
}

/// What has been found so far.
pub(crate) struct Findings<'a> {
    pub(crate) places: &'a Places,
    pub(crate) found: Vec<Finding>,
}

impl<'a> Findings<'a> {
    pub(crate) fn new(places: &'a Places) -> Self {
        Self { places, found: Vec::new() }
    }

    /// Adds a finding at a place of the project file; the answer takes a place in the scene.
    pub(crate) fn add(
        &mut self,
        check: Check,
        place: Position,
        message: String,
        cure: impl Into<String>,
    ) -> &mut Finding {
        self.found.push(Finding {
            check,
            file: self.places.file.clone(),
            place: Some(place),
            message,
            cure: cure.into(),
            position_m: None,
        });
        self.found.last_mut().expect("one was pushed")
    }

    /// Whether something of that kind was found.
    pub(crate) fn has(&self, check: Check) -> bool {
        self.found.iter().any(|finding| finding.check == check)
    }
}

impl Finding {
    pub(crate) fn at(&mut self, position_m: DVec3) {
        self.position_m = Some(position_m);
    }
}
