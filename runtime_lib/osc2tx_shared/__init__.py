"""Modules that compiler and runtime share; they import the standard library alone."""
