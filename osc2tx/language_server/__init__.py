"""The language server: what an editor asks about a scenario file, over the stages of the compiler.

It speaks the Language Server Protocol through pygls (extra `lsp`). Modules, in reading order:
`positions` (offsets and places of the protocol), `documents` (a text with its model),
`project` (the open files and the others), then one module for each kind of question
(`problems`, `navigation`, `descriptions`, `completion`, `decorations`), and `server`, which
connects them with the protocol.
"""
