"""Warnings about valid scenarios: unreachable, unused and endless parts."""
