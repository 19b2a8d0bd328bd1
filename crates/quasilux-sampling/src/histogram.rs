//! How many coordinates samples consume.

/// The distribution of the constructive dimension of many samples, in integers: histograms of parts
/// merge to the histogram of the whole in any order.
///
/// The mean is the *constructive dimension* of I. M. Sobol': what a quasi-Monte Carlo method must
/// spread evenly.
/// ```
/// use quasilux_sampling::DimensionHistogram;
/// let (mut one, mut other) = (DimensionHistogram::new(), DimensionHistogram::new());
/// one.record(2);
/// other.record(7);
/// one.merge(&other);
/// assert_eq!((one.samples(), one.mean(), one.count(7)), (2, 4.5, 1));
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct DimensionHistogram {
    counts: Vec<u64>,
    samples: u64,
    coordinates: u128,
    largest: u32,
}

impl DimensionHistogram {
    /// Samples that consumed more are counted together.
    pub const LAST: u32 = 1023;

    /// No samples.
    #[must_use]
    pub const fn new() -> Self {
        Self { counts: Vec::new(), samples: 0, coordinates: 0, largest: 0 }
    }

    /// Adds a sample that consumed `used` coordinates.
    pub fn record(&mut self, used: u32) {
        let bin = used.min(Self::LAST + 1) as usize;
        if bin >= self.counts.len() {
            self.counts.resize(bin + 1, 0);
        }
        self.counts[bin] += 1;
        self.samples += 1;
        self.coordinates += u128::from(used);
        self.largest = self.largest.max(used);
    }

    /// Adds the samples of another histogram.
    pub fn merge(&mut self, other: &Self) {
        if other.counts.len() > self.counts.len() {
            self.counts.resize(other.counts.len(), 0);
        }
        for (count, other) in self.counts.iter_mut().zip(&other.counts) {
            *count += other;
        }
        self.samples += other.samples;
        self.coordinates += other.coordinates;
        self.largest = self.largest.max(other.largest);
    }

    /// The number of samples.
    #[must_use]
    pub const fn samples(&self) -> u64 {
        self.samples
    }

    /// The mean number of coordinates of a sample; 0 without samples.
    #[must_use]
    pub fn mean(&self) -> f64 {
        if self.samples == 0 { 0.0 } else { self.coordinates as f64 / self.samples as f64 }
    }

    /// The most coordinates that one sample consumed.
    #[must_use]
    pub const fn largest(&self) -> u32 {
        self.largest
    }

    /// How many samples consumed exactly `used` coordinates; past [`LAST`](Self::LAST), how many
    /// consumed more than that.
    #[must_use]
    pub fn count(&self, used: u32) -> u64 {
        self.counts.get(used.min(Self::LAST + 1) as usize).copied().unwrap_or(0)
    }

    /// The counts of 0, 1, 2, .. coordinates up to the largest; the last of more than
    /// [`LAST`](Self::LAST) + 1 is of all that consumed more.
    #[must_use]
    pub fn counts(&self) -> &[u64] {
        &self.counts
    }
}
