"""Traffic lights, stop lines, sun and moon."""
