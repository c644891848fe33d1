//! Closed forms, one file each: source, assumptions, and tests of their own.
//!
//! - [`elastic`]: moduli and wave speeds of an isotropic solid.
//! - [`dalembert`]: the struck elastic column.
//! - [`damping_layer`]: reflection of a harmonic wave from a viscous layer.
//! - [`impact`]: soil against a rigid body: pressure of the blow, arrivals of waves and echoes.
//! - [`lamb`]: line force on an elastic half-space.
//! - [`oblique`]: reflection of plane P and S waves that meet a boundary at an angle.
//! - [`slip_line`]: bearing of a shallow pipe in clay.
//! - [`quadrature`]: the Gauss-Legendre rule behind them.

pub mod dalembert;
pub mod damping_layer;
pub mod elastic;
pub mod impact;
pub mod lamb;
pub mod oblique;
pub mod quadrature;
pub mod slip_line;
