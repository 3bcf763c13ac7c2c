"""Speeds, accelerations, and gaps to other actors."""
