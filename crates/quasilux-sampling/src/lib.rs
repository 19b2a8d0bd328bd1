//! Points in the unit cube by index, and maps from them.
//!
//! # Limits
//! - Indices have 64 bits. Sobol', the base-4 sequence and the pseudo-random points do not repeat
//!   within 2^64 points, Halton's coordinates under shift or scrambling within 2^51; nothing folds
//!   at 2^16. Coordinates have 53 bits (Halton's under shift or scrambling 51 or more): more points
//!   than that share some, as do Halton's unrandomised ones from 2^42 points on in its large bases.
//! - Sobol' has 1024 dimensions of Joe and Kuo's, the base-4 sequence 4. Past them come
//!   independently shuffled and scrambled copies, at about half the speed and without the evenness
//!   of pairs across copies. Halton has 1024 bases; past them dimensions are pseudo-random. No
//!   dimension is refused.
//! - Use 2^m points of Sobol' and 4^m of the base-4 sequence, from the first on; other counts lose
//!   the gain over N^-1. Of Hammersley's N points use all N.
//! - [`Randomization::None`] says nothing about its error. Take several replicates, each under its
//!   own key, and their spread; never the spread of the points within one.
//! - Owen scrambling is by hashing: the flips of the first four digits and all pairs of points,
//!   hence variances, are as under exact nested scrambling as far as tests can see; the joint
//!   distribution of many points is not.
//! - [`PointSet::fill`] is about ten times as fast as [`PointSet::coordinate`] for matrices over
//!   bits and scrambled points, and [`PointSet::fill_at`] lies between; for Halton they are no
//!   faster.
//!
//! # Which sequence
//! Owen-scrambled Sobol' unless there is a reason: on a photon's emission (4 coordinates, 4096
//! photons, all scrambled) the root mean square error of the base-4 sequence is within 0.9 and 1.15
//! times that of Sobol', which is all that the test resolves; of Halton 1.1 (a jump) to 2.4 times
//! (smooth), of Hammersley 1.0 to 2.0, of pseudo-random points 2.4 to 39.
//!
//! # Use
//! ```
//! use quasilux_sampling::{PointSet, Randomization, Sampler, Sequence, stream_key};
//!
//! let points = PointSet::new(Sequence::Sobol, Randomization::Owen, stream_key(1, 0, 0));
//! let mut sampler = Sampler::new(&points, 12_345);
//! let (u, [v, w]) = (sampler.next_1d(), sampler.next_2d());
//!
//! assert_eq!([u, v, w], [0, 1, 2].map(|dimension| points.coordinate(12_345, dimension)));
//! assert_eq!(sampler.used(), 3);
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
//! # Many points at once, and in another order
//! ```
//! use quasilux_sampling::{CoherentGroups, PointSet, Randomization, Sequence, stream_key};
//!
//! let points = PointSet::new(Sequence::Halton, Randomization::Owen, stream_key(1, 0, 0));
//! let mut column = vec![0.0; 4096];
//! points.fill(0, 0, &mut column);
//!
//! // Photons that start close together, in groups of at least 32.
//! let groups = CoherentGroups::with_size(&points, 4096, &[0, 1, 2], 32).unwrap();
//! let order: Vec<u64> = groups.indices().collect();
//! assert_eq!(order.len(), 4096);
//! assert!(groups.spreads(&points, 0).iter().zip(groups.bounds()).all(|(s, b)| *s < b));
//! ```
//!
//! # From coordinates to choices and directions
//! A discrete choice gives back what it did not use of its coordinate, so that one coordinate
//! serves several choices:
//! ```
//! use quasilux_sampling::{Discrete, choose_bool, warp};
//!
//! let lights = Discrete::new(&[100.0, 300.0]).unwrap();
//! let light = lights.sample(0.625);
//! assert_eq!((light.index, light.u_remapped), (1, 0.5));
//! assert!(!choose_bool(light.u_remapped, 0.5).value);
//!
//! let direction = warp::sample_uniform_sphere([0.5, 0.0]);
//! assert_eq!(direction, [1.0, 0.0, 0.0]);
//! ```

pub mod assignment;
mod block;
mod discrete;
mod discrete_sample;
mod groups;
mod hash;
mod histogram;
mod parse_name_error;
mod point_set;
pub mod quality;
mod randomization;
mod sampler;
mod sensitivity;
mod sequence;
mod unit;
mod variation;
pub mod warp;

pub use block::RowRandomizer;
pub use discrete::Discrete;
pub use discrete_sample::{BoolSample, DiscreteSample, choose_bool, choose_weights};
pub use groups::{CoherentGroups, Group, SharedDigits};
pub use hash::stream_key;
pub use histogram::DimensionHistogram;
pub use parse_name_error::ParseNameError;
pub use point_set::PointSet;
pub use randomization::Randomization;
pub use sampler::Sampler;
pub use sequence::{Sequence, radical_inverse, sobol_columns};
