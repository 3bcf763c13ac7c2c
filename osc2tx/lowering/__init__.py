"""Lowering: from the checked semantic model to the IR.

Input is a model without errors; output is an IR module and, for what no backend can express,
diagnostics of the 5xx family. Modules: `scenarios` (entry), `context` (what all of them share),
`value_types`, `unsupported_members`. Folders: `declarations` (members of scenarios and types),
`constraints` (values that are fixed, and domains of the others), `behavior` (the `do` tree),
`modifiers`, `placement` (modifiers that hold at the start of the run), `values` (expressions and
method calls), `coverage`.
"""

from osc2tx.lowering.scenarios import lower

__all__ = ["lower"]
