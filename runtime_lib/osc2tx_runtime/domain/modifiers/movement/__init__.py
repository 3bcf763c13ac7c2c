"""Movement modifiers: how an action is carried out (DSL 8.9)."""
