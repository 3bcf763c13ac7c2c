"""Paths and trajectories: points of a scenario, curves in the world."""
