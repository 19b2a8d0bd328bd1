//! Colours, widths and sizes of a plan.

use crate::style::{Colour, Dash, Stroke};

pub(crate) const CUT: Stroke = Stroke::solid([0x20; 3], 2.6);
pub(crate) const EDGE: Stroke = Stroke::solid([0xa4, 0xa8, 0xae], 0.9);
/// Panes from the front: their fill and their outline; the outline of openings without glass.
pub(crate) const GLASS: Colour = [0xe4, 0xf2, 0xfa];
pub(crate) const GLASS_LINE: Stroke = Stroke::solid(GLASS_INK, 1.2);
pub(crate) const OPENING_LINE: Stroke =
    Stroke { colour: GLASS_INK, width_px: 1.2, dash: Dash::Dashed };
/// Windows as lines: the faces of the wall, the gap between them, and the glass in it.
pub(crate) const WINDOW_WALL: Stroke = Stroke::solid([0x20; 3], 6.6);
pub(crate) const WINDOW_GAP: Stroke = Stroke::solid([255; 3], 4.4);
pub(crate) const WINDOW_GLASS: Stroke = Stroke::solid(GLASS_INK, 1.6);
pub(crate) const GLASS_INK: Colour = [0x1b, 0x7c, 0xb0];
pub(crate) const BORDER: Stroke = Stroke::solid([0xd4, 0xd7, 0xda], 1.0);
/// Shining faces: their fill and their outline.
pub(crate) const GLOW: Colour = [0xff, 0xf3, 0xa0];
pub(crate) const GLOW_LINE: Stroke = Stroke::solid([0xd8, 0xa4, 0x00], 1.4);
pub(crate) const LAMP: Colour = [0xff, 0xd7, 0x5e];
pub(crate) const LAMP_LINE: Stroke = Stroke::solid([0x8a, 0x5a, 0x00], 1.5);
/// What is wrong.
pub(crate) const FAULT: Colour = [0xc8, 0x10, 0x20];
pub(crate) const FAULT_FILL: Colour = [0xff, 0xc9, 0xc4];
pub(crate) const FAULT_LINE: Stroke = Stroke::solid(FAULT, 1.8);
pub(crate) const SENSOR: Colour = [0x00, 0x62, 0xa8];
pub(crate) const SENSOR_LINE: Stroke = Stroke::solid(SENSOR, 1.3);
pub(crate) const SENSOR_EDGE: Stroke = Stroke { colour: SENSOR, width_px: 1.6, dash: Dash::Dotted };
pub(crate) const CAMERA: Colour = [0x6a, 0x3d, 0x9a];
pub(crate) const CAMERA_LINE: Stroke = Stroke::solid(CAMERA, 1.4);
pub(crate) const CAMERA_FILL: Colour = [0xea, 0xdf, 0xf5];

/// Font size of labels in the views.
pub(crate) const LABEL_PX: f64 = 13.0;
/// Font size of the texts below.
pub(crate) const NOTE_PX: f64 = 14.0;
