//! The hierarchy against its slow twin, meshes that must not leak, and meshes that are hard to
//! build over.

mod batches;
mod builds;
mod degenerate_meshes;
mod groups;
mod leaks;
mod meshes;
mod rays;
mod strange;
mod twin;
