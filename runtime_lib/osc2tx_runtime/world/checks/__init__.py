"""Checks of values and commands that code outside this package hands in."""
