//! Light vertex connections: the sums of what virtual point lights give to all targets, in all
//! replicates.

use super::cell_tally::CellTally;
use super::cell_transfer::CellTransfer;
use super::lock;
use super::receiver::{ConnectionReceiver, Group};
use super::receiver_element::ReceiverElement;
use super::{ConnectionPlan, TallySettings};
use crate::codec::{Reader, StateError, Stored, Writer};
use crate::context::{Context, Stream};
use crate::photon::batch::{PhotonBatch, trace_photons};
use crate::photon::counts::PhotonCounts;
use crate::photon::order::PhotonOrder;
use crate::spectrum::Spectrum;
use crate::stats::tally::{Quantum, Sum};
use crate::stats::targets::Target;
use crate::stats::watch::Watch;
use rayon::prelude::*;
use std::ops::Range;
use std::sync::Mutex;

/// Targets that the same photons are connected to; others have photons of their own.
const GROUP: usize = 256;
/// Connections of a photon that cost as much as tracing it.
const CONNECTIONS_OF_A_PHOTON: u64 = 32;

/// Sums that grow with a run.
pub(crate) struct LightVertexConnections {
    pub(crate) connection: ConnectionPlan,
    elements: Vec<ReceiverElement>,
    /// Illuminance to expect at each, in lx.
    expected_lx: Vec<f64>,
    /// Terms of the Neumann series that are told apart.
    terms: usize,
    pub(super) quantum: Quantum,
    /// By group of targets and replicate; sums of target t of a group begin at `t * terms`.
    sums: Vec<Vec<Mutex<Vec<Sum>>>>,
    /// What each group of targets sees of the survey's cells, and the photons counted there.
    coarse: Option<(Vec<CellTransfer>, CellTally)>,
    /// By group and replicate: what the latter gave so far, see [`CellTally::lx`]; empty where no
    /// target of a group gets more.
    counted_lx: Vec<Vec<f64>>,
    /// Rays that it took to find out what targets see.
    pub(crate) rays: u64,
    replicates: Range<u32>,
    /// Indices so far.
    samples: u64,
    /// Of each target that gets no more, the indices that it has.
    ends: Vec<Option<u64>>,
    /// What photons that are counted had given to each of them by then, see
    /// [`Self::coarse_parts_lx`].
    settled: Vec<Option<Vec<f64>>>,
}

impl LightVertexConnections {
    pub(crate) fn new<S: Spectrum>(
        context: &Context<'_, S>,
        connection: ConnectionPlan,
        targets: &[Target],
        expected_lx: Vec<f64>,
        TallySettings { replicates, listed_terms, quantum }: TallySettings,
    ) -> Self {
        let terms = listed_terms as usize + 1;
        let elements: Vec<ReceiverElement> =
            targets.iter().map(|target| ReceiverElement::new(&context.world, target)).collect();
        let of_group = |group: &[ReceiverElement]| -> Vec<Mutex<Vec<Sum>>> {
            let zeros = || Mutex::new(vec![Sum::default(); group.len() * terms]);
            replicates.clone().map(|_| zeros()).collect()
        };
        let sums = elements.chunks(GROUP).map(of_group).collect();
        let mut rays = 0;
        let coarse = (connection.cell_photons > 0).then(|| {
            let look = |group: &[ReceiverElement]| {
                let transfer = CellTransfer::new(context, &connection, group);
                rays += transfer.rays;
                transfer
            };
            let quantum = Quantum::for_reference(context.lights.flux_lm);
            let cells = connection.places.len();
            let transfers = elements.chunks(GROUP).map(look).collect();
            (transfers, CellTally::new(cells, terms, quantum, replicates.clone()))
        });
        let (samples, ends) = (0, vec![None; targets.len()]);
        let settled = vec![None; targets.len()];
        Self {
            connection,
            elements,
            expected_lx,
            terms,
            quantum,
            sums,
            coarse,
            counted_lx: Vec::new(),
            rays,
            replicates,
            samples,
            ends,
            settled,
        }
    }

    /// The same plan without samples, in one replicate of the targets with these `numbers`.
    pub(crate) fn with_targets<S: Spectrum>(
        self,
        context: &Context<'_, S>,
        numbers: &[usize],
        targets: &[Target],
    ) -> Self {
        let expected_lx = numbers.iter().map(|number| self.expected_lx[*number]).collect();
        let targets: Vec<Target> = numbers.iter().map(|number| targets[*number]).collect();
        let tallies = TallySettings { replicates: 0..1, listed_terms: 0, quantum: self.quantum };
        Self::new(context, self.connection, &targets, expected_lx, tallies)
    }

    /// Puts what was found out before the first photon among the decisions.
    pub(crate) fn put_decisions(&self, out: &mut Writer) {
        self.connection.put(out);
        out.value(&self.expected_lx);
        let transfers = self.coarse.iter().flat_map(|(transfers, _)| transfers);
        transfers.for_each(|transfer| transfer.put(out));
    }

    /// The illuminance that the survey predicts for each target, in lx.
    pub(crate) fn predicted_lx(&self) -> &[f64] {
        &self.expected_lx
    }

    /// Indices so far.
    pub(crate) fn samples(&self) -> u64 {
        self.samples
    }

    /// Starts at this index: photons of earlier ones are summed elsewhere.
    pub(crate) fn go_to(&mut self, index: u64) {
        self.samples = index;
        self.count();
    }

    /// Declares the cell sums complete up to the photons of the indices so far.
    fn count(&mut self) {
        let Some((transfers, coarse)) = &mut self.coarse else { return };
        coarse.freeze_converged(self.samples * self.connection.cell_photons);
        let (coarse, replicates) = (&*coarse, self.replicates.len());
        let lx = |row: usize| {
            let (group, replicate) = (row / replicates, row % replicates);
            let settled = self.settled.chunks(GROUP).nth(group).unwrap_or_default();
            if settled.iter().all(Option::is_some) {
                return Vec::new();
            }
            coarse.lx(replicate, &transfers[group])
        };
        let rows = (0..transfers.len() * replicates).into_par_iter();
        self.counted_lx = rows.map(lx).collect();
    }

    /// How many photons an index has.
    pub(crate) fn photons_of_an_index(&self) -> u64 {
        self.sum_of_an_index(|_| 1)
    }

    /// How much work an index is, in photons that are not connected.
    pub(crate) fn work_of_an_index(&self) -> u64 {
        self.sum_of_an_index(|open| 1 + open / CONNECTIONS_OF_A_PHOTON)
    }

    /// Over the photons of an index: 1 for each that is counted, and for each that is connected
    /// what `connected` says of the number of targets that it is connected to.
    fn sum_of_an_index(&self, connected: impl Fn(u64) -> u64) -> u64 {
        let of_group = |ends: &[Option<u64>]| {
            let open = ends.iter().filter(|end| end.is_none()).count() as u64;
            if open == 0 { 0 } else { connected(open) }
        };
        let connected: u64 = self.ends.chunks(GROUP).map(of_group).sum();
        let counted = if connected == 0 { 0 } else { self.connection.cell_photons };
        (self.connection.photons() * connected + counted) * self.replicates.len() as u64
    }

    /// How many sums there are.
    pub(crate) fn sum_count(&self) -> usize {
        let sums = self.elements.len() * self.terms * self.replicates.len();
        let of_cells = self.coarse.as_ref().map_or(0, |(_, coarse)| coarse.sum_count());
        sums + of_cells
    }

    /// Adds the photons that belong to the indices up to `samples`, those that are connected and
    /// those that are counted; `None` when the observer stopped it.
    pub(crate) fn grow<S: Spectrum>(
        &mut self,
        context: &Context<'_, S>,
        samples: u64,
        watch: &mut Watch<'_>,
    ) -> Option<[PhotonCounts; 2]> {
        let counts = self.trace(context, samples, watch)?;
        self.go_to(samples);
        Some(counts)
    }

    /// Adds the same to the sums, which are not complete before [`Self::go_to`] says so.
    pub(crate) fn trace<S: Spectrum>(
        &mut self,
        context: &Context<'_, S>,
        samples: u64,
        watch: &mut Watch<'_>,
    ) -> Option<[PhotonCounts; 2]> {
        let photons = self.connection.photons();
        let mut counts = PhotonCounts::default();
        let mut counted = PhotonCounts::default();
        let is_needed = self.ends.iter().any(Option::is_none);
        if let (Some((_, coarse)), true) = (&mut self.coarse, is_needed) {
            let each = self.connection.cell_photons;
            let photons = self.samples * each..samples * each;
            counted = coarse.grow(context, &self.connection, photons, watch)?;
        }
        for (number, sums) in (0..).zip(&self.sums) {
            let group = self.group(number as usize);
            if group.ends.iter().all(Option::is_some) {
                continue;
            }
            let receiver = |r: u32| {
                let points = context.points(r, Stream::ConnectionPlaces(number));
                let sums = &sums[(r - self.replicates.start) as usize];
                ConnectionReceiver::new(context, &self.connection, group, points, sums)
            };
            let batch = PhotonBatch {
                stream: Stream::ConnectedPhotons(number),
                replicates: self.replicates.clone(),
                indices: self.samples * photons..samples * photons,
                order: PhotonOrder::CoherentWaves,
                lead: self.connection.lead(),
            };
            counts += trace_photons(context, &batch, receiver, watch)?;
        }
        Some([counts, counted])
    }

    /// Forgets all photons, and goes to this index.
    pub(crate) fn clear_at(&mut self, index: u64) {
        self.samples = index;
        self.sums.iter().flatten().for_each(|sums| lock(sums).fill(Sum::default()));
        self.coarse.iter().for_each(|(_, coarse)| coarse.clear());
    }

    /// Puts out the sums alone.
    pub(crate) fn put_sums(&self, out: &mut Writer) {
        self.sums.iter().flatten().for_each(|sums| lock(sums).as_slice().put(out));
        self.coarse.iter().for_each(|(_, coarse)| coarse.put(out));
    }

    /// Adds such.
    pub(crate) fn merge_sums(&mut self, from: &mut Reader<'_>) -> Result<(), StateError> {
        let mut sums = self.sums.iter().flatten();
        sums.try_for_each(|sums| lock(sums).as_mut_slice().merge_from(from))?;
        self.coarse.as_mut().map_or(Ok(()), |(_, coarse)| coarse.merge_from(from))
    }

    /// A group of targets that photons are connected to.
    pub(super) fn group(&self, number: usize) -> Group<'_> {
        let first = number * GROUP;
        let range = first..(first + GROUP).min(self.elements.len());
        Group {
            elements: &self.elements[range.clone()],
            expected_lx: &self.expected_lx[range.clone()],
            transfer: self.coarse.as_ref().map(|(transfers, _)| &transfers[number]),
            ends: &self.ends[range],
            terms: self.terms,
            quantum: self.quantum,
        }
    }

    /// Stops connecting photons to targets that have an end.
    pub(crate) fn freeze_converged(&mut self, ends: &[Option<u64>]) {
        self.ends.copy_from_slice(ends);
        // Photons that are counted go on to serve the others.
        for (target, end) in ends.iter().enumerate() {
            if end.is_some() && self.settled[target].is_none() {
                self.settled[target] = Some(self.coarse_parts_lx(target));
            }
        }
    }

    /// What photons that are counted gave to a target: in each replicate all, then each term.
    fn coarse_parts_lx(&self, target: usize) -> Vec<f64> {
        let parts = || std::iter::once(None).chain((0..self.terms).map(Some));
        let replicates = 0..self.replicates.len();
        let of_replicate = |r| parts().map(move |part| self.cells_lx(r, target, part));
        replicates.flat_map(of_replicate).collect()
    }

    /// What a target got in one replicate, in lx.
    pub(crate) fn lx(&self, replicate: usize, target: usize) -> f64 {
        self.fine_lx(replicate, target) + self.cells_lx(replicate, target, None)
    }

    /// By connected photons, less the prediction.
    pub(super) fn fine_lx(&self, replicate: usize, target: usize) -> f64 {
        // Quanta first, so that listing terms changes no bit.
        let mut sum = Sum::default();
        (0..self.terms).for_each(|term| sum += self.sum(replicate, target, term));
        self.value_lx(target, sum)
    }

    /// By photons that are counted, of one term or of all.
    pub(super) fn cells_lx(&self, replicate: usize, target: usize, term: Option<usize>) -> f64 {
        let part = term.map_or(0, |term| 1 + term);
        if let Some(parts) = &self.settled[target] {
            return parts[replicate * (1 + self.terms) + part];
        }
        let group = target / GROUP;
        let targets = (self.elements.len() - group * GROUP).min(GROUP);
        let row = self.counted_lx.get(group * self.replicates.len() + replicate);
        row.map_or(0.0, |row| row[part * targets + target % GROUP])
    }

    /// What it got of one term of the Neumann series; of the last, of all that follow too.
    pub(crate) fn term_lx(&self, replicate: usize, target: usize, term: usize) -> f64 {
        let fine_lx = self.value_lx(target, self.sum(replicate, target, term));
        fine_lx + self.cells_lx(replicate, target, Some(term))
    }

    /// What a sum of a target means so far.
    fn value_lx(&self, target: usize, sum: Sum) -> f64 {
        let samples = self.ends[target].unwrap_or(self.samples);
        let photons = (samples * self.connection.photons()).max(1) as f64;
        self.quantum.value(sum) / photons
    }

    /// Whether any replicate found light of one term.
    pub(crate) fn found_term(&self, target: usize, term: usize) -> bool {
        (0..self.replicates.len()).any(|r| {
            !self.sum(r, target, term).is_zero() || self.cells_lx(r, target, Some(term)) != 0.0
        })
    }

    /// Whether any replicate found light.
    pub(crate) fn found(&self, target: usize) -> bool {
        (0..self.terms).any(|term| self.found_term(target, term))
    }

    /// Contributions that are not in the sums.
    pub(crate) fn invalid(&self) -> u64 {
        let lists = self.sums.iter().flatten();
        let fine: u64 = lists.flat_map(|sums| lock(sums).clone()).map(|sum| sum.invalid).sum();
        fine + self.coarse.as_ref().map_or(0, |(_, coarse)| coarse.invalid())
    }

    fn sum(&self, replicate: usize, target: usize, term: usize) -> Sum {
        lock(&self.sums[target / GROUP][replicate])[target % GROUP * self.terms + term]
    }
}

impl Stored for LightVertexConnections {
    fn put(&self, out: &mut Writer) {
        self.put_sums(out);
        out.value(&self.settled);
    }

    fn merge_from(&mut self, from: &mut Reader<'_>) -> Result<(), StateError> {
        self.merge_sums(from)?;
        let length = self.replicates.len() * (1 + self.terms);
        let settled: Vec<Option<Vec<f64>>> = from.value()?;
        let fits = |parts: &Vec<f64>| parts.len() == length;
        if settled.len() != self.settled.len() || !settled.iter().flatten().all(fits) {
            return Err(StateError::Unfit("the number of terms"));
        }
        self.settled = settled;
        Ok(())
    }
}
