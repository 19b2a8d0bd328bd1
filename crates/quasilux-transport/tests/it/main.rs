//! Simulations against closed forms.

mod adaptivity;
mod agreement;
mod area_luminaires;
mod balance;
mod cameras;
mod corridor;
mod coverage;
mod cube;
mod dozen;
mod dozen_scenes;
mod element_size;
mod explain;
mod first_shot;
mod furnace;
mod hall;
mod images;
mod joining;
mod materials;
mod mirrored_light;
mod scenes;
mod snapshots;
mod spotlight;
mod states;
mod terms;
mod traps;
mod ways;
