"""Members of scenarios and types: actors, objects, fields, parameters."""
