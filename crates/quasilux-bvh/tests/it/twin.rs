//! The hierarchy returns what trying every triangle returns, to the last bit.

use crate::meshes::{Numbers, Triangles, ball, flat_and_coincident, slivers, soup};
use glam::DVec3;
use quasilux_bvh::{Ray, TriangleBvh};

fn assert_twins_agree(name: &str, triangles: &Triangles, rays: u32, numbers: &mut Numbers) {
    let points = triangles.iter().flatten();
    let low = points.clone().copied().reduce(DVec3::min).unwrap();
    let size = points.copied().reduce(DVec3::max).unwrap() - low;
    let bvh = TriangleBvh::build(triangles.clone());
    let mut hits = 0;
    for i in 0..rays {
        let origin = low + size * numbers.point(-0.2, 1.2);
        let toward = triangles[(numbers.next() * triangles.len() as f64) as usize];
        let direction = match i % 3 {
            0 => numbers.direction(),
            1 => DVec3::AXES[i as usize / 3 % 3] * if i % 2 == 0 { 1.0 } else { -1.0 },
            _ => (toward[i as usize % 3] - origin).normalize(),
        };
        let ray = Ray::new(origin, direction);
        let excluded = [(numbers.next() * triangles.len() as f64) as u32];
        let excluded = if i % 2 == 0 { &excluded[..] } else { &[] };
        let slow = bvh.closest_hit_by_brute_force(&ray, excluded);
        assert_eq!(bvh.closest_hit(&ray, excluded), slow, "{name}, ray {i}: {ray:?}");
        let short = ray.up_to(size.length() * numbers.next());
        let blocked = slow.is_some_and(|hit| hit.distance < short.t_max);
        assert_eq!(bvh.is_occluded(&short, excluded), blocked, "{name}, ray {i}: {short:?}");
        hits += u32::from(slow.is_some());
    }
    assert!(hits > rays / 200, "{name}: the test shot past nearly everything ({hits} hits)");
}

#[test]
fn hard_meshes() {
    let numbers = &mut Numbers(1);
    let far = DVec3::new(4.0e5, -5.0e6, 300.0);
    let shifted = |mesh: Triangles, by: DVec3| -> Triangles {
        mesh.into_iter().map(|t| t.map(|p| p + by)).collect()
    };
    let cases: [(&str, Triangles); 7] = [
        ("soup", soup(numbers, 2000)),
        ("slivers", slivers(numbers, 1000)),
        ("flat", flat_and_coincident(numbers, 40)),
        ("ball", ball(DVec3::ZERO, 1.0, 3)),
        ("far soup", shifted(soup(numbers, 1000), far)),
        ("far ball", shifted(ball(DVec3::ZERO, 3.0, 3), far)),
        ("one triangle", vec![[DVec3::ZERO, DVec3::X, DVec3::Y]]),
    ];
    for (name, mesh) in &cases {
        assert_twins_agree(name, mesh, 6000, numbers);
    }
}

#[test]
fn huge_and_tiny_triangles_together() {
    let numbers = &mut Numbers(2);
    let mut mesh = ball(DVec3::new(0.3, 0.2, 0.1), 1e-4, 2);
    mesh.push([
        DVec3::new(-1e3, -1e3, -1.0),
        DVec3::new(1e3, -1e3, -1.0),
        DVec3::new(0.0, 2e3, -1.0),
    ]);
    assert_twins_agree("huge and tiny", &mesh, 6000, numbers);
}

#[test]
fn nothing_is_hit_where_nothing_is() {
    let bvh = TriangleBvh::build(Vec::new());
    let ray = Ray::new(DVec3::ZERO, DVec3::Z);
    assert!(bvh.is_empty() && bvh.closest_hit(&ray, &[]).is_none() && !bvh.is_occluded(&ray, &[]));
}

#[test]
fn ties_go_to_the_lowest_index() {
    let face = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let bvh = TriangleBvh::build(vec![face; 9]);
    let ray = Ray::new(DVec3::new(0.2, 0.2, 1.0), DVec3::NEG_Z);
    assert_eq!(bvh.closest_hit(&ray, &[]).unwrap().triangle, 0);
    assert_eq!(bvh.closest_hit(&ray, &[0, 1]).unwrap().triangle, 2);
}
