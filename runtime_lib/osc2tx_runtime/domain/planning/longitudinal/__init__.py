"""Plans of longitudinal motion: speeds, positions over time, goals."""
