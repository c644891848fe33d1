//! Gates of the solver, its bases and the scenes, one file a family, in one program.

mod bases;
mod budget;
mod compression_1d;
mod cube_source;
mod goodness;
mod lamb;
mod mutations;
mod point_source;
mod solver;
mod transfer;
