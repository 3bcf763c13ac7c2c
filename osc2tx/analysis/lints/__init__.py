"""Warnings about scenarios that are valid: what never happens, is never used or never ends."""
