"""Constants, constant folding, and symbolic numbers of open parameters."""
