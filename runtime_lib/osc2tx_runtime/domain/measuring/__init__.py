"""Measured values of actors and weather: `object_position`, `object_measurements`, `weather`."""
