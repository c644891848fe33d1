//! Gates of boundary methods as such, one file a family, in one program: the closed forms that they
//! meet, their operators, what grows, what stays under a load, and the studies that compare them.

mod atlas;
mod damping_form;
mod explicit;
mod growth;
mod operator;
mod pml;
mod pml_space;
mod published_layer;
mod static_load;
mod sweep;
