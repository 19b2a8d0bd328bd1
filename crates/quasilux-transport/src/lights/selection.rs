//! The choice of one light among several, by about what each gives to a place.
//!
//! Few lights are all asked about what they would give, unshadowed. Of many a few candidates are
//! drawn first, at a cost that does not grow with their number: space is cut into cubes, and each
//! cube has, for each side that a surface in it may face, a table of about what every light gives
//! there, made when it is first asked for. A table draws [`CANDIDATES`] of the lights, evenly
//! spaced from one coordinate on; one of these is chosen by about what it would give at the very
//! place (resampled importance sampling: J. Talbot, D. Cline, P. Egbert, "Importance resampling for
//! global illumination", EGSR 2005).
//!
//! No weight needs to be right: every light keeps a share of the choices in both steps, and the
//! estimate is divided by the probabilities of both. Tables depend on nothing but the scene, so it
//! does not matter who makes them.

use crate::spectrum::Spectrum;
use crate::world::vertex::Vertex;
use glam::DVec3;
use quasilux_sampling::{Discrete, DiscreteSample, choose_weights};
use std::array;
use std::sync::OnceLock;

/// Fewer lights are all asked what they would give.
pub(super) const MIN_MANY: usize = 16;
/// Lights that are weighed together.
pub(super) const LANES: usize = 8;
/// Lights that are drawn of many. Twice as many leave 5 % less error, at a third more time in all.
const CANDIDATES: usize = 4;
/// Cubes along the longest edge of the scene.
const CUBES_ACROSS: f64 = 24.0;
/// Entries of all tables together, if every one is made.
const MAX_ENTRIES: usize = 1 << 24;
/// Sides: along and against each axis, and both sides of whatever faces anywhere.
const SIDES: usize = 7;
/// The least cosine that counts: surfaces in a cube do not face quite along its axis.
const MIN_COSINE: f64 = 0.1;
/// The least square of a distance that counts, in those of the edge of a cube.
const MIN_SQUARE: f64 = 1.0 / 64.0;
/// From this many edges on, light is much the same all over a cube.
const FAR_EDGES: f64 = 8.0;
/// Share of choices that trusts no weight. A bright lamp behind a wall would else take all of them
/// from a weak one that is seen.
pub(super) const DEFENSIVE_SHARE: f64 = 0.1;

/// How one of some lights is chosen.
pub(super) struct LightChoice {
    lights: usize,
    /// Where they are many.
    pub(super) cubes: Option<Cubes>,
}

/// A place that asks for light, on one side or on both.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Asking {
    pub(crate) position: DVec3,
    pub(crate) side: Option<DVec3>,
    /// The facet that it lies on: it sends itself no light.
    pub(crate) own: Option<u32>,
}

/// A light that was chosen.
#[derive(Clone, Copy, Debug)]
pub(super) struct ChosenLight {
    pub(super) light: usize,
    /// Probability of the choice, which divides the light.
    pub(super) pdf: f64,
    /// The rest of the coordinate that chose it.
    pub(super) u_remapped: f64,
}

/// Working space of a choice: the lights that were asked, and their weights.
#[derive(Default)]
pub(crate) struct ChoiceWork {
    asked: Vec<Asked>,
}

#[derive(Clone, Copy)]
struct Asked {
    light: usize,
    /// How often it is drawn, on average.
    expected: f64,
    weight: f64,
}

/// A cube for which a table is made, on one side or on both.
#[derive(Clone, Copy, Debug)]
pub(super) struct Surroundings {
    centre: DVec3,
    edge_m: f64,
    side: Option<DVec3>,
}

impl Asking {
    pub(crate) fn at<S: Spectrum>(vertex: &Vertex<'_, S>) -> Self {
        Self { position: vertex.place(), side: vertex.only_side(), own: vertex.facet() }
    }
}

impl LightChoice {
    /// Among this many lights in a box around the geometry.
    pub(super) fn new(lights: usize, bounds: Option<[DVec3; 2]>) -> Self {
        let bounds = bounds.filter(|_| lights >= MIN_MANY);
        Self { lights, cubes: bounds.and_then(|bounds| Cubes::new(lights, bounds)) }
    }

    /// Whether they are so many that tables choose among them.
    pub(super) fn has_tables(&self) -> bool {
        self.cubes.is_some()
    }

    /// Coordinates that it takes: a single light is no choice.
    pub(super) fn dimensions(&self) -> u32 {
        match self.cubes {
            Some(_) => 2,
            None => u32::from(self.lights > 1),
        }
    }

    /// Chooses a light for a place; `None` where none gives anything, or one gives what is no
    /// number. `weight_around` says about what each light gives in some surroundings, `weigh` about
    /// what up to [`LANES`] of them give at the place itself.
    pub(super) fn choose(
        &self,
        place: Asking,
        u: [f64; 2],
        weight_around: impl Fn(usize, &Surroundings) -> f64,
        weigh: impl Fn(&[usize]) -> [f64; LANES],
        work: &mut ChoiceWork,
    ) -> Option<ChosenLight> {
        let asked = &mut work.asked;
        asked.clear();
        let u = if let Some(cubes) = &self.cubes {
            let table = cubes.table(place, self.lights, weight_around)?;
            let drawn: [DiscreteSample; CANDIDATES] =
                array::from_fn(|number| table.sample((u[0] + number as f64) / CANDIDATES as f64));
            let weights = weigh(&drawn.map(|drawn| drawn.index));
            asked.extend(drawn.iter().zip(weights).map(|(drawn, weight)| {
                let expected = drawn.pdf * CANDIDATES as f64;
                Asked { light: drawn.index, expected, weight: weight / expected }
            }));
            u[1]
        } else {
            for first in (0..self.lights).step_by(LANES) {
                let lights: [usize; LANES] = array::from_fn(|lane| first + lane);
                let lights = &lights[..LANES.min(self.lights - first)];
                let weights = weigh(lights);
                let ask =
                    |(light, weight): (&usize, f64)| Asked { light: *light, expected: 1.0, weight };
                asked.extend(lights.iter().zip(weights).map(ask));
            }
            u[0]
        };
        work.choose_asked(u)
    }

    /// Chooses a light with a probability that can be told of every light, see
    /// [`Self::probability`]: of many by the table alone. `weights` say about what the lights give
    /// at the place.
    pub(super) fn choose_without_candidates(
        &self,
        place: Asking,
        u: f64,
        weight_around: impl Fn(usize, &Surroundings) -> f64,
        weights: impl Iterator<Item = f64>,
        work: &mut ChoiceWork,
    ) -> Option<ChosenLight> {
        work.asked.clear();
        if let Some(cubes) = &self.cubes {
            let drawn = cubes.table(place, self.lights, weight_around)?.sample(u);
            let DiscreteSample { index: light, pdf, u_remapped } = drawn;
            return Some(ChosenLight { light, pdf, u_remapped });
        }
        let ask = |(light, weight)| Asked { light, expected: 1.0, weight };
        work.asked.extend(weights.enumerate().map(ask));
        work.choose_asked(u)
    }

    /// The probability with which [`Self::choose_without_candidates`] chooses a light.
    pub(super) fn probability(
        &self,
        light: usize,
        place: Asking,
        weight_around: impl Fn(usize, &Surroundings) -> f64,
        weights: impl Iterator<Item = f64>,
    ) -> f64 {
        if let Some(cubes) = &self.cubes {
            let table = cubes.table(place, self.lights, weight_around);
            return table.map_or(0.0, |table| table.pdf(light));
        }
        let mut own = 0.0;
        let shares = Defensive::new(weights.enumerate().map(|(number, weight)| {
            own = if number == light { weight } else { own };
            weight
        }));
        let raised = shares.raise(own);
        if raised > 0.0 { raised / shares.total } else { 0.0 }
    }
}

impl ChoiceWork {
    /// The sum of the weights: NaN where one of them is.
    pub(crate) fn total(&self) -> f64 {
        self.asked.iter().map(|it| it.weight).sum()
    }

    /// One of the lights that were asked.
    fn choose_asked(&mut self, u: f64) -> Option<ChosenLight> {
        let asked = &mut self.asked;
        let shares = Defensive::new(asked.iter().map(|it| it.weight));
        asked.iter_mut().for_each(|it| it.weight = shares.raise(it.weight));
        let choice = choose_weights(u, asked.iter().map(|it| it.weight))?;
        let Asked { light, expected, .. } = asked[choice.index];
        let pdf = choice.pdf * expected;
        Some(ChosenLight { light, pdf, u_remapped: choice.u_remapped })
    }
}

/// Gives each weight its part of the defensive share: none that is not 0 is chosen with less than
/// `DEFENSIVE_SHARE / n` of n.
struct Defensive {
    total: f64,
    each: f64,
}

impl Defensive {
    fn new(weights: impl Iterator<Item = f64>) -> Self {
        let (total, count) = weights.fold((0.0, 0.0), |(total, count), weight| {
            (total + weight, count + f64::from(u8::from(weight > 0.0)))
        });
        Self { total, each: DEFENSIVE_SHARE * total / f64::max(count, 1.0) }
    }

    fn raise(&self, weight: f64) -> f64 {
        if weight > 0.0 { (1.0 - DEFENSIVE_SHARE) * weight + self.each } else { weight }
    }
}

/// The tables of all cubes.
pub(super) struct Cubes {
    low: DVec3,
    pub(super) cubes_per_m: f64,
    counts: [usize; 3],
    /// Of side s of cube c at `c * SIDES + s`; `None` where no light comes.
    pub(super) tables: Vec<OnceLock<Option<Discrete>>>,
}

impl Cubes {
    /// `None` for a box without extent.
    fn new(lights: usize, [low, high]: [DVec3; 2]) -> Option<Self> {
        let edges_m = high - low;
        let mut across = CUBES_ACROSS;
        loop {
            let cubes_per_m = across / edges_m.max_element();
            let along = |edge: f64| edge.ceil().max(1.0) as usize;
            let counts = (edges_m * cubes_per_m).to_array().map(along);
            let tables = counts.iter().product::<usize>() * SIDES;
            if across <= 1.0 || tables * lights <= MAX_ENTRIES {
                let tables = std::iter::repeat_with(OnceLock::new).take(tables).collect();
                let cubes = Self { low, cubes_per_m, counts, tables };
                return cubes_per_m.is_finite().then_some(cubes);
            }
            across -= 1.0;
        }
    }

    /// The table for a place, made of the weights of this many lights in its surroundings.
    fn table(
        &self,
        Asking { position, side, .. }: Asking,
        lights: usize,
        weight: impl Fn(usize, &Surroundings) -> f64,
    ) -> Option<&Discrete> {
        let cube = self.cube_of(position);
        let axis = side.map(|n| n.abs().max_position());
        let along = side.zip(axis).map(|(n, axis)| DVec3::AXES[axis] * n[axis].signum());
        let make = || {
            let (centre, edge_m) = (self.centre(cube), self.cubes_per_m.recip());
            let around = Surroundings { centre, edge_m, side: along };
            let weights: Vec<f64> = (0..lights).map(|light| weight(light, &around)).collect();
            let shares = Defensive::new(weights.iter().copied());
            Discrete::new(&weights.into_iter().map(|it| shares.raise(it)).collect::<Vec<f64>>())
        };
        self.tables[self.number(cube, side)].get_or_init(make).as_ref()
    }

    /// The cube that a place lies in, or the nearest.
    pub(super) fn cube_of(&self, position: DVec3) -> [usize; 3] {
        let offset = (position - self.low) * self.cubes_per_m;
        array::from_fn(|axis| (offset[axis] as usize).min(self.counts[axis] - 1))
    }

    pub(super) fn centre(&self, cube: [usize; 3]) -> DVec3 {
        self.low + (DVec3::from_array(cube.map(|i| i as f64)) + 0.5) / self.cubes_per_m
    }

    /// The number of the table of a side of a cube.
    pub(super) fn number(&self, cube: [usize; 3], side: Option<DVec3>) -> usize {
        let number = (cube[2] * self.counts[1] + cube[1]) * self.counts[0] + cube[0];
        let number_of_side = side.map_or(SIDES - 1, |n| {
            let axis = n.abs().max_position();
            2 * axis + usize::from(n[axis] < 0.0)
        });
        number * SIDES + number_of_side
    }
}

impl Surroundings {
    /// The root mean square of about the light in lx that a light at `from`, with an extent of
    /// `radius_m`, gives in the cube: the variance of a choice among lights is least where the
    /// probabilities are in proportion to it. `intensity_cd` is asked along unit directions.
    pub(super) fn lx(
        &self,
        from: DVec3,
        radius_m: f64,
        intensity_cd: impl Fn(DVec3) -> f64,
    ) -> f64 {
        let lx_at = |place: DVec3| {
            let way = place - from;
            let square_m2 = way.length_squared() + radius_m * radius_m;
            let direction = way.normalize_or(DVec3::NEG_Z);
            let cosine = self.side.map_or(1.0, |n| -n.dot(direction).min(0.0));
            let cosine = MIN_COSINE + (1.0 - MIN_COSINE) * cosine;
            intensity_cd(direction) * cosine / square_m2.max(MIN_SQUARE * self.edge_m * self.edge_m)
        };
        let is_far = (self.centre - from).length() + radius_m > FAR_EDGES * self.edge_m;
        if is_far {
            return lx_at(self.centre);
        }
        let octants = (0..8_u32).map(|octant| {
            let sign = |axis: u32| if octant >> axis & 1 == 0 { -0.25 } else { 0.25 };
            self.centre + DVec3::new(sign(0), sign(1), sign(2)) * self.edge_m
        });
        let mean_square = octants.map(lx_at).map(|lx| lx * lx).sum::<f64>() / 8.0;
        mean_square.sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use quasilux_sampling::radical_inverse;

    const BOX: [DVec3; 2] = [DVec3::ZERO, DVec3::new(20.0, 10.0, 4.0)];

    fn number(index: u64) -> [f64; 3] {
        [2, 3, 5].map(|base| radical_inverse(base, index + 1))
    }

    fn place(index: u64) -> Asking {
        let position = DVec3::from_array(number(index)) * BOX[1] * DVec3::new(1.0, 1.0, 0.7);
        let side = [Some(DVec3::Z), Some(DVec3::new(0.6, 0.0, 0.8)), None][index as usize % 3];
        Asking { position, side, own: None }
    }

    /// Spots below the ceiling, of 14 degrees and 3 degrees.
    struct Beam {
        position: DVec3,
        aim: DVec3,
        narrowness: f64,
    }

    fn beams(count: u64) -> Vec<Beam> {
        let beam = |index: u64| {
            let [x, y, z] = number(index + 100);
            let aim = DVec3::new(z - 0.5, x - 0.5, -1.0).normalize();
            let narrowness = if index.is_multiple_of(2) { 17.0 } else { 360.0 };
            Beam { position: DVec3::new(20.0 * x, 10.0 * y, 3.8), aim, narrowness }
        };
        (0..count).map(beam).collect()
    }

    impl Beam {
        fn intensity_cd(&self, direction: DVec3) -> f64 {
            1000.0 * libm::exp(self.narrowness * (self.aim.dot(direction) - 1.0))
        }

        fn lx(&self, Asking { position, side, .. }: Asking) -> f64 {
            let way = position - self.position;
            let direction = way.normalize();
            let cosine = side.map_or(1.0, |n| -n.dot(direction)).max(0.0);
            self.intensity_cd(direction) * cosine / way.length_squared()
        }
    }

    fn weigh(weight: impl Fn(usize) -> f64) -> impl Fn(&[usize]) -> [f64; LANES] {
        move |lights| array::from_fn(|lane| lights.get(lane).map_or(0.0, |light| weight(*light)))
    }

    fn choose(choice: &LightChoice, beams: &[Beam], place: Asking, u: [f64; 2]) -> f64 {
        let around = |light: usize, around: &Surroundings| {
            let beam = &beams[light];
            around.lx(beam.position, 0.0, |direction| beam.intensity_cd(direction) + 2.0)
        };
        let weigh = weigh(|light| beams[light].lx(place));
        let chosen = choice.choose(place, u, around, weigh, &mut ChoiceWork::default());
        chosen.map_or(0.0, |chosen| beams[chosen.light].lx(place) / chosen.pdf)
    }

    /// The mean over the square of coordinates is the sum over the lights, and estimates stay near
    /// it where there is much light; in the tails of beams they may vary.
    #[test]
    fn estimates_are_those_of_all_lights() {
        for count in [3, 15, 16, 100, 700] {
            let beams = beams(count);
            let choice = LightChoice::new(beams.len(), Some(BOX));
            assert_eq!(choice.dimensions(), if count < 16 { 1 } else { 2 });
            let (mut variances, mut errors, mut squares) = (0.0, 0.0, 0.0);
            for place in (0..40).map(place) {
                let all_lx: f64 = beams.iter().map(|beam| beam.lx(place)).sum();
                const SIDE: u32 = 256;
                let u = |i: u32| (f64::from(i) + 0.5) / f64::from(SIDE);
                let estimates = (0..SIDE * SIDE / 4)
                    .map(|i| choose(&choice, &beams, place, [u(i % SIDE), u(4 * (i / SIDE))]));
                let (mut sum, mut square) = (0.0, 0.0);
                for estimate in estimates {
                    sum += estimate;
                    square += estimate * estimate;
                }
                let n = f64::from(SIDE * SIDE / 4);
                let (mean, variance) = (sum / n, square / n - sum * sum / (n * n));
                errors += (mean - all_lx) * (mean - all_lx);
                variances += variance.max(0.0);
                squares += all_lx * all_lx;
            }
            let [error, deviation] = [errors, variances].map(|sum: f64| (sum / squares).sqrt());
            assert!(error < 0.01, "{count} lights: the mean is off by {error}");
            assert!(deviation < 0.4, "{count} lights: estimates deviate by {deviation}");
        }
    }

    /// Few by what they give, many by their table: the share of coordinates that chooses each is
    /// the probability that is told, and these add up to one.
    #[test]
    fn probabilities_are_told() {
        for count in [1, 5, 15, 16, 90] {
            let beams = beams(count);
            let choice = LightChoice::new(beams.len(), Some(BOX));
            let around = |light: usize, around: &Surroundings| {
                let beam = &beams[light];
                around.lx(beam.position, 0.0, |direction| beam.intensity_cd(direction) + 2.0)
            };
            for place in (0..20).map(place) {
                const STEPS: u32 = 20_000;
                let weights = || beams.iter().map(|beam| beam.lx(place));
                let mut shares = vec![0.0; beams.len()];
                let mut work = ChoiceWork::default();
                for step in 0..STEPS {
                    let u = (f64::from(step) + 0.5) / f64::from(STEPS);
                    let chosen =
                        choice.choose_without_candidates(place, u, around, weights(), &mut work);
                    let Some(chosen) = chosen else { continue };
                    let told = choice.probability(chosen.light, place, around, weights());
                    assert!((told - chosen.pdf).abs() < 1e-12, "{told} {chosen:?}");
                    shares[chosen.light] += 1.0 / f64::from(STEPS);
                }
                for (light, share) in shares.iter().enumerate() {
                    let told = choice.probability(light, place, around, weights());
                    assert!((told - share).abs() < 2.0 / f64::from(STEPS), "{told} {share}");
                }
            }
        }
    }

    /// As bounds on contributions take it: at most 10 n / 0.1 times what a light gives.
    #[test]
    fn no_light_is_forgotten() {
        let beams = beams(64);
        let choice = LightChoice::new(beams.len(), Some(BOX));
        for (number, place) in (0_u64..60).map(|i| (i, place(i))) {
            for u in (0..500).map(|i| [number_of(i), number_of(i + 7)]) {
                // All weights lie, that of one light most.
                let around = |light: usize, _: &Surroundings| if light == 5 { 1e9 } else { 1e-9 };
                let weight =
                    |light: usize| if light % 2 == number as usize % 2 { 1e6 } else { 1.0 };
                let mut work = ChoiceWork::default();
                let chosen = choice.choose(place, u, around, weigh(weight), &mut work).unwrap();
                let pdf = chosen.pdf;
                assert!(pdf >= DEFENSIVE_SHARE * DEFENSIVE_SHARE / 64.0 - 1e-12, "{chosen:?}");
            }
        }
    }

    fn number_of(index: u64) -> f64 {
        radical_inverse(2, index + 1)
    }

    #[test]
    fn nothing_is_chosen_where_nothing_shines() {
        let choice = LightChoice::new(20, Some(BOX));
        let mut work = ChoiceWork::default();
        let none = choice.choose(place(0), [0.5; 2], |_, _| 1.0, weigh(|_| 0.0), &mut work);
        assert!(none.is_none() && work.total() == 0.0);
        let odd = choice.choose(place(0), [0.5; 2], |_, _| 1.0, weigh(|_| f64::NAN), &mut work);
        assert!(odd.is_none() && work.total().is_nan());
        let flat = LightChoice::new(20, Some([DVec3::ONE; 2]));
        assert_eq!(flat.dimensions(), 1);
    }
}
