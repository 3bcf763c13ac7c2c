"""Parameters of library modifiers and actions that exclude each other (§8.9.1.3)."""

from __future__ import annotations

from collections.abc import Sequence

from osc2tx.catalogue import catalogue
from osc2tx.semantics.resolution import Resolution
from osc2tx.semantics.symbols import (
    ActionSymbol,
    FieldSymbol,
    ModifierSymbol,
    ParameterSymbol,
    Symbol,
)
from osc2tx.syntax import ast
from osc2tx_classes import replace
from osc2tx_rules import Rule, violations


class _Written(dict[str, ast.Expression]):
    """Arguments by parameter; what they are is nothing that these rules ask for."""

    def word(self, name: str) -> None:
        """No rule looks at words."""

    def number(self, name: str) -> None:
        """No rule looks at numbers."""


def check_exclusive(
    r: Resolution,
    callee: Symbol,
    pairs: Sequence[tuple[FieldSymbol | ParameterSymbol, ast.Expression]],
) -> None:
    """Report arguments of a library modifier or action of which only one may be given."""
    given = _Written({parameter.name: value for parameter, value in pairs})
    for rule in _rules(callee):
        if rule.kind == "at_most_one":
            in_order = tuple(name for name in given if name in rule.of)
            for broken in violations(f"`{callee.name}`", [replace(rule, of=in_order)], given):
                assert broken.parameter is not None
                r.report("OSC408", given[broken.parameter].span, f"`{callee.name}`: {broken.text}")


def _rules(callee: Symbol) -> Sequence[Rule]:
    if not isinstance(callee, ModifierSymbol | ActionSymbol) or callee.origin == "user":
        return ()
    if isinstance(callee, ActionSymbol):
        action = catalogue().actions.get(callee.qualified_name)
        return () if action is None else action.rules
    modifier = catalogue().modifiers.get(callee.name)
    return () if modifier is None else modifier.rules
