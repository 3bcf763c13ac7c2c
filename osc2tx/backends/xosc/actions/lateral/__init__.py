"""Lane changes and lateral offsets."""
