"""The language at run time: scenarios, their trees, events, values and the registry of actions."""
