"""Goals of measured actors: distances to them, and when they are reached."""
