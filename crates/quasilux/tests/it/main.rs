//! The program from outside: arguments and files in; exit codes, messages and results out.

mod annual;
mod annual_kept;
mod area;
#[cfg(target_os = "linux")]
mod attacks;
mod bad_input;
mod bsdf;
#[path = "../../build/commit.rs"]
mod build_commit;
#[path = "../../build/fingerprint/mod.rs"]
mod build_fingerprint;
mod cameras;
#[allow(dead_code, reason = "pieces that only tests of the reader need")]
#[path = "../../../quasilux-photometry/tests/container/mod.rs"]
mod container;
mod daylight_factor;
mod direct;
mod door;
mod embedded;
mod experiment;
mod explain;
mod export;
mod fingerprint;
mod glazing;
mod gldf;
mod honeybee;
mod kept;
mod kernels;
mod keys;
#[cfg(target_os = "linux")]
mod killed;
mod limits;
mod manuals;
#[cfg(target_os = "linux")]
mod memory;
mod photometry;
mod points;
mod results;
mod resumed;
mod scenes;
mod sequences;
mod sky;
mod spread;
mod support;
mod tilt;
mod validation;
mod weather;
