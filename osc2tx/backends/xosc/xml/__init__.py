"""Elements, schema, names, and the profiles of tools that read documents."""
