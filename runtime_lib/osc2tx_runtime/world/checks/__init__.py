"""Checks of values and commands from code outside this package."""
