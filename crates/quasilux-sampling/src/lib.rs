//! Points in the unit cube by index, and maps from them.
//!
//! # Limits
//! - Indices have 64 bits and nothing folds: no sequence repeats within 2^64 points. Coordinates
//!   have 53 bits.
//! - Sobol' has 1024 dimensions of Joe and Kuo's. Past them come independently shuffled and
//!   scrambled copies, at about half the speed and without the evenness of pairs across copies; no
//!   dimension is refused.
//! - Use 2^m points of Sobol', from the first on; other counts lose the gain over N^-1.
//! - [`Randomization::None`] says nothing about its error. Take several replicates, each under its
//!   own key, and their spread; never the spread of the points within one.
//! - Owen scrambling is by hashing: pairs of points, and hence variances, are as under exact nested
//!   scrambling as far as tests can see; the joint distribution of many points is not.
//!
//! # Use
//! ```
//! use quasilux_sampling::{PointSet, Randomization, SampleCursor, Sequence, stream_key};
//!
//! let points = PointSet::new(Sequence::Sobol, Randomization::Owen, stream_key(1, 0, 0));
//! let mut cursor = SampleCursor::new(&points, 12_345);
//! let (u, [v, w]) = (cursor.next_1d(), cursor.next_2d());
//!
//! assert_eq!([u, v, w], [0, 1, 2].map(|dimension| points.coordinate(12_345, dimension)));
//! assert_eq!(cursor.used(), 3);
//! ```
//! A coordinate is a pure function of the point set, the index and the dimension, the same on every
//! machine. There is no state to carry or to share, so threads may take the indices in any order.
//!
//! # Seeding
//! [`stream_key`] makes one key from the user's seed, the number of the replicate, and a number for
//! each stream that must be independent:
//! ```
//! use quasilux_sampling::{PointSet, Randomization, Sequence, stream_key};
//!
//! let mean = |replicate| {
//!     let key = stream_key(1, replicate, 0);
//!     let points = PointSet::new(Sequence::Sobol, Randomization::Owen, key);
//!     let value = |index| points.coordinate(index, 0) * points.coordinate(index, 1);
//!     (0..1024).map(value).sum::<f64>() / 1024.0
//! };
//! let means: Vec<f64> = (0..8).map(mean).collect();
//! assert!(means.iter().all(|mean| (mean - 0.25).abs() < 1e-4));
//! assert!(means.windows(2).all(|pair| pair[0] != pair[1]));
//! ```
//!
//! # From coordinates to choices and directions
//! A discrete choice gives back what it did not use of its coordinate, so that one coordinate
//! serves several choices:
//! ```
//! use quasilux_sampling::{Discrete, choose_bool, warp};
//!
//! let lights = Discrete::new(&[100.0, 300.0]).unwrap();
//! let light = lights.choose(0.625);
//! assert_eq!((light.index, light.rest), (1, 0.5));
//! assert!(!choose_bool(light.rest, 0.5).value);
//!
//! let direction = warp::sample_uniform_sphere([0.5, 0.0]);
//! assert_eq!(direction, [1.0, 0.0, 0.0]);
//! ```

pub mod assignment;
mod block;
mod choice;
mod cursor;
mod discrete;
mod groups;
mod hash;
mod histogram;
mod point_set;
pub mod quality;
mod randomization;
mod sequence;
mod unit;
pub mod warp;

pub use choice::{BoolChoice, Choice, choose_bool, choose_weights};
pub use cursor::SampleCursor;
pub use discrete::Discrete;
pub use groups::{CoherentGroups, Group, SharedDigits};
pub use hash::stream_key;
pub use histogram::DimensionHistogram;
pub use point_set::PointSet;
pub use randomization::Randomization;
pub use sequence::{Sequence, radical_inverse};

pub(crate) use unit::ONE_BELOW;
