"""The `do` tree: compositions, invocations, triggers, durations."""
