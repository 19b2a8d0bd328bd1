//! Simulations against closed forms.

mod agreement;
mod balance;
mod coverage;
mod cube;
mod furnace;
mod hall;
mod scenes;
mod traps;
