"""Rules of calls: which arguments of an action or modifier, and which modifiers, go together.

The runtime states the rules with its classes and checks calls when a module runs; the compiler
reads them from its catalogue and checks the same calls before. Both use the interpreters here,
which see a call through a small protocol. The package only imports the standard library.
"""

from __future__ import annotations

from osc2tx_shared.rules.arguments import (
    Given,
    Rule,
    Violation,
    above,
    at_least,
    at_least_one,
    at_most,
    at_most_one,
    none_of,
    violations,
)
from osc2tx_shared.rules.combinations import (
    LATERAL_SPEED,
    Call,
    Clash,
    ModifierRules,
    Sort,
    Timing,
    clashes,
    is_across,
    is_admissible_range,
    sorts_of,
)

__all__ = [
    "LATERAL_SPEED",
    "Call",
    "Clash",
    "Given",
    "ModifierRules",
    "Rule",
    "Sort",
    "Timing",
    "Violation",
    "above",
    "at_least",
    "at_least_one",
    "at_most",
    "at_most_one",
    "clashes",
    "is_across",
    "is_admissible_range",
    "none_of",
    "sorts_of",
    "violations",
]
