//! Simulations against closed forms.

mod balance;
mod cube;
mod furnace;
mod scenes;
