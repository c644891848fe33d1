//! Unknowns and residuals: regions of points, terms on nodes, and the model that joins them.
//!
//! - [`kernel`]: what a region of points and a term on nodes have to say.
//! - [`bulk`]: plain solid, kept on nodes or carried by points.
//! - [`flowing`]: points that explicit steps move.
//! - [`model`]: points, nodes, regions and terms joined; `system` is what integrators see of it,
//!   [`stiffness`] its matrices, [`inertia`] its lumped or consistent masses, [`transfer`] the motion
//!   between points and nodes, [`balance`] its energy and momentum, `hold` its held, driven and
//!   released unknowns.

pub mod balance;
pub mod bulk;
pub mod flowing;
mod hold;
pub mod inertia;
pub mod kernel;
pub mod model;
pub mod stiffness;
mod system;
pub mod transfer;
