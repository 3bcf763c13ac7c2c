"""Objects: `base` of all actors, `physical_objects` with their `parts`.

Defaults for undeclared parts are in `part_defaults`. Objects that move have actions and are
`actors`.
"""
