"""Simulators behind the seam of `world.plant`; each is imported when a run asks for it."""
