"""Friction, and the accelerations that the grip of the road allows."""
