"""Measurements of states: distances, velocities, contacts, deviations from a reference."""
