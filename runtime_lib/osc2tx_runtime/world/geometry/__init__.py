"""Closed forms of motion: curves, rate profiles, attitude on the road, neighbouring lanes."""
