"""Modifiers: of invocations, of all actions of an actor, and user-defined ones."""
