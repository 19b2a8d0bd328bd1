//! One channel for grey scenes, three for coloured ones: transport is written once for both.

use quasilux_scene::{Rgb, Scene};
use std::ops::{Add, AddAssign, Mul};

/// Light or reflectance in as many channels as the scene needs.
pub(crate) trait Spectrum:
    Copy
    + std::fmt::Debug
    + Default
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + AddAssign
    + Mul<Output = Self>
    + Mul<f64, Output = Self>
{
    /// Number of channels.
    const CHANNELS: usize;
    /// The value of a triple; grey scenes hold only grey ones.
    fn from_rgb(rgb: Rgb) -> Self;
    /// The value in each channel.
    fn from_channels(value: impl FnMut(usize) -> f64) -> Self;
    /// One channel.
    fn channel(self, channel: usize) -> f64;
    /// The luminance, in the unit of the channels.
    fn luminance(self) -> f64;
    /// The largest channel.
    fn max_channel(self) -> f64;
    /// One in each channel: all lights are white.
    fn white() -> Self {
        Self::from_channels(|_| 1.0)
    }
    /// Nothing in each channel.
    fn black() -> Self {
        Self::from_channels(|_| 0.0)
    }
}

impl Spectrum for f64 {
    const CHANNELS: usize = 1;
    fn from_rgb(rgb: Rgb) -> Self {
        rgb.luminance()
    }
    fn from_channels(mut value: impl FnMut(usize) -> f64) -> Self {
        value(0)
    }
    fn channel(self, _channel: usize) -> f64 {
        self
    }
    fn luminance(self) -> f64 {
        self
    }
    fn max_channel(self) -> f64 {
        self
    }
}

impl Spectrum for Rgb {
    const CHANNELS: usize = 3;
    fn from_rgb(rgb: Rgb) -> Self {
        rgb
    }
    fn from_channels(value: impl FnMut(usize) -> f64) -> Self {
        Self(std::array::from_fn(value))
    }
    fn channel(self, channel: usize) -> f64 {
        self.0[channel]
    }
    fn luminance(self) -> f64 {
        Self::luminance(self)
    }
    fn max_channel(self) -> f64 {
        Self::max_channel(self)
    }
}

/// Whether one channel is enough for a scene: all its reflectances are grey.
pub(crate) fn is_grey(scene: &Scene) -> bool {
    scene.materials.iter().all(|material| material.bsdf.is_grey())
}
