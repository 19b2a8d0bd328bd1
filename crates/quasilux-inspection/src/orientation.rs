//! Whether z points up: by what fits the positions, by the names of surfaces, and by area and
//! height.

use crate::finding::{Check, Findings};
use crate::names;
use crate::units::{Extent, geometry, positions};
use glam::DVec3;
use quasilux_scene::{Mesh, Scene};

/// Words in the names of surfaces that lie flat.
const FLAT: [&str; 4] = ["floor", "ceiling", "boden", "decke"];
/// Positions that have to fit the geometry as it is turned now, and turned the other way.
const FIT: [f64; 2] = [0.9, 0.99];
/// Nothing is inside a geometry that is flatter than this part of its size.
const FLAT_SHARE: f64 = 1e-3;
/// Heights of usual rooms in m.
const USUAL_HEIGHT_M: [f64; 2] = [2.2, 3.6];
/// Walls that are larger than floor and ceiling by this factor may be these.
const LARGER: f64 = 1.2;
/// A facet with a larger component of its normal faces along an axis.
const ALONG: f64 = 0.9;

pub(crate) fn check(scene: &Scene, findings: &mut Findings<'_>) {
    if findings.has(Check::Units) {
        return;
    }
    let Some(geometry) = geometry(scene) else { return };
    let (now, other) = if findings.places.y_is_up { ("y", "z") } else { ("z", "y") };
    let evidence = by_positions(scene, &geometry, findings.places.y_is_up).or_else(|| {
        match NamedFlat::new(scene) {
            Some(named) => named.evidence(),
            None => by_areas(&scene.mesh, &geometry),
        }
    });
    let Some(evidence) = evidence else { return };
    let message = format!("{now} is taken as up in the geometry files, but {evidence}");
    let cure = format!("set up = \"{other}\" in [scene] if {other} points up there");
    findings.add(Check::UpAxis, findings.places.scene, message, cure);
}

/// The positions fit the geometry only when it is turned the other way.
fn by_positions(scene: &Scene, geometry: &Extent, y_is_up: bool) -> Option<String> {
    let edges = geometry.edges();
    if edges.min_element() <= FLAT_SHARE * edges.max_element() {
        return None;
    }
    let positions = positions(scene);
    let turned = |p: DVec3| {
        if y_is_up { DVec3::new(p.x, p.z, -p.y) } else { DVec3::new(p.x, -p.z, p.y) }
    };
    let turned = Extent::new(&[turned(geometry.low), turned(geometry.high)])?;
    let [now, other] = [geometry.share_of(&positions), turned.share_of(&positions)];
    (now < FIT[0] && other > FIT[1]).then(|| {
        format!(
            "{:.0} % of the positions are inside, and all would be with the other axis up",
            100.0 * now
        )
    })
}

/// Surfaces whose name says that they lie flat.
struct NamedFlat<'a> {
    name: &'a str,
    /// What they have of area square to each axis, in m^2.
    areas_m2: DVec3,
}

impl<'a> NamedFlat<'a> {
    fn new(scene: &'a Scene) -> Option<Self> {
        let is_flat = |name: &str| {
            let name = name.to_lowercase();
            FLAT.iter().any(|word| name.contains(word))
        };
        let mesh = &scene.mesh;
        let materials: Vec<bool> =
            scene.materials.iter().map(|material| is_flat(&material.name)).collect();
        let objects: Vec<bool> = mesh.objects.iter().map(|name| is_flat(name)).collect();
        let mut named: Option<Self> = None;
        for triangle in 0..mesh.triangles.len() as u32 {
            let material = mesh.material_of[triangle as usize] as usize;
            let name = if materials[material] {
                &scene.materials[material].name
            } else if objects[mesh.object_of[triangle as usize] as usize] {
                names::object(mesh, triangle)
            } else {
                continue;
            };
            let named = named.get_or_insert(Self { name, areas_m2: DVec3::ZERO });
            named.areas_m2 += 0.5 * mesh.double_area_vector(triangle).abs();
        }
        named
    }

    /// They stand upright, facing y.
    fn evidence(&self) -> Option<String> {
        let areas = self.areas_m2;
        let stands = areas.y > 2.0 * areas.z && areas.y > 2.0 * areas.x;
        stands.then(|| format!("the surface called \"{}\" stands upright", self.name))
    }
}

/// Walls are larger than floor and ceiling, and as far apart as these usually are.
fn by_areas(mesh: &Mesh, geometry: &Extent) -> Option<String> {
    let mut areas_m2 = DVec3::ZERO;
    for triangle in 0..mesh.triangles.len() as u32 {
        let vector = mesh.double_area_vector(triangle);
        let area = vector.length();
        let along = (vector / area).abs();
        areas_m2 += 0.5 * area * DVec3::from_array(along.to_array().map(|c| f64::from(c > ALONG)));
    }
    let edges = geometry.edges();
    let is_usual = |height_m: f64| (USUAL_HEIGHT_M[0]..=USUAL_HEIGHT_M[1]).contains(&height_m);
    let looks_turned = edges.z > USUAL_HEIGHT_M[1]
        && is_usual(edges.y)
        && !is_usual(edges.x)
        && areas_m2.y > LARGER * areas_m2.z
        && areas_m2.y > LARGER * areas_m2.x;
    looks_turned.then(|| {
        format!(
            "the largest faces stand upright, {} apart, in a geometry {} high",
            names::length(edges.y),
            names::length(edges.z)
        )
    })
}
