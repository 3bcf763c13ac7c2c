"""Values that do not change during a run: constants, what is computed of them, open parameters."""
