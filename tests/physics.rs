//! The exact physics of the joint held to closed forms, to published numbers, to brute force and to
//! counting by hand. One file per law.

#[path = "physics/against_sliders.rs"]
mod against_sliders;
#[path = "physics/bounded.rs"]
mod bounded;
#[path = "physics/brute_force.rs"]
mod brute_force;
#[path = "physics/cells.rs"]
mod cells;
#[path = "physics/curves.rs"]
mod curves;
#[path = "physics/families.rs"]
mod families;
#[path = "physics/histories.rs"]
mod histories;
#[path = "physics/memory.rs"]
mod memory;
#[path = "physics/rainflow.rs"]
mod rainflow;
#[path = "physics/refusals.rs"]
mod refusals;
#[path = "physics/small_force.rs"]
mod small_force;
#[path = "physics/table1.rs"]
mod table1;
