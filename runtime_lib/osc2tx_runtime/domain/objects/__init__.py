"""What objects are: `base` of all actors, `physical_objects` with their `parts`.

What a scenario does not say of them is in `part_defaults`. Objects that move have actions and are
`actors`.
"""
