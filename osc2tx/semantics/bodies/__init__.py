"""Checks of what members contain: behaviors, modifiers, constraints, coverage, events."""
