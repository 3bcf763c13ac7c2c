"""Entities and their start: the elements `Entities` and `Init`."""
