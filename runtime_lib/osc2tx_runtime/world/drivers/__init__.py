"""External drivers: their observations and controls, and the model of the driven vehicle."""
