"""Steps of runs."""

DEFAULT_STEP = 0.05
"""Length of a step in seconds, unless the run states another one."""
