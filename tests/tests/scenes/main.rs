//! Gates of the solver, its bases and the scenes, one file a family, in one program.

mod bases;
mod budget;
mod compression_1d;
mod cube_source;
mod explicit_column;
mod explicit_errors;
mod explicit_point_source;
mod explicit_transfer;
mod goodness;
mod inclusion;
mod lamb;
mod moving_layers;
mod mudmat;
mod mutations;
mod pipe;
mod point_source;
mod rigid;
mod solver;
mod transfer;
