//! Survival probability of paths on a frozen map, by the error of the map that a pilot found.

use crate::codec::Writer;

/// Paths go on with this probability at least, so that no survivor counts too much.
pub(crate) const MIN: f64 = 1.0 / 64.0;
/// Lower bound on the map's light, in parts of the mean: it may have missed something.
const DIM: f64 = 0.1;
/// What is known of all elements counts in each as much as this many paths of its own, of usual
/// light.
const PRIOR: f64 = 16.0;

/// Errors of a map by element, and the survival probability that follows.
#[derive(Clone, Debug)]
pub(crate) struct Survival {
    /// Probability for each unit of what would be lost.
    sureness: f64,
    /// Illuminance where paths come to the map: what they find, or what it has where that is more.
    mean_lx: f64,
    /// Root mean square of what paths find beyond a surface less what the map has, over what it
    /// has.
    usual_off: f64,
    /// The same of single elements where anything is known of them, in their order.
    off: Vec<(usize, f64)>,
}

/// What one path found beyond an element, and what the map has there, both by what they count at
/// its start.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Finding {
    pub(crate) element: usize,
    /// What a lux there counts.
    pub(crate) weight: f64,
    /// On the map.
    pub(crate) light: f64,
    pub(crate) beyond: f64,
}

impl Finding {
    /// Scaled by the importance of a unit at the start.
    pub(crate) fn importance(self, importance: f64) -> Self {
        let [weight, light, beyond] =
            [self.weight, self.light, self.beyond].map(|x| x * importance);
        Self { weight, light, beyond, ..self }
    }
}

impl Survival {
    /// From the findings of paths on a map, with a sureness of zero.
    pub(crate) fn new(findings: impl Iterator<Item = Finding>) -> Self {
        let mut findings: Vec<Finding> = findings.filter(|finding| finding.weight > 0.0).collect();
        // By element.
        findings.sort_by_key(|finding| finding.element);
        let count = findings.len().max(1) as f64;
        let [on_map, found] = findings.iter().fold([0.0, 0.0], |[on_map, found], finding| {
            let Finding { weight, light, beyond, .. } = finding;
            [on_map + light / weight, found + beyond / weight]
        });
        let mean_lx = on_map.max(found).max(0.0) / count;
        let mut survival = Self { sureness: 0.0, mean_lx, usual_off: 1.0, off: Vec::new() };
        // What is off counts as variances do: by its square.
        let squares = |of_some: &[Finding]| {
            of_some.iter().fold([0.0, 0.0], |[off, light], finding| {
                let there = survival.light(finding.weight, finding.light);
                let missed = finding.beyond - finding.light;
                [off + missed * missed, light + there * there]
            })
        };
        let [off, light] = squares(&findings);
        let usual = if light > 0.0 { off / light } else { 1.0 };
        let of_element = |of_one: &[Finding]| {
            let [off, there] = squares(of_one);
            let prior = PRIOR * light / count;
            let off = if there > 0.0 { (off + prior * usual) / (there + prior) } else { usual };
            (of_one[0].element, off.sqrt())
        };
        let off = findings.chunk_by(|a, b| a.element == b.element).map(of_element).collect();
        (survival.usual_off, survival.off) = (usual.sqrt(), off);
        survival
    }

    pub(crate) fn with_sureness(&self, sureness: f64) -> Self {
        Self { sureness, ..self.clone() }
    }

    /// What the start of a path would get wrong if it ended here, on average.
    pub(crate) fn loss(&self, element: usize, weight: f64, light: f64) -> f64 {
        let known = self.off.binary_search_by_key(&element, |(element, _)| *element);
        let off = known.map_or(self.usual_off, |number| self.off[number].1);
        off * self.light(weight, light)
    }

    /// With what probability it goes on; `None` where a lux counts nothing, or neither paths nor
    /// photons found any.
    pub(crate) fn survival_probability(
        &self,
        element: usize,
        weight: f64,
        light: f64,
    ) -> Option<f64> {
        let is_known = weight > 0.0 && self.mean_lx > 0.0;
        let loss = is_known.then(|| self.loss(element, weight, light))?;
        Some((self.sureness * loss).clamp(MIN, 1.0))
    }

    fn light(&self, weight: f64, light: f64) -> f64 {
        light.max(DIM * self.mean_lx * weight)
    }

    /// Puts it among the decisions.
    pub(crate) fn put(&self, out: &mut Writer) {
        let Self { sureness, mean_lx, usual_off, off } = self;
        [sureness, mean_lx, usual_off].into_iter().for_each(|x| out.value(x));
        for (element, off) in off {
            out.value(&(*element as u64));
            out.value(off);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two elements: the map is right on one, and off by all that it has on the other.
    fn survival() -> Survival {
        let finding = |element, beyond| Finding { element, weight: 0.5, light: 10.0, beyond };
        let on = (0..200).map(|_| finding(7, 10.0));
        let off = (0..200).map(|_| finding(3, 20.0));
        Survival::new(on.chain(off)).with_sureness(0.01)
    }

    #[test]
    fn paths_go_on_where_the_map_is_off() {
        let survival = survival();
        let [right, wrong, unknown] =
            [7, 3, 5].map(|e| survival.survival_probability(e, 0.5, 10.0).unwrap());
        assert!(right < 0.3 * wrong && right < unknown && unknown < wrong);
        // Mean squares: 1 on one, 1/2 in all, which counts as 16 more.
        let by_hand = 0.01 * 10.0 * ((200.0 + 16.0 * 0.5) / 216.0_f64).sqrt();
        assert!((wrong - by_hand).abs() < 1e-12, "{wrong}, {by_hand}");
    }

    #[test]
    fn no_survivor_counts_too_much() {
        let survival = survival();
        assert_eq!(survival.survival_probability(3, 1e-9, 0.0), Some(MIN));
        assert_eq!(survival.survival_probability(3, 1e9, 0.0), Some(1.0));
        assert_eq!(
            survival.survival_probability(3, 1.0, f64::NAN),
            survival.survival_probability(3, 1.0, 0.0)
        );
    }

    /// A map that is empty says nothing of how much is lost where paths end on it.
    #[test]
    fn paths_go_on_where_an_empty_map_ends_them() {
        let missed = Finding { element: 2, weight: 0.5, light: 0.0, beyond: 10.0 };
        let survival = Survival::new([missed; 9].into_iter()).with_sureness(0.05);
        // All of it is off: 10 beside a tenth of that.
        assert!((survival.loss(2, 0.5, 0.0) - 10.0).abs() < 1e-12);
        assert_eq!(survival.survival_probability(2, 0.5, 0.0), Some(0.5));
    }

    #[test]
    fn nothing_found_is_no_panic() {
        let survival = Survival::new(std::iter::empty()).with_sureness(1.0);
        assert_eq!(survival.survival_probability(0, 1.0, 0.0), None);
        assert_eq!(self::survival().survival_probability(3, 0.0, 0.0), None);
    }
}
