"""Simulators behind the interface `world.plant`; each is imported when a run requests it."""
