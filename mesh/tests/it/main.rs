//! What the mesh crate promises, tested from outside.

mod allocation;
mod boxes;
mod generated;
mod gmsh;
mod gmsh_broken;
mod gmsh_damage;
mod gmsh_foreign;
mod gmsh_kinds;
mod gmsh_orientation;
mod gmsh_part;
mod motion;
mod motion_errors;
mod quality;
mod solid;
mod solid_refusals;
mod solid_transfer;
mod validation;
mod vtu;
