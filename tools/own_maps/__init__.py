"""The OpenDRIVE maps that ship with the runtime library, as data, and their writer.

`specs` are the elements of a map, `shapes` the courses of reference lines, `motorways` and
`streets` have the maps, `xodr` writes them.
"""
