"""Names in expressions: members, aliases, names of other dialects, suggestions."""
