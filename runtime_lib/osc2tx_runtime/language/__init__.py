"""The language at run time, without its domain model: independent of actor and action types.

In order of control flow: a `scenario` (`scenario_values`, `scenario_parts`) makes its tree of the
nodes in `tree`; `registry` finds the class of an `action` by its `method`. All nodes share the
`context` of a run: its `settings`, its `slots` and its `trace`, and the nodes that are `resting`.
The language's view of actors and modifiers is in `declared` and `modifier`; `source_map` maps nodes
to source lines.
"""

from __future__ import annotations

import osc2tx_runtime.language.light_py_trees  # noqa: F401 (before anything else of it is imported)
