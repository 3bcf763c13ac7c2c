"""Map modifiers: properties of declared roads, lanes and routes (DSL 8.12.2.2)."""
