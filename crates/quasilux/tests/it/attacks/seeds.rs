//! Good inputs of every kind, from which bad ones are made.

use super::{limited, room};
use crate::bsdf::sheet;
use crate::photometry::EVERYWHERE_LDT;
use crate::support::Folder;
use std::fs;

/// A file that commands read, and those commands.
pub(super) struct Seed {
    pub(super) file: &'static str,
    pub(super) bytes: Vec<u8>,
    pub(super) commands: Vec<Vec<&'static str>>,
}

const RUN: [&str; 8] = ["run", "room.toml", "--out", "out", "--samples", "2", "--threads", "2"];

/// The corners of a triangle, and the buffer that has them.
pub(super) const TRIANGLE: [f32; 9] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
const BUFFER: &str = r#"{"byteLength": 36, "uri":
"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}"#;

const GLTF: &str = r#"{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
"nodes": [{"name": "a", "mesh": 0, "children": [2]}, {"mesh": 0, "scale": [-1, 1, 2]},
{"translation": [0, 0, 1], "rotation": [0, 0, 0, 1], "mesh": 0}],
"meshes": [{"name": "sail", "primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
"materials": [{"name": "wall", "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.5, 0.5, 1]}}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
"min": [0, 0, 0], "max": [1, 1, 0]}],
"bufferViews": [{"buffer": 0, "byteLength": 36}],
"buffers": [BUFFER]}"#;

/// One triangle some times.
pub(super) fn gltf(buffer: &str) -> String {
    GLTF.replace("BUFFER", buffer)
}

const TM33: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<IESTM33-18><Version>1.1</Version><Header><Manufacturer>none</Manufacturer>
<CatalogNumber>1</CatalogNumber><Description>disk</Description><Laboratory>none</Laboratory>
<ReportNumber>1</ReportNumber><ReportDate>2026-01-01</ReportDate></Header>
<Luminaire><Dimensions><Length>10</Length><Width>10</Width><Height>0</Height></Dimensions>
</Luminaire>
<Emitter><Quantity>1</Quantity><LuminousData><LuminousIntensity><AbsolutePhotometry>true
</AbsolutePhotometry><SymmType>Symm_None</SymmType><NumberMeasured>6</NumberMeasured>
<NumberHorz>2</NumberHorz><NumberVert>3</NumberVert><IntData h="0" v="0">100</IntData>
<IntData h="0" v="45">80</IntData><IntData h="0" v="90">20</IntData>
<IntData h="180" v="0">100</IntData><IntData h="180" v="45">80</IntData>
<IntData h="180" v="90">20</IntData></LuminousIntensity></LuminousData></Emitter></IESTM33-18>"#;

const MTL: &str = "newmtl wall\nKd 0.5 0.5 0.5\nnewmtl panel\nKd 0 0 0\nKe 1 1 1\nmap_Kd a.png\n";

/// A folder in which all commands of all seeds do well, as far as they can, and the seeds.
pub(super) fn seeds() -> (Folder, Vec<Seed>) {
    let folder = room("generated");
    folder.write("room.mtl", MTL);
    folder.write("room.obj", format!("mtllib room.mtl\n{}", folder.read("room.obj")));
    folder.write("ball.ldt", EVERYWHERE_LDT);
    folder.write("lamp.xml", TM33);
    folder.write("sheet.xml", sheet());
    folder.write("room.gltf", gltf(BUFFER));
    let text = folder.read("room.toml");
    folder.write("sails.toml", text.replace("\"room.obj\"", "\"room.obj\", \"room.gltf\""));
    let more = [&["--plan", "plan.json"][..], &["--checkpoint", "run.ck", "--samples", "2"]];
    let made = [
        vec!["plan", "room.toml", "--samples", "4", "--out", "plan.json"],
        [&["shard", "room.toml", "--shard", "0/2", "--out", "a.part"][..], more[0]].concat(),
        [&["shard", "room.toml", "--shard", "1/2", "--out", "b.part"][..], more[0]].concat(),
        [&["run", "room.toml", "--out", "out", "--quiet"][..], more[1]].concat(),
    ];
    for arguments in made {
        let run = limited(&folder, &arguments);
        assert!(matches!(run.code, Some(0 | 3)), "{arguments:?}: {}", run.stderr);
    }
    let photometry = |file| vec!["photometry", file, "--json"];
    let of_sails = RUN.map(|word| if word == "room.toml" { "sails.toml" } else { word }).to_vec();
    let list = [
        ("room.toml", vec![RUN.to_vec(), vec!["check", "room.toml", "--out", "out"]]),
        ("room.obj", vec![RUN.to_vec()]),
        ("room.mtl", vec![RUN.to_vec()]),
        ("room.gltf", vec![of_sails]),
        ("lamp.ies", vec![photometry("lamp.ies"), RUN.to_vec()]),
        (
            "ball.ldt",
            vec![photometry("ball.ldt"), vec!["photometry", "ball.ldt", "--svg", "b.svg"]],
        ),
        ("lamp.xml", vec![photometry("lamp.xml")]),
        ("sheet.xml", vec![vec!["bsdf", "sheet.xml", "--json"]]),
        ("plan.json", vec![[&["run", "room.toml", "--out", "out"][..], more[0]].concat()]),
        ("run.ck", vec![vec!["resume", "run.ck", "--out", "out"]]),
        ("a.part", vec![vec!["merge", "a.part", "b.part", "--out", "out"]]),
    ];
    let seed = |(file, commands)| {
        let bytes = fs::read(folder.path(file)).expect("it was made");
        Seed { file, bytes, commands }
    };
    let seeds = list.into_iter().map(seed).collect();
    (folder, seeds)
}
