//! Closed forms, one file each: source, assumptions, and tests of their own.
//!
//! - [`elastic`]: moduli and wave speeds of an isotropic solid.
//! - [`dalembert`]: the struck elastic column.
//! - [`damping_layer`]: reflection of a harmonic wave from a viscous layer.
//! - [`lamb`]: line force on an elastic half-space.
//! - [`oblique`]: reflection of plane P and S waves that meet a boundary at an angle.
//! - [`quadrature`]: the Gauss-Legendre rule behind them.

pub mod dalembert;
pub mod damping_layer;
pub mod elastic;
pub mod lamb;
pub mod oblique;
pub mod quadrature;
