"""What is read of actors and weather: `object_position`, `object_measurements`, `weather`."""
