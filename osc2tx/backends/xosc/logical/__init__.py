"""Open parameters: what a scenario leaves to be chosen, and the values it may have."""
