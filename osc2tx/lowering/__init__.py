"""Lowering: from the checked semantic model to the IR.

Input is a model without errors; output is an IR module and, for what no backend can express,
diagnostics of the 5xx family. Modules: `scenarios` (entry), `declarations` (members), `constraints`
(what they leave of the values; `parameter_domains` and `equations` write that down), `behaviors`
(the `do` tree), `invocations` and `modifiers` in it, `triggers`, `expressions`, `calls` of methods
(also `external` ones), `type_conversions`, `coverage`, `node_names` (readable names of nodes),
`declaration_order` (of values), `initial_placement` (what holds at the start of the run, taken out
of the tree), `user_actions` and `user_types` (what the scenario's files declare), `combined_types`
(of objects with several conditional types).
"""

from osc2tx.lowering.scenarios import lower

__all__ = ["lower"]
