//! The import graph of a crate: which module uses the items of which, and against which order.
//!
//! A *room* is a direct child module of a crate's root; a folder with its `mod.rs` is one room. The
//! rooms of a crate stand in an order, the ground floor first, and a room uses only rooms that
//! stand before it. Modules side by side in one folder need no order, but must not import each
//! other in a circle.
//!
//! [`targets`] finds the crates, [`tree`] parses one, `paths` collects the paths in a module,
//! `scope` resolves each to the module that defines its item, [`arrows`] makes them edges
//! between modules, [`order`] looks for circles and for the order with the fewest upward edges,
//! and [`rules`] tells the violations.

pub mod arrows;
pub mod order;
mod paths;
pub mod rules;
mod scope;
pub mod targets;
pub(crate) mod tests_left_out;
pub mod tree;
