//! Photons as a pilot sees them: what each gives to the average of every sensor.
//!
//! Photons split in weight windows; their children draw coordinates that belong to no block.

use super::{Pilot, Points, SampleKind, SampleSource};
use crate::context::{Context, Stream};
use crate::estimator::photon_estimator::{self, Receivers};
use crate::importance::WeightWindows;
use crate::photon::receiver::{PhotonReceiver, SeenPhoton};
use crate::photon::trace::{PhotonSetup, Source, trace_photon};
use crate::settings::Settings;
use crate::spectrum::Spectrum;
use crate::world::Interaction;
use crate::world::flight::Flight;
use quasilux_sampling::Sampler;
use quasilux_scene::Scene;

/// Photons.
const SAMPLES: u64 = 1 << 14;

pub(super) struct PhotonSource<'s, S> {
    context: &'s Context<'s, S>,
    receivers: Receivers,
    windows: Option<WeightWindows>,
    /// Contributions of a photon at each counter.
    readings: Vec<Vec<Reading>>,
    sensors: usize,
}

/// Illuminance in lx that a photon adds to the average of a sensor that reads its counter.
struct Reading {
    sensor: usize,
    lx: f64,
}

/// Illuminance in lx that one photon adds to the average of each sensor.
struct PhotonReadings<'w> {
    receivers: &'w Receivers,
    readings: &'w [Vec<Reading>],
    lx: Vec<f64>,
}

impl<'s, S: Spectrum> PhotonSource<'s, S> {
    pub(super) fn new(context: &'s Context<'s, S>, scene: &Scene, settings: &Settings) -> Self {
        let receivers = Receivers::new(&context.world, scene, settings);
        let mut readings: Vec<Vec<Reading>> = Vec::new();
        readings.resize_with(receivers.counters, Vec::new);
        let sensors = scene.sensors.iter().enumerate();
        let sensors =
            sensors.flat_map(|(number, s)| std::iter::repeat_n((number, s.len()), s.len()));
        for ((sensor, points), &(counter, area_m2)) in sensors.zip(&receivers.targets) {
            let lx = context.lights.flux_lm / (area_m2 * points as f64);
            readings[counter as usize].push(Reading { sensor, lx });
        }
        let windows = photon_estimator::plan(context, scene, &receivers, settings).windows;
        Self { context, receivers, windows, readings, sensors: scene.sensors.len() }
    }
}

impl<S: Spectrum> SampleSource for PhotonSource<'_, S> {
    fn kind(&self) -> SampleKind {
        SampleKind::Photons
    }

    fn samples(&self) -> u64 {
        SAMPLES
    }

    fn trace(&self, samples: u64, points: &Points<'_>) -> Pilot {
        let points = points(Stream::Photons);
        Pilot::of_photons(samples, self.sensors, |index, counts| {
            let Self { receivers, readings, .. } = self;
            let mut found = PhotonReadings { receivers, readings, lx: vec![0.0; self.sensors] };
            let sampler = Sampler::new(&points, index);
            let setup = PhotonSetup::by_chance(Source::Lights, self.windows.as_ref());
            trace_photon(self.context, setup, sampler, &mut found, counts);
            found.lx
        })
    }
}

impl PhotonReadings<'_> {
    fn count(&mut self, counter: usize, photons: f64) {
        for reading in &self.readings[counter] {
            self.lx[reading.sensor] += photons * reading.lx;
        }
    }
}

impl<S: Spectrum> PhotonReceiver<S> for PhotonReadings<'_> {
    fn flight(&mut self, flight: &Flight, photon: &SeenPhoton<S>) {
        let &SeenPhoton { weight, .. } = photon;
        for counter in self.receivers.passed(flight) {
            self.count(counter, weight.luminance());
        }
    }

    fn landing(&mut self, at: &Interaction, photon: &SeenPhoton<S>) {
        let &SeenPhoton { weight, .. } = photon;
        if let Some(counter) = self.receivers.landed_on(at) {
            self.count(counter, weight.luminance());
        }
    }
}
