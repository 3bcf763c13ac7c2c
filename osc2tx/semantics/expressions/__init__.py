"""Types of expressions (§7.4).

`infer.infer` is the entry. It routes to: `names` (bare names, `it`, enum members), `literals`
(literals, lists, ranges), `access` (members, casts, indexing), `operators`, and `calls` (methods).
"""

from osc2tx.semantics.expressions.infer import infer

__all__ = ["infer"]
