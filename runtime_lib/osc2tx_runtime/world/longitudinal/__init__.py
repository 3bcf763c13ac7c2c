"""Execution of longitudinal commands: speeds, gaps, positions over time, collision avoidance."""
