"""Modules of both compiler and runtime; they only import the standard library."""
