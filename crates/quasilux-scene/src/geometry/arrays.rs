//! Triangles that are in memory already.

use super::DEFAULT_MATERIAL;
use super::builder::MeshBuilder;
use crate::{LoadError, TriangleArrays};
use glam::DVec3;

/// Reads triangles into `builder`. What is wrong with an index is told with the triangle's number.
pub(super) fn read(
    arrays: &TriangleArrays<'_>,
    builder: &mut MeshBuilder,
) -> Result<(), LoadError> {
    let file = builder.file().to_owned();
    let refuse = |message: String| LoadError::new(&file, None, message);
    check(arrays).map_err(refuse)?;
    let TriangleArrays { positions, triangles, material_of, materials, object } = *arrays;
    let object = builder.object(&if object.is_empty() { file.as_str() } else { object }.into());
    let materials: Vec<u32> = match materials {
        [] => vec![builder.material(DEFAULT_MATERIAL)],
        names => names.iter().map(|name| builder.material(name)).collect(),
    };
    for (number, triangle) in triangles.iter().enumerate() {
        let material = materials[material_of.get(number).map_or(0, |&index| index as usize)];
        let corners = triangle.map(|vertex| DVec3::from_array(positions[vertex as usize]));
        builder
            .triangle(object, material, corners)
            .map_err(|error| refuse(error.message(&format!("triangle {number}"))))?;
    }
    Ok(())
}

/// Checks the indices.
fn check(arrays: &TriangleArrays<'_>) -> Result<(), String> {
    let TriangleArrays { positions, triangles, material_of, materials, .. } = *arrays;
    if !material_of.is_empty() && material_of.len() != triangles.len() {
        let (given, triangles) = (material_of.len(), triangles.len());
        return Err(format!("{given} materials for {triangles} triangles; expected one for each"));
    }
    let (vertices, names) = (positions.len(), materials.len().max(1));
    let is_outside = |triangle: &[u32; 3]| triangle.iter().any(|&v| v as usize >= vertices);
    if let Some(number) = triangles.iter().position(is_outside) {
        let [a, b, c] = triangles[number];
        return Err(format!(
            "triangle {number} has the vertices {a}, {b}, {c}; expected indices below {vertices}, \
             the number of vertices"
        ));
    }
    match material_of.iter().position(|&index| index as usize >= names) {
        None => Ok(()),
        Some(number) => Err(format!(
            "triangle {number} has the material {}; expected an index below {names}, the number \
             of materials",
            material_of[number]
        )),
    }
}
