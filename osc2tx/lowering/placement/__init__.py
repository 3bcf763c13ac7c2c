"""Where actors start: modifiers that hold at the start of the run."""
