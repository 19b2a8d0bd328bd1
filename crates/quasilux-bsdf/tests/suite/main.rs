//! Measured surfaces: files, tables, sampling.

mod analysis;
mod analytic;
mod astm;
mod corpus;
mod ddr;
mod format_pages;
mod from_function;
mod merl;
mod missing;
mod radiance;
mod sampling;
mod window_xml;

use glam::DVec3;
use quasilux_bsdf::{MeasuredBsdf, read_bsdf};
use quasilux_photometry::Angles;
use std::path::{Path, PathBuf};

/// The folder of published files, or `None`, with a line that says so.
fn folder() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/bsdf");
    if !folder.is_dir() {
        let folder = folder.display();
        crate::missing::tell(&format!("no published surfaces at {folder}: nothing compared"));
        return None;
    }
    Some(folder)
}

/// One published surface; `None` where there are no published files at all.
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
