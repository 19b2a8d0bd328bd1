//! Histograms of dimensions in the form in which they are stored, for `#[serde(with = ..)]`.

use quasilux_sampling::DimensionHistogram;
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

#[derive(Serialize, Deserialize)]
struct Stored {
    counts: Vec<u64>,
    coordinates: u128,
    largest: u32,
}

pub(crate) fn serialize<S: Serializer>(
    histogram: &DimensionHistogram,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    let counts = histogram.counts().to_vec();
    let (coordinates, largest) = (histogram.coordinates(), histogram.largest());
    Stored { counts, coordinates, largest }.serialize(serializer)
}

pub(crate) fn deserialize<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<DimensionHistogram, D::Error> {
    let Stored { counts, coordinates, largest } = Stored::deserialize(deserializer)?;
    DimensionHistogram::from_counts(counts, coordinates, largest)
        .ok_or_else(|| D::Error::custom("a histogram whose sums differ"))
}

/// Adds a histogram to another; `None` where the number of samples overflows: no other sum of them
/// is larger.
pub(crate) fn checked_add(sum: &mut DimensionHistogram, more: &DimensionHistogram) -> Option<()> {
    sum.samples().checked_add(more.samples())?;
    sum.merge(more);
    Some(())
}
