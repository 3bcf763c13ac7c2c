"""Actions and modifiers: handlers that write them down, and what these share."""
