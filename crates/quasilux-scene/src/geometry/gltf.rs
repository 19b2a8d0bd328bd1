//! glTF and GLB geometry: the node hierarchy, with names and base colours.
//!
//! Khronos Group, glTF 2.0 Specification, version 2.0.1 (2021), section numbers in brackets. The
//! crate `gltf` parses and validates the JSON; buffers are read by our own bounds-checked
//! [`Accessor`](super::gltf_accessor::Accessor). Animations, skins, cameras and textures are not
//! read, and lights belong to the project file.

use super::builder::{Look, MeshBuilder};
use super::gltf_buffers;
use super::gltf_primitive::{self, Target};
use crate::{Files, LoadError, Rgb, Warning};
use ::gltf::accessor::DataType;
use ::gltf::json::accessor::GenericComponentType;
use ::gltf::json::validation::Checked;
use ::gltf::material::AlphaMode;
use ::gltf::scene::Transform;
use ::gltf::{Document, Gltf, Mesh, Node, Semantic};
use glam::{DMat4, DQuat, DVec3, DVec4};
use quasilux_text::Position;
use std::collections::HashMap;
use std::sync::Arc;

/// Positions may be of integers.
const QUANTIZATION: &str = "KHR_mesh_quantization";
/// Required extensions that change no geometry, or that are read.
const READABLE_EXTENSIONS: [&str; 8] = [
    "EXT_texture_webp",
    "KHR_lights_punctual",
    QUANTIZATION,
    "KHR_texture_basisu",
    "KHR_texture_transform",
    "KHR_xmp_json_ld",
    "MSFT_texture_dds",
    "KHR_animation_pointer",
];

/// Most objects and lists in the JSON of a file: each takes up to 0.5 kB once it is read, whatever
/// it takes in the file.
const MAX_PARTS: usize = 1 << 21;

/// Reads a glTF or GLB file and the buffers that it names into `builder`.
pub(super) fn read(
    bytes: &[u8],
    files: &dyn Files,
    builder: &mut MeshBuilder,
    warnings: &mut Vec<Warning>,
) -> Result<(), LoadError> {
    let file = builder.file().to_owned();
    let error = |message: String| LoadError::new(&file, None, message);
    let Parsed { document, blob } = parse(&file, bytes)?;
    let buffers = gltf_buffers::read(&file, &document, blob, files).map_err(error)?;
    let mut names = Names::default();

    let mut skipped = 0;
    let mut textured = false;
    let mut material_of: HashMap<Option<usize>, u32> = HashMap::new();
    for PlacedNode { node, world_from_node } in nodes(&document).map_err(error)? {
        let Some(mesh) = node.mesh() else { continue };
        let name = names.name_of(&node, &mesh);
        let object = builder.object(&name);
        for primitive in mesh.primitives() {
            let material = primitive.material();
            textured |= material.pbr_metallic_roughness().base_color_texture().is_some();
            let material = match material_of.get(&material.index()) {
                Some(&known) => known,
                None => {
                    let index = describe(&material, builder, warnings);
                    material_of.insert(material.index(), index);
                    index
                }
            };
            let target = Target { object, material, world_from_node, name: &name };
            skipped +=
                gltf_primitive::read(&primitive, &buffers, &target, builder).map_err(error)?;
        }
    }
    let mut warn = |message: String| warnings.push(Warning::new(&file, None, message));
    if skipped > 0 {
        warn(format!("{skipped} primitives are points or lines: dropped"));
    }
    if textured {
        warn("textures are not read: the base colours are used alone".to_owned());
    }
    if document.extensions_used().any(|name| name == "KHR_lights_punctual") {
        warn("its lights are not read; lights belong to the project file".to_owned());
    }
    Ok(())
}

/// The validated document, and the binary chunk of a GLB.
struct Parsed {
    document: Document,
    blob: Option<Vec<u8>>,
}

fn parse(file: &str, bytes: &[u8]) -> Result<Parsed, LoadError> {
    let error = |message: String| LoadError::new(file, None, message);
    let is_binary = bytes.starts_with(b"glTF");
    let json = if is_binary { check_glb_header(bytes).map_err(error)? } else { bytes };
    let parts = json.iter().filter(|byte| matches!(byte, b'{' | b'[')).count();
    if parts > MAX_PARTS {
        return Err(error(format!(
            "the file has {parts} objects and lists of JSON; expected at most {MAX_PARTS}"
        )));
    }
    let Gltf { document, blob } =
        Gltf::from_slice_without_validation(bytes).map_err(|e| match e {
            ::gltf::Error::Deserialize(json) if !is_binary => LoadError::new(
                file,
                (json.line() > 0)
                    .then(|| Position { line: json.line(), column: json.column().max(1) }),
                format!("not a valid glTF file: {json}"),
            ),
            other => error(format!("not a valid glTF file: {other}")),
        })?;
    let mut json = document.into_json();
    let required = |name: &&String| !READABLE_EXTENSIONS.contains(&name.as_str());
    if let Some(name) = json.extensions_required.iter().find(required) {
        let name: String = name.chars().take(60).collect();
        return Err(error(format!(
            "the file requires the extension \"{name}\", which is not built; expected plain glTF \
             2.0"
        )));
    }
    json.extensions_required.clear();
    check_positions(&json).map_err(error)?;
    let document = Document::from_json(json).map_err(|e| match e {
        ::gltf::Error::Validation(faults) => match faults.first() {
            Some((path, fault)) => error(format!("not a valid glTF file: {path}: {fault}")),
            None => error("not a valid glTF file".to_owned()),
        },
        other => error(format!("not a valid glTF file: {other}")),
    })?;
    Ok(Parsed { document, blob })
}

/// Checks that accessors of positions exist, which the validation of `gltf` looks up unchecked, and
/// that they are of floats unless the file says that they may be of integers.
fn check_positions(json: &::gltf::json::Root) -> Result<(), String> {
    let key = Checked::Valid(Semantic::Positions);
    let is_quantized = json.extensions_used.iter().any(|name| name == QUANTIZATION);
    for (index, mesh) in json.meshes.iter().enumerate() {
        let positions = mesh.primitives.iter().filter_map(|p| p.attributes.get(&key));
        for number in positions.map(|accessor| accessor.value()) {
            let Some(accessor) = json.accessors.get(number) else {
                let count = json.accessors.len();
                return Err(format!(
                    "mesh {index} refers to accessor {number}, but the file has {count}"
                ));
            };
            let is_float = matches!(
                accessor.component_type,
                Checked::Valid(GenericComponentType(DataType::F32))
            );
            if !is_float && !is_quantized {
                return Err(format!(
                    "accessor {number} has positions of another type; expected 32-bit floats, or \
                     the extension {QUANTIZATION}"
                ));
            }
        }
    }
    Ok(())
}

/// Checks lengths of the 12-byte header and of the first chunk [4.4] against the bytes that exist;
/// returns that chunk.
fn check_glb_header(bytes: &[u8]) -> Result<&[u8], String> {
    let word = |at: usize| {
        let word = bytes.get(at..at + 4).and_then(|slice| <[u8; 4]>::try_from(slice).ok());
        word.map(u32::from_le_bytes).ok_or("the GLB header is cut off; expected 20 bytes")
    };
    let (version, length, chunk) = (word(4)?, word(8)?, word(12)?);
    if version != 2 {
        return Err(format!("GLB version {version}; expected 2"));
    }
    if (length as usize) < 20 || length as usize > bytes.len() {
        let size = bytes.len();
        return Err(format!(
            "the GLB header says {length} bytes; expected {size}, the file's size"
        ));
    }
    if chunk as usize > bytes.len() - 20 {
        return Err(format!("the first GLB chunk says {chunk} bytes, more than the file holds"));
    }
    Ok(&bytes[20..20 + chunk as usize])
}

/// Names of objects; those of meshes are kept once for all their instances.
#[derive(Default)]
struct Names {
    of_mesh: HashMap<usize, Arc<str>>,
}

impl Names {
    /// That of a node, or else of its mesh, or else its number.
    fn name_of(&mut self, node: &Node<'_>, mesh: &Mesh<'_>) -> Arc<str> {
        match (node.name(), mesh.name()) {
            (Some(name), _) => name.into(),
            (None, Some(name)) => {
                Arc::clone(self.of_mesh.entry(mesh.index()).or_insert_with(|| name.into()))
            }
            (None, None) => format!("node_{}", node.index()).into(),
        }
    }
}

/// A node with its transform to the world.
struct PlacedNode<'a> {
    node: Node<'a>,
    world_from_node: DMat4,
}

/// All nodes of the default scene with their transforms to the world; of the first scene where no
/// default is named, and all roots where there is no scene.
fn nodes(document: &Document) -> Result<Vec<PlacedNode<'_>>, String> {
    let mut seen = vec![false; document.nodes().len()];
    let scene = document.default_scene().or_else(|| document.scenes().next());
    let roots: Vec<Node<'_>> = match scene {
        Some(scene) => scene.nodes().collect(),
        None => {
            let mut is_child = vec![false; seen.len()];
            document
                .nodes()
                .flat_map(|node| node.children())
                .for_each(|c| is_child[c.index()] = true);
            document.nodes().filter(|node| !is_child[node.index()]).collect()
        }
    };
    let mut stack: Vec<_> = roots.into_iter().rev().map(|node| (node, DMat4::IDENTITY)).collect();
    let mut found = Vec::new();
    while let Some((node, world_from_parent)) = stack.pop() {
        // Nodes form strict trees [3.5.2]: this also bounds the walk.
        if std::mem::replace(&mut seen[node.index()], true) {
            return Err(format!("node {} has two parents or is its own ancestor", node.index()));
        }
        let world_from_node = world_from_parent * local(&node)?;
        if !world_from_node.is_finite() {
            return Err(format!("the transform of node {} is not finite", node.index()));
        }
        let children: Vec<_> = node.children().collect();
        stack.extend(children.into_iter().rev().map(|child| (child, world_from_node)));
        found.push(PlacedNode { node, world_from_node });
    }
    Ok(found)
}

/// The transform from a node to its parent [3.5.3].
fn local(node: &Node<'_>) -> Result<DMat4, String> {
    match node.transform() {
        Transform::Matrix { matrix } => {
            let column = |c: usize| DVec4::from_array(matrix[c].map(f64::from));
            Ok(DMat4::from_cols(column(0), column(1), column(2), column(3)))
        }
        Transform::Decomposed { translation, rotation, scale } => {
            let rotation = DQuat::from_array(rotation.map(f64::from));
            if !(rotation.length_squared() > 1e-12 && rotation.is_finite()) {
                return Err(format!("the rotation of node {} is no quaternion", node.index()));
            }
            Ok(DMat4::from_scale_rotation_translation(
                DVec3::from_array(scale.map(f64::from)),
                rotation.normalize(),
                DVec3::from_array(translation.map(f64::from)),
            ))
        }
    }
}

/// Registers a material: its base colour is its diffuse reflectance.
fn describe(
    material: &::gltf::Material<'_>,
    builder: &mut MeshBuilder,
    warnings: &mut Vec<Warning>,
) -> u32 {
    let Some(index) = material.index() else {
        return builder.material(super::DEFAULT_MATERIAL);
    };
    let name = material.name().map_or_else(|| format!("material_{index}"), str::to_owned);
    let id = builder.material(&name);
    let [r, g, b, alpha] = material.pbr_metallic_roughness().base_color_factor().map(f64::from);
    let is_clear = material.alpha_mode() == AlphaMode::Blend && alpha < 1.0;
    // A channel that is not a number is taken as black.
    let reflectance = Rgb([r, g, b].map(|c| if c > 0.0 { c.min(1.0) } else { 0.0 }));
    let emits = material.emissive_factor().iter().any(|&c| c > 0.0);
    builder.describe(id, Look { reflectance, emits, is_clear }, warnings);
    id
}
