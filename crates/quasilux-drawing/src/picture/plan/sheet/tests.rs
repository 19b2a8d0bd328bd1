//! Whole sheets: what stands on them, that they are bounded, and that nothing breaks them.

use super::super::fixtures::{Shell, luminaire, room, room_with_window};
use super::super::ink;
use super::super::model::{PlanAreaLight, PlanCamera, PlanGrid, PlanMark, PlanPoint, PlanPoints};
use super::*;
use crate::drawing::Shape;
use crate::style::Stroke;
use glam::DVec3;

/// All texts of a drawing.
fn texts(drawing: &Drawing) -> Vec<String> {
    fn add(shapes: &[Shape], texts: &mut Vec<String>) {
        for shape in shapes {
            match shape {
                Shape::Text { text, .. } => texts.push(text.clone()),
                Shape::Clipped { shapes, .. } => add(shapes, texts),
                _ => {}
            }
        }
    }
    let mut found = Vec::new();
    add(&drawing.shapes, &mut found);
    found
}

/// Lines and texts of a drawing.
fn elements(shapes: &[Shape]) -> usize {
    let count = |shape: &Shape| match shape {
        Shape::Lines { lines, .. } => lines.len(),
        Shape::Region { outlines, .. } => outlines.iter().map(Vec::len).sum(),
        Shape::Clipped { shapes, .. } => elements(shapes),
        _ => 1,
    };
    shapes.iter().map(count).sum()
}

fn has(drawing: &Drawing, wanted: &str) -> bool {
    texts(drawing).iter().any(|text| text == wanted)
}

/// The third one hangs 5 cm above the ceiling: both elevations and the list say so.
#[test]
fn a_luminaire_above_the_ceiling_is_told() {
    let places = [[1.5, 2.0, 2.95], [3.0, 2.0, 2.95], [4.5, 2.0, 3.05]];
    let luminaires = places.map(|place| luminaire(DVec3::from(place)));
    let shell = room();
    let drawing = plan(&shell.picture(&luminaires));
    let told = "3: 5 cm above".to_owned();
    assert_eq!(texts(&drawing).iter().filter(|text| **text == told).count(), 2);
    assert!(has(&drawing, "5 cm above the geometry") && has(&drawing, "3.05 m"));
    assert!(has(&drawing, "1, 2") && has(&drawing, "2.95 m"));
    let right = plan(&shell.picture(&luminaires[..2]));
    assert!(!texts(&right).iter().any(|text| text.contains("geometry")));
}

/// In millimetres it is far away: the room keeps its size, and the luminaire stands at the border.
#[test]
fn a_luminaire_far_outside_is_at_the_border() {
    let luminaires = [[1.5, 2.0, 2.7], [1500.0, 2000.0, 2700.0]];
    let luminaires = luminaires.map(|place| luminaire(DVec3::from(place)));
    let shell = room();
    let picture = shell.picture(&luminaires);
    let contents = Contents::new(&picture, TOP_PX);
    for view in contents.layout.views {
        let pin = view.pin(luminaires[1].position_m);
        assert!(view.holds(pin.place_px));
        let beyond = pin.beyond.expect("far outside");
        assert_eq!(beyond.text, "3.67 km");
        assert!(beyond.direction.x > 0.0 && beyond.direction.y < 0.0);
        assert!(view.pin(luminaires[0].position_m).beyond.is_none());
        let corner = view.projection.place(DVec3::new(6.0, 4.0, 3.0));
        let opposite = view.projection.place(DVec3::ZERO);
        assert!((corner - opposite).abs().max_element() > 150.0);
    }
    let drawing = plan(&picture);
    assert!(texts(&drawing).iter().filter(|text| *text == "2: 3.67 km away").count() == 3);
}

/// The ends of all lines of a stroke in a view.
fn ends(drawing: &Drawing, view: usize, stroke: Stroke) -> Vec<DVec2> {
    let views = drawing.shapes.iter().filter_map(|shape| match shape {
        Shape::Clipped { shapes, .. } => Some(shapes),
        _ => None,
    });
    let lines = views.skip(view).take(1).flatten().filter_map(|shape| match shape {
        Shape::Lines { lines, stroke: own } if *own == stroke => Some(lines),
        _ => None,
    });
    lines.flatten().flatten().map(|end| DVec2::from(*end)).collect()
}

/// How much is drawn in each view.
fn amounts(picture: &PlanPicture<'_>) -> Vec<usize> {
    let drawing = plan(picture);
    let views = drawing.shapes.iter().filter_map(|shape| match shape {
        Shape::Clipped { shapes, .. } => Some(elements(shapes)),
        _ => None,
    });
    views.collect()
}

/// What is drawn in each view of a room of 6 m x 4 m x 3 m: bare, and with things at a place.
fn amounts_with_things(at: DVec3) -> Vec<Vec<usize>> {
    let shell = Shell::default().with_box(DVec3::ZERO, DVec3::new(6.0, 4.0, 3.0));
    let bare = shell.picture(&[]);
    let boxed = shell.clone().with_box(at - 0.1, at + 0.1);
    let mut glowing = shell.clone();
    let first = shell.positions_m.len() as u32;
    let triangle = [[0.1, 0.0, 0.0], [0.0, 0.1, 0.1], [0.0, 0.0, -0.1]];
    glowing.positions_m.extend(triangle.map(|corner| at + DVec3::from(corner)));
    glowing.triangles.push([first, first + 1, first + 2]);
    let lit = [PlanAreaLight { name: "sheet", triangles: &[shell.triangles.len() as u32] }];
    let points = [PlanPoint { position_m: at, normal: DVec3::Z }];
    let points = [PlanPoints { name: "eye", points: &points }];
    let cameras = [PlanCamera { name: "eye", position_m: at, corners: [DVec3::X; 4] }];
    let pictures = [
        bare,
        boxed.picture(&[]),
        PlanPicture { area_lights: &lit, ..glowing.picture(&[]) },
        PlanPicture { luminaires: &[luminaire(at)], ..bare },
        PlanPicture { point_lights_m: &[at], ..bare },
        PlanPicture { points: &points, ..bare },
        PlanPicture { cameras: &cameras, ..bare },
    ];
    pictures.iter().map(amounts).collect()
}

/// Boxes, lamps, luminous triangles, sensors and cameras stand at random in a room; each elevation
/// shows those before its viewer and not those behind.
#[test]
fn elevations_show_what_is_before_the_viewer() {
    let mut state = 7_u64;
    let mut share = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963);
        (state >> 40) as f64 / f64::from(1 << 24)
    };
    for _ in 0..40 {
        let at = DVec3::new(0.2 + 5.4 * share(), 0.2 + 3.4 * share(), 0.2 + 2.4 * share());
        let found = amounts_with_things(at);
        for (view, depth_m) in [(1, at.y - 2.0), (2, 3.0 - at.x)] {
            for (kind, amounts) in found.iter().enumerate().skip(1) {
                let is_seen = amounts[view] > found[0][view];
                let is_cut = depth_m.abs() < 0.3;
                assert!(is_cut || is_seen == (depth_m > 0.0), "{kind} at {at} in view {view}");
            }
        }
    }
}

/// A sheet just before the east wall of a room of 6 m: the side elevation, cut at 3 m, looks to -x.
#[test]
fn a_door_behind_the_viewer_is_not_drawn() {
    let mut shell = Shell::default().with_box(DVec3::ZERO, DVec3::new(6.0, 4.0, 3.0));
    let first = shell.positions_m.len() as u32;
    let door = [[1.0, 0.0], [2.0, 0.0], [2.0, 2.1], [1.0, 2.1]];
    shell.positions_m.extend(door.map(|[y, z]| DVec3::new(5.97, y, z)));
    shell.triangles.extend([[0, 1, 2], [0, 2, 3]].map(|t| t.map(|k| first + k)));
    let bare = Shell::default().with_box(DVec3::ZERO, DVec3::new(6.0, 4.0, 3.0));
    let edges = |shell: &Shell, view| ends(&plan(&shell.picture(&[])), view, ink::EDGE);
    assert_eq!(edges(&shell, 2), edges(&bare, 2));
    shell.positions_m[first as usize..].iter_mut().for_each(|corner| corner.x = 0.03);
    assert_eq!(edges(&shell, 2).len(), edges(&bare, 2).len() + 8);
}

/// A window whose sill is above the cut of the plan: a line of glass in the south wall of the plan
/// and, where it is cut, of the side elevation; the front elevation looks the other way.
#[test]
fn windows_are_in_plan_and_section() {
    let window = |material| plan(&room_with_window(material).picture(&[]));
    let glass = |drawing: &Drawing, view| ends(drawing, view, ink::WINDOW_GLASS);
    let glazed = window(Some(1));
    let px_per_m = 900.0 / 10.0;
    for (view, length_m) in [(0, 2.0), (1, 0.0), (2, 1.0)] {
        let ends = glass(&glazed, view);
        let extreme = |pick: fn(DVec2, DVec2) -> DVec2| ends.iter().copied().reduce(pick);
        let low = extreme(DVec2::min).unwrap_or_default();
        let found_m = (extreme(DVec2::max).unwrap_or_default() - low).max_element() / px_per_m;
        assert!((found_m - length_m).abs() < 0.02, "{found_m} m in view {view}");
    }
    assert!(has(&glazed, "window at any height"));
    let walled = window(Some(0));
    assert!(glass(&walled, 0).is_empty() && !has(&walled, "window at any height"));
    let open = window(None);
    assert!(glass(&open, 0).is_empty() && !ends(&open, 0, ink::WINDOW_GAP).is_empty());
}

#[test]
fn marks_have_a_balloon_in_each_view_and_a_text() {
    let shell = room();
    let mark = |number, x| PlanMark {
        position_m: Some(DVec3::new(x, 1.0, 1.0)),
        number,
        text: "the wall is missing; expected it closed ".repeat(7),
    };
    let marks = [mark(1, 0.0), mark(2, 6.0), mark(2, 5.0)];
    let drawing = plan(&PlanPicture { marks: &marks, ..shell.picture(&[]) });
    let count = |wanted: &str| texts(&drawing).iter().filter(|text| *text == wanted).count();
    // Besides, axes have these numbers.
    let plain = plan(&shell.picture(&[]));
    let axes = |wanted: &str| texts(&plain).iter().filter(|text| *text == wanted).count();
    assert_eq!(count("1") - axes("1"), 3 + 1);
    assert_eq!(count("2") - axes("2"), 6 + 1);
    assert!(texts(&drawing).iter().filter(|text| text.contains("wall is")).count() >= 4);
}

/// A remark makes the luminaire at its place red, in views and table; one without a place has its
/// text only.
#[test]
fn luminaires_that_are_remarked_on_are_red() {
    let shell = room();
    let luminaires = [[1.5, 2.0, 2.7], [4.5, 2.0, 2.7]].map(|at| luminaire(at.into()));
    let mark =
        |position_m, number, text: &str| PlanMark { position_m, number, text: text.to_owned() };
    let marks =
        [mark(Some(luminaires[1].position_m), 1, "in a cabinet"), mark(None, 2, "read in metres")];
    let picture = PlanPicture { marks: &marks, ..shell.picture(&luminaires) };
    let inked = |drawing: &Drawing, wanted: &str, colour| {
        let is_it = |shape: &&Shape| {
            matches!(shape, Shape::Text { style, text, .. }
                if text == wanted && style.colour == colour)
        };
        let flat = drawing.shapes.iter().flat_map(|shape| match shape {
            Shape::Clipped { shapes, .. } => shapes.iter().collect(),
            shape => vec![shape],
        });
        flat.filter(is_it).count()
    };
    let drawing = plan(&picture);
    for (text, views) in [("2", 3), ("remark 1", 0), ("in a cabinet", 0), ("read in metres", 0)] {
        assert_eq!(
            inked(&drawing, text, ink::FAULT),
            views.max(1) + usize::from(views > 0),
            "{text}"
        );
    }
    assert_eq!(inked(&drawing, "1", ink::FAULT), 0);
    let plain = plan(&shell.picture(&luminaires));
    assert_eq!(inked(&plain, "2", ink::FAULT), 0);
    let balloons = |drawing: &Drawing, number| inked(drawing, number, [255; 3]);
    assert_eq!((balloons(&drawing, "1"), balloons(&drawing, "2")), (3 + 1, 1));
}

/// An opening of 100 m in a room of 6 m.
#[test]
fn a_luminaire_that_does_not_fit_does_not_hide_the_room() {
    let shell = room();
    let mut lamp = luminaire(DVec3::new(3.0, 2.0, 2.7));
    lamp.opening_m = DVec3::new(100.0, 100.0, 0.0);
    let drawing = plan(&shell.picture(&[lamp]));
    let regions = drawing.shapes.iter().flat_map(|shape| match shape {
        Shape::Clipped { shapes, .. } => shapes.as_slice(),
        _ => &[],
    });
    let corners = regions.filter_map(|shape| match shape {
        Shape::Region { outlines, colour } if *colour == ink::LAMP => Some(outlines),
        _ => None,
    });
    let outlines: Vec<_> = corners.flatten().collect();
    assert_eq!(outlines.len(), 3);
    for outline in outlines {
        let width = |axis: usize| {
            let places = || outline.iter().map(|corner| corner[axis]);
            places().fold(f64::MIN, f64::max) - places().fold(f64::MAX, f64::min)
        };
        assert!(width(0) < 12.0 && width(1) < 12.0);
    }
}

/// More than a million triangles, all smaller than a pixel, and one box.
#[test]
fn a_million_triangles_are_few_lines() {
    let shell = room().with_ball(DVec3::new(4.0, 2.0, 1.5), 1.0, 720);
    assert!(shell.triangles.len() > 1_000_000);
    let drawing = plan(&shell.picture(&[]));
    let elements = elements(&drawing.shapes);
    assert!((50..60_000).contains(&elements), "{elements}");
    assert!(drawing.to_svg().len() < 3_000_000);
}

#[test]
fn odd_scenes_do_not_break() {
    let sheet = Shell {
        positions_m: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
        triangles: vec![[0, 1, 2]],
        ..Shell::default()
    };
    let huge = Shell::default().with_box(DVec3::splat(-1e300), DVec3::splat(1e300));
    let tiny = Shell::default().with_box(DVec3::ONE, DVec3::ONE + 1e-12);
    let thin = Shell::default().with_box(DVec3::ZERO, DVec3::new(1e4, 1e-3, 1e-3));
    let point =
        Shell { positions_m: vec![DVec3::ONE; 3], triangles: vec![[0, 1, 2]], ..Shell::default() };
    let far = [DVec3::splat(1e200), DVec3::NAN, DVec3::ZERO].map(luminaire);
    let points = [PlanPoint { position_m: DVec3::splat(-1e9), normal: DVec3::Z }; 3];
    let grid = PlanGrid {
        name: "a grid",
        origin_m: DVec3::ZERO,
        edges_m: [DVec3::X * 1e12, DVec3::Y],
        counts: [u32::MAX, 0],
        normal: DVec3::Z,
    };
    let camera = PlanCamera { name: "", position_m: DVec3::ZERO, corners: [DVec3::X; 4] };
    for shell in [Shell::default(), sheet, huge, tiny, thin, point] {
        let picture = PlanPicture {
            grids: &[grid],
            points: &[PlanPoints { name: "probes", points: &points }],
            cameras: &[camera],
            ..shell.picture(&far)
        };
        for picture in [picture, shell.picture(&[])] {
            let drawing = plan(&picture);
            let [width, height] = drawing.size_px;
            assert!((700.0..1700.0).contains(&width) && (400.0..2500.0).contains(&height));
            assert!(drawing.to_png(1.0).starts_with(b"\x89PNG"));
            let file = drawing.to_svg();
            for number in ["NaN", "inf"] {
                for place in ["=\"", ",", "M", "L"] {
                    assert!(!file.contains(&format!("{place}{number}")), "{place}{number}");
                }
            }
        }
    }
}

/// North turns counter-clockwise from +y: at 90 degrees it points to -x.
#[test]
fn a_turned_north_has_a_pointer_of_its_own() {
    let shell = room();
    let drawn = |north_deg| plan(&PlanPicture { north_deg, ..shell.picture(&[]) });
    for north_deg in [0.0, 360.0, -360.0] {
        let words = texts(&drawn(north_deg));
        assert!(words.contains(&"y, north".to_owned()) && !words.contains(&"north".to_owned()));
    }
    for (north_deg, towards) in
        [(90.0, [-1.0, 0.0]), (-90.0, [1.0, 0.0]), (180.0, [0.0, 1.0]), (45.0, [-0.707, -0.707])]
    {
        let drawing = drawn(north_deg);
        let words = texts(&drawing);
        assert!(words.contains(&"y".to_owned()) && !words.contains(&"y, north".to_owned()));
        let middle =
            DVec2::from(Contents::new(&shell.picture(&[]), TOP_PX).layout.corner.corner_px)
                + DVec2::new(152.0, 44.0 + 5.0);
        let place = drawing.shapes.iter().find_map(|shape| match shape {
            Shape::Text { place_px, text, .. } if text == "north" => Some(DVec2::from(*place_px)),
            _ => None,
        });
        let way = (place.expect("a word") - middle).normalize();
        assert!(way.distance(DVec2::from(towards)) < 0.01, "{north_deg}: {way}");
    }
}
