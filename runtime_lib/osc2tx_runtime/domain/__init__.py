"""The domain model at run time: actors, actions, modifiers, signals, routes, placing, measuring."""
