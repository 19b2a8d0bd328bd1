//! Which paths and walks go on.

use crate::random::Xoshiro;
use crate::vertex::Vertex;

/// The least and the most probable survival.
const SURVIVAL: [f64; 2] = [0.5, 0.97];
/// Bounces without roulette.
const SURE_BOUNCES: u32 = 2;

/// One over the probability of going on from a vertex after this many bounces, or nothing where the
/// path ends.
pub(crate) fn survive(vertex: &mut Vertex, bounces: u32, random: &mut Xoshiro) -> Option<f64> {
    if bounces <= SURE_BOUNCES {
        return Some(1.0);
    }
    // Weights of a surface's own directions are kept / ((1 - share) survival): half of what makes
    // their second moment grow keeps long paths from ruling the sum.
    let kept = vertex.scatter.kept();
    vertex.limit_share(0.5 * (1.0 - kept * kept));
    let [least, most] = SURVIVAL;
    let survival = (kept / (1.0 - vertex.share())).clamp(least, most);
    (random.uniform() < survival).then_some(1.0 / survival)
}
