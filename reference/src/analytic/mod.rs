//! Closed forms, one file each.
