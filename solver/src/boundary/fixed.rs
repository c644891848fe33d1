//! Fixed side: all displacements are held.

use super::params::MethodInfo;

/// The method's entry.
pub static METHOD: MethodInfo = MethodInfo { name: "fixed", summary: "all displacements held", params: &[] };
