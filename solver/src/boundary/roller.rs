//! Roller: the normal displacement is held.

use super::params::MethodInfo;

/// The method's entry.
pub static METHOD: MethodInfo = MethodInfo { name: "roller", summary: "normal displacement held, tangential free", params: &[] };
