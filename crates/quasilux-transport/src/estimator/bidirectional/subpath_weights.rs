//! Weights of bidirectional paths: the balance heuristic (Veach and Guibas 1995) over all vertices
//! at which an eye subpath and a light subpath can be connected.
//!
//! A way of light with n surfaces is found by n + 2 techniques at most: the light subpath makes its
//! first j surfaces, the eye subpath the others. With `p_j` the density of technique j, its
//! contribution `f / p_j` gets the weight `p_j / (p_0 + p_1 + ...)`. What it counts is therefore
//! `f / (p_0 + p_1 + ...)`: never more than the contribution of the same way in plain path tracing,
//! twice of it where paths are led (`leading`), nor than that of a plain photon that is connected
//! to the sensor, however badly the technique suits the scene. No pilot enters these densities; of
//! the survey do the number of copies that leave a place and how it sees outside, which both
//! subpaths know.
//!
//! The sums over all techniques are kept as two numbers a vertex, and the part of the second that
//! came by copies, after I. Georgiev, "Implementing
//! vertex connection and merging", Saarland University 2012, section 4 (without merging): with `p`
//! the density of the vertex as its own subpath makes it, and all densities of the techniques that
//! leave it to the other subpath over that of the technique that does not,
//!
//! ```text
//! sum over the shorter subpaths = reverse density * (vcm + vc * density back from the vertex)
//! ```
//!
//! Russian roulette is part of the densities (`Bsdf::survival_pdf_sr`); the choice of one
//! connection among several is left out of them: the weights of a way still sum up to one. A
//! connection that is chosen counts the sum of those that it stands for, each bounded as above: at
//! most as many as its light subpath has vertices.

/// Weights of the techniques that leave vertices of a subpath to the other one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct SubpathWeights {
    /// Of the technique that leaves this vertex alone, in m^2 once the vertex is reached.
    vcm: f64,
    /// Of those that leave more of them, in m^2 sr.
    vc: f64,
    /// Of those among them whose light subpaths have been copied where this one came from: to be
    /// divided by the copies that leave the next vertex. In m^2 sr.
    copied: f64,
}

impl SubpathWeights {
    /// With these sums.
    pub(crate) fn new(vcm: f64, vc: f64) -> Self {
        Self { vcm, vc, copied: 0.0 }
    }

    /// Where the technique that leaves this vertex alone is used `alone` times, and those that
    /// leave more are `more` times as likely as they were taken for.
    pub(crate) fn times(self, alone: f64, more: f64) -> Self {
        Self {
            vcm: product(alone, self.vcm),
            vc: product(more, self.vc),
            copied: product(more, self.copied),
        }
    }

    /// At the first surface that is not specular, where light without extent lands with this
    /// density in m^-2: an eye subpath that ends here asks the light or its image, and nothing
    /// meets it. Without a density it asks nothing.
    pub(crate) fn of_landing(density_m2: Option<f64>) -> Self {
        Self::new(density_m2.map_or(0.0, |density_m2| 1.0 / density_m2), 0.0)
    }

    /// After a flight of this length that ends at this cosine.
    pub(crate) fn arrived(self, distance_m: f64, cos: f64) -> Self {
        Self {
            vcm: self.vcm * distance_m * distance_m / cos,
            vc: self.vc / cos,
            copied: self.copied / cos,
        }
    }

    /// After a direction at this cosine was drawn with the density `pdf_sr`, where the opposite
    /// way has `reverse_pdf_sr`.
    pub(crate) fn scattered(self, cos: f64, pdf_sr: f64, reverse_pdf_sr: f64) -> Self {
        Self::new(1.0 / pdf_sr, cos / pdf_sr * self.towards(reverse_pdf_sr))
    }

    /// After a direction at this cosine was drawn by an eye path, at a vertex that this many copies
    /// of light subpaths leave; see [`Self::scattered`].
    pub(crate) fn scattered_where_copied(
        self,
        cos: f64,
        pdf_sr: f64,
        reverse_pdf_sr: f64,
        copies: f64,
    ) -> Self {
        let more = product(reverse_pdf_sr, self.vc) * copies;
        let [vc, copied] = [self.vcm, more].map(|sum| cos / pdf_sr * sum);
        Self { vcm: 1.0 / pdf_sr, vc, copied }
    }

    /// At a vertex that this many copies of light subpaths leave; 1 at lights.
    pub(crate) fn at_copies(self, copies: f64) -> Self {
        Self { vc: self.vc + self.copied / copies, copied: 0.0, ..self }
    }

    /// After one of finitely many directions was taken: `cos` is that of the direction in which it
    /// came, `scale` how many times brighter radiance is behind than before. Where light is bent,
    /// densities of directions go with both: `n^2 cos dw` is the same on both sides.
    pub(crate) fn mirrored(self, cos: f64, scale: f64) -> Self {
        Self { vcm: 0.0, vc: self.vc * cos * scale, copied: self.copied * cos * scale }
    }

    /// After a way between two vertices, perhaps over plane mirrors or through panes, where each
    /// may ask for light of the other: `vcm` as it is where nothing is between, with the way
    /// unfolded.
    pub(crate) fn asked(self, vcm: f64) -> Self {
        Self { vcm, ..self }
    }

    /// Sum over the techniques that leave this vertex and perhaps more to the other subpath, over
    /// the density in m^-2 with which that makes this vertex; `reverse_pdf_sr` is its density of
    /// the direction to the vertex before.
    pub(crate) fn towards(self, reverse_pdf_sr: f64) -> f64 {
        // Nothing may come of what is not possible, not even where it would be infinitely likely.
        let more = if reverse_pdf_sr > 0.0 { self.vc * reverse_pdf_sr } else { 0.0 };
        self.vcm + more
    }

    /// The weight of an eye subpath that runs into a facet: `pdf_m2` as it is asked for light,
    /// `emission` as a photon leaves it.
    pub(crate) fn of_hit(self, pdf_m2: f64, emission: f64) -> f64 {
        let vc = self.at_copies(1.0).vc;
        1.0 / (1.0 + product(pdf_m2, self.vcm) + product(emission, vc))
    }
}

/// The weight of a connection: the sums over the techniques to either side, each a density times
/// [`SubpathWeights::towards`].
pub(crate) fn of_connection(to_eye: f64, to_light: f64) -> f64 {
    1.0 / (1.0 + to_eye + to_light)
}

/// A density times the weight of what it leads to.
pub(crate) fn product(density: f64, weight: f64) -> f64 {
    if density > 0.0 { density * weight } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use std::f64::consts::{FRAC_1_PI, TAU};

    /// Numbers that look random (Knuth's MMIX generator).
    struct Numbers(u64);

    impl Numbers {
        fn next(&mut self) -> f64 {
            self.0 = self
                .0
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 11) as f64 / (1_u64 << 53) as f64
        }

        fn direction(&mut self) -> DVec3 {
            let (z, phi) = (2.0 * self.next() - 1.0, TAU * self.next());
            let r = (1.0 - z * z).sqrt();
            DVec3::new(r * libm::cos(phi), r * libm::sin(phi), z)
        }
    }

    /// A way of light: the sensor point, diffuse surfaces, and a light that is a point or a facet.
    struct Chain {
        positions: Vec<DVec3>,
        normals: Vec<DVec3>,
        /// Copies of light subpaths that leave each; 1 of the light.
        copies: Vec<f64>,
        is_point: bool,
        flux_lm: f64,
        /// Of the point, toward the last surface; or the luminance of the facet.
        brightness: f64,
        facets_lm: f64,
    }

    impl Chain {
        fn new(numbers: &mut Numbers, surfaces: usize, is_point: bool) -> Self {
            let nodes = surfaces + 2;
            // Distances over three decades.
            let step = |numbers: &mut Numbers| {
                numbers.direction() * libm::exp10(3.0 * numbers.next() - 2.0)
            };
            let mut positions = vec![DVec3::ZERO];
            for node in 1..nodes {
                let step = step(numbers);
                positions.push(positions[node - 1] + step);
            }
            // Each looks at both of its neighbours.
            let normals = (0..nodes).map(|node| {
                let toward = |other: Option<&DVec3>| {
                    other.map_or(DVec3::ZERO, |other| (*other - positions[node]).normalize())
                };
                let before = node.checked_sub(1).and_then(|before| positions.get(before));
                let sum = toward(before) + toward(positions.get(node + 1));
                (sum + 0.3 * numbers.direction() * sum.length()).normalize()
            });
            let normals = normals.collect();
            let mut copies: Vec<f64> =
                (1..nodes).map(|_| libm::exp2((7.0 * numbers.next()).floor())).collect();
            copies.push(1.0);
            let [flux_lm, brightness, facets_lm] =
                [(); 3].map(|()| libm::exp10(4.0 * numbers.next()));
            Self { positions, normals, copies, is_point, flux_lm, brightness, facets_lm }
        }

        fn surfaces(&self) -> usize {
            self.positions.len() - 2
        }

        fn distance_m(&self, a: usize, b: usize) -> f64 {
            (self.positions[b] - self.positions[a]).length()
        }

        /// Cosine at a of the direction to b.
        fn cos(&self, a: usize, b: usize) -> f64 {
            let way = (self.positions[b] - self.positions[a]).normalize();
            self.normals[a].dot(way).abs()
        }

        /// Density of b as a diffuse surface a draws it, in m^-2.
        fn drawn_m2(&self, a: usize, b: usize) -> f64 {
            let distance_m = self.distance_m(a, b);
            self.cos(a, b) * FRAC_1_PI * self.cos(b, a) / (distance_m * distance_m)
        }

        fn light(&self) -> usize {
            self.positions.len() - 1
        }

        /// Density with which a photon makes its light's place and the last surface, over that with
        /// which this surface asks for the light.
        fn landing_m2(&self) -> f64 {
            let (light, last) = (self.light(), self.surfaces());
            let distance_m = self.distance_m(light, last);
            let geometry = self.cos(last, light) / (distance_m * distance_m);
            match self.is_point {
                true => self.brightness / self.flux_lm * geometry,
                false => self.emission() * geometry / self.asked_m2(),
            }
        }

        /// Density in m^-2 sr^-1 of photons that leave the facet.
        fn emission(&self) -> f64 {
            self.brightness * self.cos(self.light(), self.surfaces()) / self.flux_lm
        }

        fn asked_m2(&self) -> f64 {
            self.brightness / self.facets_lm
        }

        /// Densities of all techniques, by the number of surfaces that the light subpath makes,
        /// over that of the light's place as surfaces ask for it; last the eye subpath that runs
        /// into the light.
        fn densities(&self) -> Vec<f64> {
            let surfaces = self.surfaces();
            let by_eye = |last: usize| (0..last).map(|a| self.drawn_m2(a, a + 1)).product::<f64>();
            let by_light = |first: usize| {
                let drawn = (first..surfaces).map(|a| self.drawn_m2(a + 1, a)).product::<f64>();
                self.copies[first + 1] * self.landing_m2() * drawn
            };
            let connected = (0..=surfaces).map(|of_light| match of_light {
                0 => by_eye(surfaces),
                _ => by_eye(surfaces - of_light) * by_light(surfaces - of_light + 1),
            });
            let hit = by_eye(surfaces) * self.drawn_m2(surfaces, self.light()) / self.asked_m2();
            connected.chain((!self.is_point).then_some(hit)).collect()
        }

        /// Copies that leave a place for each that comes from the next one.
        fn copies_each(&self, at: usize) -> f64 {
            self.copies[at] / self.copies[at + 1]
        }

        /// Weights of a subpath along these places.
        fn carried(&self, start: SubpathWeights, nodes: &[usize]) -> SubpathWeights {
            let arrive = |weights: SubpathWeights, a: usize, b: usize| {
                weights.arrived(self.distance_m(a, b), self.cos(b, a))
            };
            let mut weights = start;
            for at in 1..nodes.len() {
                weights = arrive(weights, nodes[at - 1], nodes[at]);
                if let Some(next) = nodes.get(at + 1) {
                    let cos = self.cos(nodes[at], *next);
                    let back = self.cos(nodes[at], nodes[at - 1]);
                    let [pdf_sr, back_sr] = [cos, back].map(|cos| cos * FRAC_1_PI);
                    let here = nodes[at];
                    weights = if *next < here {
                        weights.scattered(cos, pdf_sr * self.copies_each(here), back_sr)
                    } else {
                        let settled = weights.at_copies(self.copies[here]);
                        settled.scattered_where_copied(cos, pdf_sr, back_sr, self.copies[here])
                    };
                }
            }
            weights
        }

        /// Of the eye subpath at a surface, 0 for the sensor.
        fn of_eye(&self, at: usize) -> SubpathWeights {
            if at == 0 {
                return SubpathWeights::default();
            }
            let cos = self.cos(0, 1);
            let left = SubpathWeights::default().scattered(cos, cos * FRAC_1_PI, 0.0);
            let carried = self.carried(left, &(0..=at).collect::<Vec<usize>>());
            carried.at_copies(self.copies[at])
        }

        /// Of the light subpath at a surface.
        fn of_light(&self, at: usize) -> SubpathWeights {
            let (light, last) = (self.light(), self.surfaces());
            let nodes: Vec<usize> = (at..=light).rev().collect();
            let landed = if self.is_point {
                SubpathWeights::of_landing(Some(self.landing_m2()))
            } else {
                let left = SubpathWeights::new(0.0, self.cos(light, last) / self.emission());
                let (distance_m, cos) = (self.distance_m(light, last), self.cos(last, light));
                let as_drawn = self.emission() * cos / (distance_m * distance_m);
                left.arrived(distance_m, cos).asked(self.asked_m2() / as_drawn)
            };
            if at == last {
                return landed;
            }
            let cos = self.cos(last, last - 1);
            let back = self.cos(last, light) * FRAC_1_PI;
            let pdf_sr = cos * FRAC_1_PI * self.copies_each(last);
            self.carried(landed.scattered(cos, pdf_sr, back), &nodes[1..])
        }

        /// The weight of each technique as subpaths compute it.
        fn weights(&self) -> Vec<f64> {
            let (light, surfaces) = (self.light(), self.surfaces());
            let back_sr = |at: usize, to: usize| match at {
                0 => 0.0,
                _ => self.cos(at, to) * FRAC_1_PI,
            };
            let connected = (0..=surfaces).map(|of_light| {
                let at = surfaces - of_light;
                let back_to_eye_sr = self.copies_each(at) * back_sr(at, at.saturating_sub(1));
                let to_eye = self.of_eye(at).towards(back_to_eye_sr);
                if of_light == 0 {
                    let hit = match self.is_point {
                        true => 0.0,
                        false => self.drawn_m2(at, light) / self.asked_m2(),
                    };
                    return of_connection(product(self.landing_m2(), to_eye), hit);
                }
                let next = at + 1;
                let to_light = self.of_light(next).towards(back_sr(next, next + 1));
                of_connection(
                    product(self.copies_each(next) * self.drawn_m2(next, at), to_eye),
                    product(self.drawn_m2(at, next), to_light),
                )
            });
            let hit = || self.of_eye(light).of_hit(self.asked_m2(), self.emission());
            connected.chain((!self.is_point).then(hit)).collect()
        }
    }

    /// The bound of the module, on 4000 random ways of 0 to 6 surfaces whose techniques differ by
    /// up to 40 decades, and whose light subpaths are copied up to 64 times: weights sum up to one,
    /// and weight over density is one over the sum of all densities, so a contribution is no larger
    /// than that of plain paths, of plain photons, or of any other technique. A weight
    /// that is 1e-6 off is seen.
    #[test]
    fn no_technique_exceeds_plain_paths_or_plain_photons() {
        let mut numbers = Numbers(5);
        for number in 0..4000 {
            let chain = Chain::new(&mut numbers, number % 7, number % 2 == 0);
            let (densities, weights) = (chain.densities(), chain.weights());
            let sum: f64 = weights.iter().sum();
            assert!((sum - 1.0).abs() < 1e-9, "{number}: weights {weights:?}");
            let all: f64 = densities.iter().sum();
            for (density, weight) in densities.iter().zip(&weights) {
                let expected = density / all;
                assert!(
                    (weight - expected).abs() <= 1e-9 * expected.max(1e-12),
                    "{number}: {weights:?}, densities {densities:?}"
                );
            }
        }
    }
}
