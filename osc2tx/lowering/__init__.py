"""Lowering: from the checked semantic model to the IR.

Input is a model without errors; output is an IR module and, for what no backend can express,
diagnostics of the 5xx family. Modules: `scenarios` (entry, declarations), `constraints` (what
`keep` fixes), `behaviors` (the `do` tree), `triggers`, `expressions`, `names` (readable names
of nodes), `placement` (what holds at the start of the run, taken out of the tree).
"""

from osc2tx.lowering.scenarios import lower

__all__ = ["lower"]
