"""Positions, paths, trajectories and routes."""
