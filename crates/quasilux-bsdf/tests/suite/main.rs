//! Measured surfaces: files, tables, sampling.

mod analysis;
mod analytic;
mod astm;
mod corpus;
mod ddr;
mod format_pages;
mod from_function;
mod glazing;
mod merl;
mod radiance;
mod sampling;
mod window_xml;

use glam::DVec3;
use quasilux_bsdf::{MeasuredBsdf, read_bsdf};
use quasilux_photometry::Angles;
use std::path::PathBuf;

/// The folder of published files; `None` where the test is left out.
fn folder() -> Option<PathBuf> {
    quasilux_corpus::find("bsdf")
}

/// One published surface; `None` where the test is left out.
fn surface(file: &str) -> Option<MeasuredBsdf> {
    let bytes = std::fs::read(folder()?.join(file)).unwrap();
    Some(read_bsdf(&bytes).unwrap_or_else(|error| panic!("{file}:{error}")).bsdf)
}

/// The direction of a polar angle and an azimuth in degrees.
fn direction(theta_deg: f64, phi_deg: f64) -> DVec3 {
    Angles { theta_rad: theta_deg.to_radians(), phi_rad: phi_deg.to_radians() }.direction()
}

/// The direction of angles in degrees as a file counts them that measures the front:
/// counterclockwise as seen from there.
fn from_front(theta_deg: f64, phi_deg: f64) -> DVec3 {
    direction(theta_deg, 180.0 - phi_deg)
}
