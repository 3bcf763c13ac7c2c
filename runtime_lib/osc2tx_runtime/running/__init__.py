"""One run of a scenario: settings, the loop of instants, the trace, the verdict."""
