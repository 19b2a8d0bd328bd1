//! How good a set of points is: discrepancies, pairs of dimensions, cells, integration errors.
//!
//! All measures take points that have been written down, as a [`PointsView`]; all are exact up to
//! rounding, and none is random. Read on at [`discrepancy`] and [`star`] for the measures of a
//! whole set, at [`pairs`] for the report that finds the pair of dimensions that spoils it, and at
//! [`integrands`] for functions with known integrals.
//! ```
//! use quasilux_sampling::quality::{L2Measure, PointsView, l2_discrepancy, star_discrepancy};
//!
//! let middles: Vec<f64> = (0..16).map(|i| (f64::from(i) + 0.5) / 16.0).collect();
//! let points = PointsView::new(&middles, 1).unwrap();
//! assert_eq!(star_discrepancy(points), Some(1.0 / 32.0));
//! assert!((l2_discrepancy(points, L2Measure::Star) - 1.0 / (32.0 * 3.0_f64.sqrt())).abs() < 1e-9);
//! ```

pub mod cells;
pub mod discrepancy;
pub mod integrands;
pub mod pairs;
mod points_view;
pub mod slope;
pub mod star;

pub use cells::{CellCounts, cell_counts};
pub use discrepancy::{
    DiscrepancyTerms, Exchange, L2Measure, change_by_exchange, discrepancy_terms, l2_discrepancy,
    squared_l2_discrepancy,
};
pub use integrands::{Integrand, Roughness};
pub use pairs::{PairMeasure, PairQuality, worst_pairs};
pub use points_view::PointsView;
pub use slope::{PowerLaw, fit_power_law};
pub use star::star_discrepancy;
