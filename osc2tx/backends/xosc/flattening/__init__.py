"""Flattening: the tree of a scenario as acts and events."""
