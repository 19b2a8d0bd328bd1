//! What of a project file is understood: geometry in OBJ, materials of the kinds that the crate
//! has, point and area lights, luminaires alike all round, sensors as points and as grids, even and
//! overcast skies, the sun by its place.

use super::{obj, photometry, text};
use glam::DVec3;
use quasilux_brute::{Candela, PointLight, Scene, Sensor, Sky, SkyModel, Sun, Surface, Triangle};
use std::path::Path;
use toml::{Table, Value};

/// The scene of a project file; its lights are the luminaires and then the point lights.
pub(super) fn read(path: &Path) -> Result<Scene, String> {
    let project: Table = text(path)?.parse().map_err(|error| format!("{error}"))?;
    let folder = path.parent().unwrap_or(Path::new("."));
    let mut scene = Scene::default();
    for file in list(project.get("scene").and_then(|scene| scene.get("geometry"))) {
        let file = file.as_str().ok_or("geometry is a list of names")?;
        for shape in obj::read(&text(&folder.join(file))?)? {
            scene.triangles.push(triangle(&project, &shape)?);
        }
    }
    for luminaire in list(project.get("luminaires")) {
        let file = luminaire.get("photometry").and_then(Value::as_str).ok_or("photometry?")?;
        let dimming = number(luminaire, "dimming").unwrap_or(1.0);
        scene.lights.push(PointLight {
            position: vector(luminaire, "position")?,
            aim: vector(luminaire, "aim")?.normalize(),
            candela: photometry::read(&text(&folder.join(file))?, dimming)?,
        });
    }
    for light in list(project.get("lights")).iter().filter(|light| is(light, "kind", "point")) {
        scene.lights.push(PointLight {
            position: vector(light, "position")?,
            aim: DVec3::NEG_Z,
            candela: Candela::Constant(number(light, "intensity_cd").ok_or("intensity_cd?")?),
        });
    }
    for sensor in list(project.get("sensors")) {
        scene.sensors.extend(sensors(sensor)?);
    }
    scene.sun =
        project.get("sun").filter(|sun| sun.get("direct").is_some()).map(sun).transpose()?;
    let ground = project.get("ground").and_then(|ground| number(ground, "reflectance"));
    scene.sky = project.get("sky").map(sky).transpose()?;
    let lit = scene.sky.map(|sky| sky.over_ground(ground.unwrap_or(0.2), scene.sun.as_ref()));
    scene.sky = lit;
    Ok(scene)
}

fn list(value: Option<&Value>) -> &[Value] {
    value.and_then(Value::as_array).map_or(&[], Vec::as_slice)
}

fn is(table: &Value, key: &str, text: &str) -> bool {
    table.get(key).and_then(Value::as_str) == Some(text)
}

fn as_number(value: &Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64))
}

fn number(table: &Value, key: &str) -> Option<f64> {
    table.get(key).and_then(as_number)
}

/// Three numbers.
pub(super) fn as_vector(value: &Value) -> Option<DVec3> {
    let numbers: Option<Vec<f64>> = value.as_array()?.iter().map(as_number).collect();
    <[f64; 3]>::try_from(numbers?).ok().map(DVec3::from_array)
}

/// A key with three numbers.
pub(super) fn vector(table: &Value, key: &str) -> Result<DVec3, String> {
    table.get(key).and_then(as_vector).ok_or_else(|| format!("{key} needs three numbers"))
}

fn triangle(project: &Table, shape: &obj::Shape) -> Result<Triangle, String> {
    let name = &shape.material;
    let material = project.get("materials").and_then(|materials| materials.get(name));
    let material = material.ok_or_else(|| format!("no material {name}"))?;
    let of_this = |light: &&Value| is(light, "kind", "area") && is(light, "material", name);
    let luminance = list(project.get("lights")).iter().find(of_this);
    let luminance_cd_m2 =
        luminance.and_then(|light| number(light, "luminance_cd_m2")).unwrap_or(0.0);
    Ok(Triangle { corners: shape.corners, surface: surface(material)?, luminance_cd_m2 })
}

fn surface(material: &Value) -> Result<Surface, String> {
    let wanted = |key: &str| number(material, key).ok_or_else(|| format!("a material needs {key}"));
    Ok(match material.get("kind").and_then(Value::as_str).unwrap_or("diffuse") {
        "diffuse" => match number(material, "transmittance") {
            Some(transmittance) => {
                Surface::Sheet { reflectance: wanted("reflectance")?, transmittance }
            }
            None => Surface::grey(wanted("reflectance")?),
        },
        "mirror" => Surface::Mirror { reflectance: wanted("reflectance")? },
        "dielectric" => Surface::Glass { eta: wanted("eta")? },
        "pane" => match number(material, "transmittance") {
            Some(transmittance) => Surface::tinted_pane(wanted("eta")?, transmittance),
            None => Surface::clear_pane(wanted("eta")?),
        },
        "conductor" => Surface::metal(wanted("reflectance")?, wanted("roughness")?),
        other => return Err(format!("no material of the kind {other}")),
    })
}

fn sensors(sensor: &Value) -> Result<Vec<Sensor>, String> {
    if is(sensor, "kind", "points") {
        let points = list(sensor.get("points")).iter().zip(list(sensor.get("normals")));
        let point = |(position, normal)| {
            let [position, normal] = [as_vector(position), as_vector(normal)];
            Some(Sensor::point(position?, normal?.normalize()))
        };
        return points
            .map(|it| point(it).ok_or("a point needs three numbers".to_owned()))
            .collect();
    }
    let [origin, u, v] = ["origin", "u", "v"].map(|key| vector(sensor, key));
    let (origin, u, v, normal) = (origin?, u?, v?, vector(sensor, "normal")?.normalize());
    let counts: Vec<f64> = list(sensor.get("counts")).iter().filter_map(as_number).collect();
    let [columns, rows] = <[f64; 2]>::try_from(counts).map_err(|_| "counts?")?;
    let (u, v) = (u / columns, v / rows);
    let cell = |number: usize| {
        let [i, j] = [number % columns as usize, number / columns as usize];
        let cell = Sensor::cell(origin + u * i as f64 + v * j as f64, u, v, normal);
        let is_mean = is(sensor, "quantity", "mean");
        if is_mean { cell } else { Sensor::point(cell.position, normal) }
    };
    Ok((0..(columns * rows) as usize).map(cell).collect())
}

fn sky(sky: &Value) -> Result<Sky, String> {
    let model = match (sky.get("model").and_then(Value::as_str), number(sky, "type")) {
        (Some("uniform"), _) => SkyModel::Uniform,
        (Some("cie"), Some(1.0)) => SkyModel::StandardOvercast,
        (Some("cie"), Some(16.0)) => SkyModel::Overcast,
        _ => return Err("expected an even or an overcast sky".to_owned()),
    };
    let zenith = number(sky, "zenith_luminance_cd_m2").ok_or("zenith_luminance_cd_m2?")?;
    Ok(Sky { model, zenith_luminance_cd_m2: zenith, ground_luminance_cd_m2: 0.0 })
}

/// Azimuths run from +y, north, over +x.
fn sun(sun: &Value) -> Result<Sun, String> {
    let angle = |key: &str| number(sun, key).map(f64::to_radians).ok_or_else(|| format!("{key}?"));
    let (altitude, azimuth) = (angle("altitude_deg")?, angle("azimuth_deg")?);
    let (sin, cos) = libm::sincos(altitude);
    let (east, north) = libm::sincos(azimuth);
    let normal_illuminance_lx = number(sun, "normal_illuminance_lx").ok_or("sun?")?;
    Ok(Sun { direction: DVec3::new(east * cos, north * cos, sin), normal_illuminance_lx })
}
