"""Checks of the contents of members: behaviors, modifiers, constraints, coverage, events."""
