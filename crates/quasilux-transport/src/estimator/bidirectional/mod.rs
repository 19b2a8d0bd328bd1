//! Bidirectional paths whose light subpaths serve all targets, and the bound on light that no
//! sample met (`docs/unseen.md`).
//!
//! For each index a target gets one eye path, and the index `M` light subpaths, photons of all
//! lights. A path from a light over the surfaces `x_1 .. x_k` to the target `x_0` is made by up to
//! `k + 3` techniques. Each counts `f / (sum n_i p_i)`, the balance heuristic (Veach and Guibas
//! 1995) over the densities `p_i` of all that can make the path, with the numbers `n_i` of their
//! samples for an index; so no sample adds more than any technique alone would at its worst. All
//! densities and numbers are functions of the path and of what was fixed before the first sample
//! (`plan`), so weights add up to one.
//!
//! With `E_j` the density in m^-2 with which eye paths make `x_1 .. x_j`, `L_j` that with which
//! light subpaths make `x_k .. x_j`:
//!
//! | technique | density | samples for an index | where |
//! |---|---|---|---|
//! | eye path asks for light | `E_k a`, a the choice of the lamp, of the place on it, of the direction to the sky or the sun | 1 | `eye_path` |
//! | eye path runs into a facet, the sky or the sun | `E_k b`, b the density of its direction | 1 | `eye_path` |
//! | eye path joined to a light vertex between | `E_j L_(j + 1)` | 1/4 | `eye_path` |
//! | light vertex joined to the target | `L_1` | `M q`, q by cosines over squared distance | `joins` |
//! | photon crosses the disc or cell of area A | `A L_1 l`, l the density of landing there | 1, or `M` where `x_1` is narrow and eye paths hardly meet the light | `counters` |
//!
//! Where what leaves a surface matters more to the sensors, light subpaths go on from it in more
//! copies, by a survey of the scene ([`Copies`]): their number `C(x)` is a function of the place
//! alone, a power of two, 1 at lights. So `L_j` has the factor `C(x_(j + 1))`, which eye paths know
//! as well; each copy carries as much less.
//!
//! Where surfaces outside hide the sky from openings, a part of the eye paths is led through these
//! (`leading`), by a survey as well.
//!
//! A surface makes the next vertex with `min(pdf, f cos)`: roulette is part of the density
//! ([`crate::bsdf::Bsdf::survival_pdf_sr`]). The first two of an eye path make it with `min(pdf, 2
//! f cos)` (`plan::favour`, `light_weights`). A lamp is left with half of its share of the flux and
//! an even half (`sources`), an emitting facet by its flux; lines from outside have the density of
//! [`crate::lights::Lights::ways_in`]. Vertices of mirrors and glass are joined to nothing. Panes
//! that let light straight through are no vertices: the edge goes on behind them, and what they
//! reflect of it counts in no density. Light of lamps without extent is computed at points, and
//! over the mirrors that show it there. Surfaces ask for it over plane mirrors as well
//! (`lights::images`), and all vertices for emitting facets (`mirrored_way`).
//!
//! The disc is smaller for light straight from lights with an area near by, whose illuminance
//! changes over it: its radius is a sixteenth of the distance of the nearest at most. Near
//! one lamp alone, values were off by 2 to 4 parts in 10^4 with an eighth, and are by half of one.
//!
//! A photon counts as one for each eye path in weights, however many there are, but where the last
//! surface sends much into few directions: the little that it blurs, and the noise of photons,
//! would else be a large part of ordinary light.
//!
//! The most that a sample of technique i can add is bounded over classes of paths by caps on `f /
//! p_i` (`caps`, `supremum`, `peaks`, `intensities`):
//!
//! | technique | cap of `f / p_i` | cannot make |
//! |---|---|---|
//! | asks a lamp without extent, one of few | `pi f_r` x the sum of illuminances / 0.9 | specular at the lamp |
//! | asks the sun | `pi f_r` x its illuminance | specular at the sun |
//! | asks or runs into facets, sky | `pi` x the largest luminance | |
//! | joined to the target | flux / share x `f_r` x cosines over squared distance / q | specular last |
//! | disc, cell | flux / share / A | |
//!
//! What luminaires with an area give straight to points is bounded as it is asked for
//! (`asked_luminaires`); else they and lamps chosen from a table by joins and photons alone. Of
//! metal and coats `f_r` with its cosine is `1 / (2 pi alpha^3)` at the horizon, less where the
//! direction is known (`peaks`). Of measured materials and of the sky suprema are looked up on
//! grids, with a margin: all others are never too low. Samples are asserted to stay below caps, and
//! `caps::search` looks for paths that pass them. For K, the samples that a subpath may have, see
//! `samples`, and [`caps::Caps`] for what follows.
//!
//! Read on at `unit`, which traces all of this for some indices, and `estimator`.

mod arrival;
mod asked_luminaires;
mod boxes;
mod caps;
mod counters;
mod departure;
mod engine;
mod estimator;
mod eye_path;
mod flux_tally;
mod intensities;
mod join_places;
mod join_rate;
mod joins;
mod leading;
mod light_subpath;
mod light_weights;
mod mirrored_way;
mod nearest_emitter;
mod partner;
mod peaks;
mod pixels;
mod plan;
mod progress;
mod samples;
mod sources;
mod subpath_weights;
mod sums;
mod supremum;
mod surveyed;
mod unit;

#[cfg(doc)]
use crate::importance::Copies;
pub(crate) use estimator::BidirectionalEstimator;
pub(crate) use eye_path::Sink;
pub(crate) use pixels::{MAX_PHOTONS, PictureLight, PixelSink, PixelTracer, PixelUnit};
