"""Durations, overlaps and overrides of compositions, and conflicts between their members."""
