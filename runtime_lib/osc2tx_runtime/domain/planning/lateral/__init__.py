"""Plans of lateral motion: lanes, offsets, lateral speeds."""
