"""Motion of one actor over one step, trailers included, and its limits."""
