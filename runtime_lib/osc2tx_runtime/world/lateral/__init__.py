"""Execution of lateral commands: lanes, offsets, curves, routes, attitude."""
