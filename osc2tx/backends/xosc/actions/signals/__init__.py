"""Traffic lights and vehicle lights."""
