"""Types of expressions (§7.4).

`inference.infer` is the entry. It routes to: `names` (bare names, `it`, enum members), `literals`
(literals, lists, ranges), `access` (members, casts, indexing), `operators`, and `calls` (methods).
"""

from osc2tx.semantics.expressions.inference import infer

__all__ = ["infer"]
