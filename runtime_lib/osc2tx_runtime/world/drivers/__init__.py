"""External drivers: what they observe and answer, and the vehicle model that carries it out."""
