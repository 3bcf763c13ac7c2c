"""The storyboard while it is built: acts, maneuvers, events and their names."""
