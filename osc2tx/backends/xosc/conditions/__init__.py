"""Conditions: expressions, and what can be measured, as triggers."""
