//! What is true. Depends on nothing of the solver.
//!
//! - [`analytic`]: one file a closed form, each with source, assumptions and tests of its own.
//! - [`certified`]: stored series of extended domains.
//! - [`claim`]: claims as data, their acceptance, kinds of evidence.
//! - [`paper`]: numbers as the papers print them, with the place of each.
//! - [`stored`]: loader of stored tables, which refuses what is not whole.

pub mod analytic;
pub mod certified;
pub mod claim;
pub mod paper;
pub mod stored;
