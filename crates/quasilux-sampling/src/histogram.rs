//! The histogram of the number of coordinates that samples consume.

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

    /// The histogram with these [`counts`](Self::counts), [`coordinates`](Self::coordinates) and
    /// [`largest`](Self::largest); `None` where no samples have them.
    #[must_use]
    pub fn from_counts(counts: Vec<u64>, coordinates: u128, largest: u32) -> Option<Self> {
        let samples = counts.iter().try_fold(0_u64, |sum, count| sum.checked_add(*count))?;
        let Some((last, before)) = counts.split_last() else {
            return (coordinates == 0 && largest == 0).then(Self::new);
        };
        let bin = u32::try_from(before.len()).ok().filter(|bin| *bin <= Self::LAST + 1)?;
        let is_last_fine = *last > 0 && largest.min(Self::LAST + 1) == bin;
        let least = counts.iter().zip(0_u128..).map(|(count, used)| u128::from(*count) * used);
        let least = least.sum::<u128>();
        let most = least + u128::from(*last) * u128::from(largest - bin.min(largest));
        let are_coordinates_fine = (least..=most).contains(&coordinates);
        (is_last_fine && are_coordinates_fine).then_some(Self {
            counts,
            samples,
            coordinates,
            largest,
        })
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

    /// The number of coordinates that all samples consumed together.
    #[must_use]
    pub const fn coordinates(&self) -> u128 {
        self.coordinates
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

    /// This many coordinates are enough for this share of the samples, up to [`LAST`](Self::LAST) +
    /// 1; 0 without samples.
    #[must_use]
    pub fn quantile(&self, share: f64) -> u32 {
        let wanted = share * self.samples as f64;
        let mut reached = 0;
        let enough = self.counts.iter().position(|count| {
            reached += count;
            reached as f64 >= wanted
        });
        enough.map_or(0, |used| used as u32)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_of_the_samples() {
        let mut histogram = DimensionHistogram::new();
        assert_eq!(histogram.quantile(0.5), 0);
        [2, 2, 4, 6, 6, 6, 8, 10, 10, 3000].into_iter().for_each(|used| histogram.record(used));
        assert_eq!([0.0, 0.2, 0.5, 0.9, 1.0].map(|q| histogram.quantile(q)), [0, 2, 6, 10, 1024]);
    }

    #[test]
    fn histograms_come_back_from_their_counts_and_others_do_not() {
        let mut histogram = DimensionHistogram::new();
        let again = |h: &DimensionHistogram| {
            DimensionHistogram::from_counts(h.counts().to_vec(), h.coordinates(), h.largest())
        };
        assert_eq!(again(&histogram), Some(histogram.clone()));
        for used in [3, 0, 7, 7, 1023, 1024, 5000, 3] {
            histogram.record(used);
            assert_eq!(again(&histogram), Some(histogram.clone()));
        }
        let of = |counts: &[u64], coordinates, largest| {
            DimensionHistogram::from_counts(counts.to_vec(), coordinates, largest)
        };
        assert!(of(&[0, 2], 2, 1).is_some());
        assert_eq!(of(&[0, 2], 3, 1), None, "too many coordinates");
        assert_eq!(of(&[0, 2], 2, 2), None, "another largest");
        assert_eq!(of(&[0, 2, 0], 2, 1), None, "an empty end");
        assert_eq!(of(&[1, u64::MAX], u128::from(u64::MAX), 1), None, "too many samples");
        assert_eq!(of(&[0; 1026], 0, 0), None, "too long");
    }
}
