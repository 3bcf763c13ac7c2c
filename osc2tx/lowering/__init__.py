"""Lowering: from the checked semantic model to the IR.

Input is a model without errors; output is an IR module and, diagnostics of the 5xx family for
constructs that no backend can express. Modules: `scenarios` (entry), `context` (shared state),
`value_types`, `unsupported_members`. Folders: `declarations` (members of scenarios and types),
`constraints` (fixed values, domains of the others), `behavior` (the `do` tree),
`modifiers`, `placement` (modifiers at the start of the run), `values` (expressions and method
calls), `coverage`.
"""

from osc2tx.lowering.scenarios import lower

__all__ = ["lower"]
