//! Contributions of single photons to connected sensors, for the analysis of variance.

use super::ConnectionPlan;
use super::cell_transfer::CellTransfer;
use super::exitant_flux::ExitantFlux;
use super::light_vertices::LightVertexConnections;
use super::lock;
use super::receiver::{ConnectionReceiver, Group, Seen};
use crate::context::Context;
use crate::photon::counts::PhotonCounts;
use crate::photon::receiver::{PhotonReceiver, SeenPhoton};
use crate::photon::trace::trace_photon;
use crate::purpose::Purpose;
use crate::spectrum::Spectrum;
use crate::stats::tally::Sum;
use crate::world::Interaction;
use quasilux_sampling::{PointSet, Sampler};
use std::sync::Mutex;

/// Gathers what all targets of a group are expected to see of one photon, in lx.
struct Expected<'a, S> {
    context: &'a Context<'a, S>,
    connection: &'a ConnectionPlan,
    transfer: &'a CellTransfer,
    at_once_lx: Vec<f64>,
    lx: Vec<f64>,
}

impl LightVertexConnections {
    /// What the targets of the first group get from a photon that is counted, in lx.
    pub(crate) fn of_counted_lx<S: Spectrum>(
        &self,
        context: &Context<'_, S>,
        sampler: Sampler<'_>,
        counts: &mut PhotonCounts,
    ) -> Vec<f64> {
        let Group { elements, transfer, .. } = self.group(0);
        let zeros = vec![0.0; elements.len()];
        let Some(transfer) = transfer else { return zeros };
        let (at_once_lx, lx) = (zeros.clone(), zeros);
        let mut receiver =
            Expected { context, connection: &self.connection, transfer, at_once_lx, lx };
        trace_photon(context, self.connection.lead(), sampler, &mut receiver, counts);
        receiver.lx
    }

    /// What they get from a photon that is connected, in lx, beyond what was expected of it;
    /// `places` has the coordinates of its connections.
    pub(crate) fn of_connected_lx<S: Spectrum>(
        &self,
        context: &Context<'_, S>,
        sampler: Sampler<'_>,
        places: PointSet,
        counts: &mut PhotonCounts,
    ) -> Vec<f64> {
        // Noted here once: the receiver draws them anew for each flight.
        if context.purposes.is_recording() {
            context.draw(&mut Seen::sampler(&sampler, &places), Purpose::Connections, Seen::draw);
        }
        let group = self.group(0);
        let sums = Mutex::new(vec![Sum::default(); group.elements.len() * group.terms]);
        let mut receiver = ConnectionReceiver::new(context, &self.connection, group, places, &sums);
        trace_photon(context, self.connection.lead(), sampler, &mut receiver, counts);
        counts.rays += receiver.finish().rays;
        let sums = lock(&sums);
        let of_target = |sums: &[Sum]| sums.iter().map(|sum| self.quantum.value(*sum)).sum();
        sums.chunks(group.terms).map(of_target).collect()
    }
}

impl<S: Spectrum> PhotonReceiver<S> for Expected<'_, S> {
    fn landing(&mut self, at: &Interaction, photon: &SeenPhoton<S>) {
        let &SeenPhoton { weight, bounces, .. } = photon;
        let leaving = ExitantFlux::new(self.context, self.connection, at, weight, bounces);
        let Some(leaving) = leaving else { return };
        self.transfer.predict(&leaving, bounces == 0, &mut self.at_once_lx);
        self.lx.iter_mut().zip(&self.at_once_lx).for_each(|(sum, lx)| *sum += lx);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::context::Stream;
    use crate::estimator::exact::exact;
    use crate::estimator::pilot::Request;
    use crate::estimator::selection::{Decision, decide};
    use crate::scenes::{diffuse, level_grid, point_light, points, room};
    use crate::settings::{EstimatorKind, Settings, Switch};
    use crate::stats::tally::Quantum;
    use crate::stats::targets::targets;
    use crate::stats::watch::Watch;
    use glam::DVec3;

    /// One photon after another gives what all of them give at once, at a point and in cells.
    #[test]
    fn photons_by_themselves_add_up_to_all() {
        let mut scene = room(DVec3::new(4.0, 3.0, 2.5), diffuse(0.7));
        scene.lights.push(point_light(DVec3::new(2.0, 1.5, 2.0), 100.0));
        scene.sensors.push(points("desk", &[(DVec3::new(1.0, 1.2, 0.8), DVec3::Z)]));
        scene.sensors.push(level_grid(DVec3::new(0.5, 0.5, 0.1), [3.0, 2.0], [3, 2]));
        let (connections, estimator) = (Switch::On, EstimatorKind::Selected);
        let settings = Settings { connections, estimator, ..Settings::default() };
        let context = Context::<f64>::new(&scene, &settings);
        let all = targets(&scene);
        let exact = exact(&context, &all, &mut 0);
        let quantum = Quantum::for_reference(100.0);
        let mut observer = ();
        let mut watch = Watch::new(&mut observer);
        let (settings, exact, targets) = (&settings, exact.as_slice(), all.as_slice());
        let request = Request { settings, replicates: 1, targets, exact, quantum };
        let Decision { light_vertices, .. } = decide(&context, &request, &mut watch);
        let light_vertices = light_vertices.expect("it was asked for");
        let numbers = [0, 2, 5];
        let mut light_vertices = light_vertices.with_targets(&context, &numbers, targets);
        let samples = 16;
        let [of_connected, of_counted] =
            light_vertices.grow(&context, samples, &mut watch).expect("it ends");

        let points = |stream| context.points(0, stream);
        let [counted, fine] = [Stream::CellPhotons, Stream::ConnectedPhotons(0)].map(points);
        let places = points(Stream::ConnectionPlaces(0));
        let [mut counts, mut counts_of_connected] = [(); 2].map(|()| PhotonCounts::default());
        let cell_photons = light_vertices.connection.cell_photons() * samples;
        let photons = light_vertices.connection.photons() * samples;
        let mut means_lx = [[0.0; 2]; 3];
        for index in 0..cell_photons {
            let sampler = Sampler::new(&counted, index);
            let lx = light_vertices.of_counted_lx(&context, sampler, &mut counts);
            let means = means_lx.iter_mut().zip(lx);
            means.for_each(|(mean, lx)| mean[0] += lx / cell_photons as f64);
        }
        for index in 0..photons {
            let sampler = Sampler::new(&fine, index);
            let lx =
                light_vertices.of_connected_lx(&context, sampler, places, &mut counts_of_connected);
            let means = means_lx.iter_mut().zip(lx);
            means.for_each(|(mean, lx)| mean[1] += lx / photons as f64);
        }
        assert_eq!([counts_of_connected.rays, counts.rays], [of_connected.rays, of_counted.rays]);
        for (target, [by_cells_lx, beyond_lx]) in means_lx.into_iter().enumerate() {
            let all_at_once =
                [light_vertices.cells_lx(0, target, None), light_vertices.fine_lx(0, target)];
            assert!(all_at_once[0] > 1.0 && all_at_once[1] != 0.0, "{all_at_once:?}");
            for (one_by_one, at_once) in [by_cells_lx, beyond_lx].into_iter().zip(all_at_once) {
                assert!((one_by_one - at_once).abs() < 1e-6, "{one_by_one}, at once {at_once}");
            }
        }
    }
}
