"""Invocations of actions as events of the storyboard, and their ends."""
