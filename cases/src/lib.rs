//! The case runner.
pub mod checks;
pub mod draft;
pub mod error;
pub mod field;
pub mod prepare;
pub mod scene;
pub mod scenes;
pub mod spec;
