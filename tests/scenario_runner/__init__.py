"""OpenSCENARIO XML in ScenarioRunner itself, which ticks its tree over CARLA's client library."""
