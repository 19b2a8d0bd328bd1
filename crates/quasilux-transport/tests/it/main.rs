//! Simulations against closed forms.

mod balance;
mod coverage;
mod cube;
mod furnace;
mod scenes;
