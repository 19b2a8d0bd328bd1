//! Rays that are none: with coordinates that are not finite, or directions far from unit length.

use crate::meshes::{Numbers, Triangles, ball, soup};
use crate::rays::bits;
use glam::DVec3;
use quasilux_bvh::{Ray, RayQuery, SimdLevel, TriangleBvh};

/// This many of the same ray are traced as a group, and one alone.
const BATCHES: [usize; 2] = [1, 24];

/// A tree with places without a child, one with few of them, and one without triangles.
fn meshes() -> [Triangles; 3] {
    let face = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let mut stack: Triangles = (0..20).map(|i| face.map(|p| p + DVec3::Z * f64::from(i))).collect();
    stack.extend(soup(&mut Numbers(8), 200));
    [vec![face], stack, Vec::new()]
}

fn each_bvh(check: impl Fn(&TriangleBvh)) {
    for mesh in meshes() {
        for simd in SimdLevel::all() {
            let bvh = TriangleBvh::build_for(mesh.clone(), simd);
            assert_eq!(bvh.validate(), Ok(()));
            check(&bvh);
        }
    }
}

/// All answers about a ray, the first one from all triangles.
fn answers(bvh: &TriangleBvh, ray: Ray) -> Vec<(Option<[u64; 5]>, bool)> {
    let slow = bvh.closest_hit_by_brute_force(&ray, &[]);
    let alone = (bits(bvh.closest_hit(&ray, &[])), bvh.is_occluded(&ray, &[]));
    let mut all = vec![(bits(slow), slow.is_some()), alone];
    for count in BATCHES {
        let shots = vec![RayQuery { ray, excluded: [RayQuery::NONE; 2] }; count];
        let (mut hits, mut occluded) = (vec![None; count], vec![false; count]);
        bvh.closest_hit_batch(&shots, &mut hits);
        bvh.occluded_batch(&shots, &mut occluded);
        all.extend(hits.into_iter().map(bits).zip(occluded));
    }
    all
}

#[test]
fn what_is_not_a_number_hits_nothing() {
    let strange = [f64::NAN, -f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
    each_bvh(|bvh| {
        let aside = DVec3::new(0.2, 0.3, 0.1);
        for (height, strange) in [0.5, 40.0, 1e9].into_iter().flat_map(|h| strange.map(|s| (h, s)))
        {
            let ray = Ray::new(aside + DVec3::Z * height, DVec3::new(0.0, -0.28, -0.96));
            for which in 1..8 {
                let put = |v: DVec3| {
                    let at = |axis: usize| if which >> axis & 1 == 1 { strange } else { v[axis] };
                    DVec3::new(at(0), at(1), at(2))
                };
                let origin = Ray { origin: put(ray.origin), ..ray };
                let direction = Ray { direction: put(ray.direction), ..ray };
                for ray in [origin, direction] {
                    for answer in answers(bvh, ray) {
                        assert_eq!(answer, (None, false), "{ray:?}");
                    }
                }
            }
            for t_max in [f64::NAN, f64::NEG_INFINITY, -1.0, 0.0, -0.0] {
                for answer in answers(bvh, ray.up_to(t_max)) {
                    assert_eq!(answer, (None, false), "{:?}", ray.up_to(t_max));
                }
            }
            for answer in answers(bvh, Ray { direction: DVec3::ZERO, ..ray }) {
                assert_eq!(answer, (None, false));
            }
        }
    });
}

/// What such rays hit is not said, but they come to an end.
#[test]
fn huge_directions_come_to_an_end() {
    each_bvh(|bvh| {
        for size in [1e-300, 1e30, 1e39, 1e154, 1e300] {
            for direction in [DVec3::ONE, DVec3::NEG_ONE, DVec3::new(1.0, -1.0, 0.5)] {
                answers(bvh, Ray::new(DVec3::new(0.2, 0.3, 0.5), direction * size));
            }
        }
    });
}

#[test]
fn directions_of_many_lengths_come_to_an_end() {
    let lengths = [0.9, 1.2, 2.0, 0.5];
    each_bvh(|bvh| {
        for first in lengths {
            let shot = |i: usize| {
                let direction = DVec3::Z * if i == 0 { first } else { lengths[i % 4] };
                RayQuery {
                    ray: Ray::new(DVec3::splat(0.1), direction),
                    excluded: [RayQuery::NONE; 2],
                }
            };
            for start in 0..4 {
                let shots: Vec<RayQuery> = (start..40).map(shot).collect();
                bvh.closest_hit_batch(&shots, &mut vec![None; shots.len()]);
            }
        }
    });
}

#[test]
fn huge_coordinates_are_answered_as_by_the_slow_twin() {
    for simd in SimdLevel::all() {
        let bvh = TriangleBvh::build_for(ball(DVec3::ZERO, 1.0, 2), simd);
        for size in [1e3, 1e6, 1e7, 1e100, 1e299] {
            for direction in [DVec3::NEG_Z, DVec3::Z, DVec3::X] {
                let answers = answers(&bvh, Ray::new(DVec3::new(0.1, 0.2, size), direction));
                assert!(answers.iter().all(|answer| *answer == answers[0]), "{size} {direction}");
            }
        }
    }
}

#[test]
fn corners_that_are_too_large_or_no_numbers_are_refused() {
    for strange in [f64::NAN, f64::INFINITY, -1e300] {
        for axis in 0..3 {
            let mut face = [DVec3::ZERO, DVec3::X, DVec3::Y];
            face[axis][axis] = strange;
            let built = std::panic::catch_unwind(|| TriangleBvh::build(vec![face]).len());
            assert!(built.is_err(), "{face:?}");
        }
    }
}
