"""Handlers of actions and modifiers, and the modules that they share."""
