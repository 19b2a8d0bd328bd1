//! All modes find the same where none misses anything.

use super::*;

const WALKS: [Mode; 3] = [Mode::Joins, Mode::BeamsAndJoins, Mode::Photons];

#[test]
fn a_furnace_is_filled_evenly_by_walks_too() {
    let mut scene = cube(2.0, 0.6, 10.0);
    let corner = DVec3::new(0.3, 0.9, 0.0);
    let on_the_floor = Sensor::cell(corner, DVec3::X * 0.5, DVec3::Y * 0.5, DVec3::Z);
    scene.sensors = vec![on_the_floor, up(0.3, 0.9, 0.4)];
    for mode in WALKS {
        let found = solve_by(&scene, mode, 50_000, 1);
        assert_near(&found[0], PI * 10.0 / 0.4, 0.03);
        if mode != Mode::Photons {
            assert_near(&found[1], PI * 10.0 / 0.4, 0.03);
        }
    }
}

/// A room with a plate of metal, a sheet, a pane, a mirror, a lamp and a square that shines: light
/// over the mirror from the lamp is found by walks alone, so the lamp is out of its sight.
fn crowded() -> Scene {
    let mut scene = cube(2.0, 0.5, 0.0);
    let level = |x: f64, y: f64, z: f64, size: f64, surface, luminance_cd_m2| {
        let corners = [[0.0, 0.0], [0.0, size], [size, size], [size, 0.0]];
        let corners = corners.map(|[a, b]| DVec3::new(x + a, y + b, z));
        quad(corners, surface, luminance_cd_m2)
    };
    scene.triangles.extend(level(0.1, 0.1, 0.2, 0.8, Surface::metal(0.7, 0.5), 0.0));
    let sheet = Surface::Sheet { reflectance: 0.3, transmittance: 0.4 };
    scene.triangles.extend(level(1.1, 1.1, 1.2, 0.7, sheet, 0.0));
    scene.triangles.extend(level(0.2, 1.2, 1.9, 0.4, grey(0.2), 300.0));
    scene.sensors = vec![
        Sensor::cell(DVec3::new(1.1, 1.1, 0.7), DVec3::X * 0.6, DVec3::Y * 0.5, DVec3::Z),
        Sensor::disc(DVec3::new(0.6, 0.6, 1.0), DVec3::NEG_Z, 0.3),
    ];
    scene.lights = vec![PointLight {
        position: DVec3::new(1.5, 0.4, 1.7),
        aim: DVec3::NEG_Z,
        candela: Candela::Cosine(100.0),
    }];
    scene
}

#[test]
fn modes_agree_in_a_crowded_room() {
    let scene = crowded();
    let paths = solve(&scene, 50_000, 1);
    for mode in WALKS {
        let walks = solve_by(&scene, mode, 100_000, 2);
        for (path, walk) in paths.iter().zip(&walks) {
            assert!(walk.standard_error_lx < 0.03 * walk.lx, "{mode:?} {walk:?}");
            assert!(path.standard_error_lx < 0.01 * path.lx, "{path:?}");
        }
        let most = largest_disagreement(&paths, &walks);
        assert!(most < 5.0, "{mode:?} {most} {paths:?} {walks:?}");
    }
}

/// The emitting square alone, where paths miss nothing, with a mirror, a pane and a ball's worth of
/// glass.
#[test]
fn modes_agree_over_mirrors_and_through_glass() {
    let mut scene = crowded();
    scene.lights.clear();
    let upright = |x: f64, surface| {
        let corners = [[0.2, 0.2], [1.8, 0.2], [1.8, 1.8], [0.2, 1.8]];
        quad(corners.map(|[y, z]| DVec3::new(x, y, z)), surface, 0.0)
    };
    scene.triangles.extend(upright(1.95, Surface::Mirror { reflectance: 0.8 }));
    scene.triangles.extend(upright(1.0, Surface::tinted_pane(1.5, 0.6)));
    let body = cube(0.3, 0.0, 0.0).triangles.into_iter().map(|mut triangle| {
        triangle.corners.swap(1, 2);
        triangle.corners = triangle.corners.map(|corner| corner + DVec3::new(0.3, 0.5, 0.5));
        triangle.surface = Surface::Glass { eta: 1.5 };
        triangle
    });
    scene.triangles.extend(body);
    let paths = solve(&scene, 100_000, 1);
    for mode in WALKS {
        let walks = solve_by(&scene, mode, 100_000, 2);
        for (path, walk) in paths.iter().zip(&walks) {
            assert!(walk.standard_error_lx < 0.03 * walk.lx, "{mode:?} {walk:?}");
            assert!(path.standard_error_lx < 0.02 * path.lx, "{path:?}");
        }
        let most = largest_disagreement(&paths, &walks);
        assert!(most < 5.0, "{mode:?} {most} {paths:?} {walks:?}");
    }
}

/// Aims change the error, not the mean.
#[test]
fn aims_do_not_change_the_mean() {
    let mut scene = crowded();
    let plain = solve_by(&scene, Mode::Joins, 100_000, 1);
    scene.aims = vec![
        Lookout::new(DVec3::new(0.1, 0.1, 0.2), DVec3::X * 0.8, DVec3::Y * 0.8),
        Lookout::new(DVec3::new(1.1, 1.1, 0.7), DVec3::X * 0.6, DVec3::Y * 0.5),
    ];
    scene.aim_share = 0.4;
    let aimed = solve_by(&scene, Mode::Joins, 100_000, 2);
    let counted = solve_by(&scene, Mode::Photons, 100_000, 3);
    let beams = solve_by(&scene, Mode::BeamsAndJoins, 100_000, 4);
    let keyholes = solve_by(&scene, Mode::KeyholesAndJoins, 100_000, 5);
    for other in [aimed, counted, beams, keyholes] {
        let most = largest_disagreement(&plain, &other);
        assert!(most < 5.0, "{most} {plain:?} {other:?}");
    }
}

/// Copies do neither.
#[test]
fn copies_do_not_change_the_mean() {
    let mut scene = crowded();
    let plain = solve_by(&scene, Mode::Joins, 100_000, 1);
    let high = DVec3::splat(3.0);
    scene.depths = vec![[DVec3::new(1.0, 0.0, 0.0), high], [DVec3::new(0.5, 1.0, 0.0), high]];
    scene.copies = 3;
    for mode in WALKS {
        let copied = solve_by(&scene, mode, 50_000, 2);
        let most = largest_disagreement(&plain, &copied);
        assert!(most < 5.0, "{mode:?} {most} {plain:?} {copied:?}");
    }
}

#[test]
fn parts_add_up() {
    let scene = crowded();
    let whole = solve(&scene, 50_000, 1);
    let parts = [
        Part { sources: vec![Source::Light(0)], mode: Mode::Joins },
        Part { sources: vec![Source::Emitters], mode: Mode::Paths },
    ];
    let limits = Limits { relative_error: 0.01, paths: 1 << 22 };
    let sum = solve_parts(&scene, &parts, limits, 3, || true);
    for part in &sum {
        assert!(part.standard_error_lx <= 0.01 * part.lx, "{part:?}");
    }
    let most = largest_disagreement(&whole, &sum);
    assert!(most < 5.0, "{most} {whole:?} {sum:?}");
    let again = solve_parts(&scene, &parts, limits, 4, || true);
    assert!(largest_disagreement(&again, &sum) < 5.0);
    assert_ne!(again[0].lx, sum[0].lx);
}
