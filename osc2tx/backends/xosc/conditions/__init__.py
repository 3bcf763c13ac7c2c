"""Expressions and measured quantities as conditions of triggers."""
