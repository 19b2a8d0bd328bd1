//! Projects loaded from maps of files: what is right, what is refused, and where.

mod arrays;
mod attacks;
mod bad_input;
mod blinds;
mod cameras;
#[allow(dead_code, reason = "pieces that only tests of the reader need")]
#[path = "../../../quasilux-photometry/tests/container/mod.rs"]
mod container;
mod corpus;
mod export;
mod glazing;
mod gldf;
mod gltf;
mod honeybee;
mod honeybee_corpus;
mod honeybee_findings;
mod honeybee_import;
mod honeybee_mutations;
mod lengths;
mod materials;
mod mutations;
mod obj;
mod outside;
mod panorama;
mod project;
mod project_cases;
mod radiance;
mod radiance_corpus;
mod radiance_export;
mod radiance_faults;
mod radiance_import;
mod radiance_limits;
mod radiance_mutations;
mod reports;
mod support;
mod tilt;
mod walls;
mod weather;
