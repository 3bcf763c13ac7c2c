"""Declarations: collected from all files, imported, extended, inherited, resolved to types."""
