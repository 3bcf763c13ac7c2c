"""Paths and trajectories: `path_values` of a scenario, `path_curves`, `relative_paths`."""
