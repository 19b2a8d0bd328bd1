//! The hierarchy against its slow twin, and meshes that must not leak.

mod batches;
mod groups;
mod leaks;
mod meshes;
mod twin;
