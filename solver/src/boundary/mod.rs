//! Boundary methods: one file a method, one line here.
//!
//! A method's file exports a [`MethodInfo`]: its name, its parameters with units and ranges, and how
//! it is built. The table [`METHODS`] is made from the list of modules below, so a new method is its
//! file and one line.

pub mod params;

pub use params::{MethodInfo, Param, ParamKind, SideMethod, Value};

macro_rules! methods {
    ($($module:ident),* $(,)?) => {
        $(pub mod $module;)*

        /// All boundary methods, in the order in which they are listed.
        pub static METHODS: &[&MethodInfo] = &[$(&$module::METHOD),*];
    };
}

methods! {
    free,
    roller,
    fixed,
    dashpot,
    damping_layer,
    extended,
}

/// The method called `name`.
pub fn find(name: &str) -> Option<&'static MethodInfo> {
    METHODS.iter().copied().find(|m| m.name == name)
}
