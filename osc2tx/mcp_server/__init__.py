"""`osc2tx mcp`: the compiler as tools of a language model, by the Model Context Protocol.

`answers` has the tools as functions of texts; `server` offers them over the protocol, and is the
only module that imports the library `mcp`.
"""
