"""Constraints as fixed values, domains and conditions of parameters."""
