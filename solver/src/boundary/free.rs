//! Free side: no traction.

use super::params::MethodInfo;

/// The method's entry.
pub static METHOD: MethodInfo = MethodInfo { name: "free", summary: "no traction", params: &[] };
