//! Projects loaded from maps of files: what is right, what is refused, and where.

mod arrays;
mod attacks;
mod bad_input;
mod blinds;
mod cameras;
mod corpus;
mod export;
mod glazing;
mod gltf;
mod honeybee;
mod honeybee_corpus;
mod honeybee_findings;
mod honeybee_import;
mod honeybee_mutations;
mod materials;
mod mutations;
mod obj;
mod outside;
mod panorama;
mod project;
mod project_cases;
mod reports;
mod support;
mod tilt;
mod walls;
mod weather;
