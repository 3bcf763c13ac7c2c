"""Constraints of a scenario: collected, solved over domains, reported where they contradict."""
