"""Friction, and the accelerations within the grip limit of the road."""
