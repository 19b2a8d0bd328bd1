//! What the hours of a year are to those who judge them: autonomy, useful illuminances, sunlight
//! and exposure, each with its interval.
//!
//! [`Calendar`] says which hours count, [`point`](PointOfHours) what one sensor point has of them,
//! and [`sensor`](SensorOfYear) what all points of a sensor have together; [`AnnualReport`] has it
//! all, for the document, the table, the spreadsheets and the pictures.

mod blinds;
mod calendar;
mod csv;
mod dimming;
mod document;
mod equinox;
mod measures;
mod picture;
mod point;
mod report;
mod sensor;
mod sun_hours;
mod table;
#[cfg(test)]
mod tests;

pub use blinds::{BlindsOfYear, GroupOfYear, RoomOfYear};
pub use calendar::{Calendar, Interval};
pub use csv::{annual_csv, hours_csv};
pub use dimming::{Dimming, EnergyOfYear};
pub use document::annual_json;
pub use equinox::EquinoxSheets;
pub use measures::Measure;
pub use picture::{AnnualMap, annual_maps, hours_png};
pub use point::{HourCounts, PointOfHours, PointSummary};
pub use report::{AnnualReport, AnnualRun, SensorPoints};
pub use sensor::{DaylightLevel, SensorOfYear, ShareOfPoints};
pub use sun_hours::{SunHours, sun_hours};
pub use table::annual_table;
