//! Contribution of one path, split into direct and indirect light and into terms of the Neumann
//! series.

use crate::path::daylight::FromOutside;
use crate::spectrum::Spectrum;

/// Light that one path found: illuminance in lx or luminance in cd/m^2, as its start wants.
#[derive(Clone, Debug, Default)]
pub(crate) struct PathContribution<S> {
    /// Straight from the lights; of the point-like ones only where the start asks for it.
    pub(crate) direct: S,
    /// After at least one bounce.
    pub(crate) indirect: S,
    /// Both by the number of bounces, the last all from there on; empty where terms are not listed.
    pub(crate) terms: Vec<S>,
    /// Whether the path came to a surface where there may be indirect light that it can find.
    pub(crate) reflected: bool,
    /// Whether it was cut on its way.
    pub(crate) endless: bool,
    /// Light from outside, where that is kept apart by direction; not in the sums above.
    pub(crate) from_outside: Vec<FromOutside>,
}

impl<S: Spectrum> PathContribution<S> {
    /// Adds light that arrives at the vertex after `bounces` reflections, or that the ray from
    /// there runs into.
    pub(crate) fn add(&mut self, bounces: u32, light: S) {
        *if bounces == 0 { &mut self.direct } else { &mut self.indirect } += light;
        self.add_to_term(bounces, light);
    }

    /// Adds light to its term alone.
    pub(crate) fn add_to_term(&mut self, bounces: u32, light: S) {
        if let Some(rest) = self.terms.len().checked_sub(1) {
            self.terms[rest.min(bounces as usize)] += light;
        }
    }

    /// Keeps the first terms apart, and the rest.
    pub(crate) fn list_terms(&mut self, listed: u32) {
        if listed > 0 {
            self.terms = vec![S::black(); listed as usize + 1];
        }
    }
}
