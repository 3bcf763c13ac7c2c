"""The language server: answers about a scenario file for editors, by the stages of the compiler.

It speaks the Language Server Protocol through pygls (extra `lsp`). Modules, in reading order:
`positions` (offsets and positions of the protocol), `documents` (a text with its model),
`project` (the open files and the others), then one module for each kind of question
(`problems`, `navigation`, `descriptions`, `completion`, `decorations`), and `server`, which
connects them with the protocol.
"""
