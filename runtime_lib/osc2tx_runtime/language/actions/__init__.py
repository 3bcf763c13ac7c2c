"""Bases of actions and modifiers, and their registry."""
