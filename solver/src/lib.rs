//! What moves: grid, points, kernels, boundary methods, time integration.
