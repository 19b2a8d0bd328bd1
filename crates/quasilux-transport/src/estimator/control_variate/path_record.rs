//! Predicted variance and rays of a recorded path, had it ended on the map by Russian roulette.

use crate::path::frozen_map::survival::{Finding, Survival};

/// A path as it was traced, and the surfaces where it might have ended.
#[derive(Clone, Debug, Default)]
pub(super) struct PathRecord {
    /// Rays up to the first of them.
    pub(super) flights: u32,
    pub(super) steps: Vec<Step>,
}

/// One of them, or a surface without a map.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step {
    pub(super) finding: Finding,
    pub(super) is_on_map: bool,
    /// What a path misses if it ends there with no map.
    pub(super) missed: f64,
    /// Rays from there to the next of them, or to the path's end.
    pub(super) flights: u32,
    /// With what probability a path that ends on no map goes on.
    pub(super) alone: f64,
}

/// How a path ends by Russian roulette.
#[derive(Clone, Copy)]
pub(super) enum Ending<'s> {
    /// On nothing.
    Alone,
    /// On the map, which stands for what is left out.
    OnMap(&'s Survival),
}

/// Expected cost of a path over all outcomes of Russian roulette.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Price {
    /// Added by Russian roulette.
    pub(super) variance: f64,
    pub(super) flights: f64,
}

impl PathRecord {
    /// Variance and rays for a start with this `importance` of a unit; an end on the map takes
    /// `at_end` flights more.
    pub(super) fn price(&self, ending: Ending<'_>, importance: f64, at_end: f64) -> Price {
        // Those that are left count more and more.
        let mut factor = importance;
        let survivals: Vec<(f64, bool)> = self
            .steps
            .iter()
            .map(|step| {
                let Finding { element, weight, light, .. } = step.finding;
                let on_map = match ending {
                    Ending::OnMap(map) if step.is_on_map => {
                        map.survival_probability(element, factor * weight, factor * light)
                    }
                    Ending::OnMap(_) | Ending::Alone => None,
                };
                let probability = on_map.unwrap_or(step.alone);
                factor /= probability;
                (probability, on_map.is_some())
            })
            .collect();
        let mut price = Price::default();
        for (Step { finding, missed, flights, .. }, (probability, is_on_map)) in
            self.steps.iter().zip(survivals).rev()
        {
            let (off, at_end) = match is_on_map {
                true => (importance * (finding.beyond - finding.light), at_end),
                false => (importance * missed, 0.0),
            };
            price.variance = (price.variance + off * off * (1.0 - probability)) / probability;
            price.flights =
                probability * (f64::from(*flights) + price.flights) + (1.0 - probability) * at_end;
        }
        Price { flights: price.flights + f64::from(self.flights), ..price }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Mean, variance and rays of a record, by all outcomes of Russian roulette.
    fn played(record: &PathRecord, survival: &Survival, importance: f64) -> [f64; 3] {
        // What it takes along to a surface is the part that counts there, of the light beyond all
        // of them.
        fn on(
            steps: &[Step],
            beyond: f64,
            factor: f64,
            survival: &Survival,
            out: &mut Vec<[f64; 3]>,
            (p, sum, flights): (f64, f64, f64),
        ) {
            let Some((step, rest)) = steps.split_first() else {
                // What lies beyond the last surface is found, less what the one before said of it.
                out.push([p, sum + factor * beyond, flights]);
                return;
            };
            let Finding { element, weight, light, beyond: own } = step.finding;
            // Light between the last surface and this one is found by all that come here.
            let sum = sum + factor * (beyond - own);
            let probability =
                survival.survival_probability(element, factor * weight, factor * light).unwrap();
            out.push([p * (1.0 - probability), sum + factor * light, flights]);
            let survivor = factor / probability;
            let sum = sum + factor * light * (1.0 - 1.0 / probability);
            let flights = flights + f64::from(step.flights);
            on(rest, own, survivor, survival, out, (p * probability, sum, flights));
        }
        let mut out = Vec::new();
        let first = record.steps[0].finding.beyond;
        let begin = (1.0, 0.0, f64::from(record.flights));
        on(&record.steps, first, importance, survival, &mut out, begin);
        let mean = |f: &dyn Fn(&[f64; 3]) -> f64| -> f64 { out.iter().map(|o| o[0] * f(o)).sum() };
        let value = mean(&|o| o[1]);
        [value, mean(&|o| (o[1] - value) * (o[1] - value)), mean(&|o| o[2])]
    }

    #[test]
    fn a_price_is_what_all_chances_together_cost() {
        let finding = |element, weight, light, beyond| Finding { element, weight, light, beyond };
        let steps = [
            (finding(4, 0.6, 30.0, 41.0), 2),
            (finding(9, 0.4, 20.0, 13.0), 1),
            (finding(4, 0.2, 11.0, 3.0), 3),
        ];
        let steps = steps
            .map(|(finding, flights)| Step {
                finding,
                is_on_map: true,
                missed: finding.beyond,
                flights,
                alone: 1.0,
            })
            .to_vec();
        let record = PathRecord { flights: 1, steps };
        let survival = Survival::new(record.steps.iter().map(|step| step.finding));
        for (sureness, importance) in [(0.5, 0.01), (2.0, 0.02), (1e-9, 1.0), (1e9, 1.0)] {
            let survival = survival.with_sureness(sureness);
            let price = record.price(Ending::OnMap(&survival), importance, 0.0);
            let [mean, variance, flights] = played(&record, &survival, importance);
            assert!((mean - importance * 41.0).abs() < 1e-9 * mean, "biased: {mean}");
            assert!((price.variance - variance).abs() <= 1e-9 * variance, "{price:?} {variance}");
            assert!((price.flights - flights).abs() < 1e-9 * flights, "{price:?} {flights}");
        }
        let certain = record.price(Ending::Alone, 1.0, 0.0);
        assert_eq!(certain, Price { variance: 0.0, flights: 7.0 });
        // Where no map is, paths end with nothing in hand; and on maps they may look for one light
        // more.
        let mut bare = record.clone();
        bare.steps.iter_mut().for_each(|step| (step.is_on_map, step.alone) = (false, 0.5));
        let on_map = Ending::OnMap(&survival);
        assert_eq!(bare.price(on_map, 1.0, 1.0), bare.price(Ending::Alone, 1.0, 0.0));
        let seldom = Ending::OnMap(&survival.with_sureness(1e-9));
        let [less, more] = [0.0, 1.0].map(|at_end| record.price(seldom, 1.0, at_end).flights);
        assert!(less < more && more < less + 1.0);
    }
}
