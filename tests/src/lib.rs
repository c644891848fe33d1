//! The acceptance gates live in `tests/`.
