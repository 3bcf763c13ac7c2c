"""The OpenDRIVE maps that ship with the runtime library, as data, and what writes them.

`specs` says what a map consists of, `shapes` how reference lines run, `motorways` and `streets`
have the maps, `xodr` writes them.
"""
