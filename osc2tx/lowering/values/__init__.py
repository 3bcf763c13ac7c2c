"""Expressions, references, method calls and their arguments."""
