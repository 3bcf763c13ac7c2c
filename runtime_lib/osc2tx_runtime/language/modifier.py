"""The base class of all modifiers."""

from __future__ import annotations

from dataclasses import fields
from typing import Any, ClassVar

from osc2tx_classes import dataclass
from osc2tx_rules import Rule
from osc2tx_runtime.language.argument_rules import check_arguments
from osc2tx_runtime.language.modifier_facts import ModifierFacts

__all__ = ["Modifier"]


@dataclass(frozen=True, slots=True)
class Modifier:
    """Base of all modifiers.

    Attributes:
        name: Name in the DSL.
        facts: What is stated of it at its registration.
        rules: Which parameters go together; the compiler knows them as well.
    """

    name: ClassVar[str] = ""
    facts: ClassVar[ModifierFacts] = ModifierFacts()
    rules: ClassVar[tuple[Rule, ...]] = ()

    def __post_init__(self) -> None:
        """Checks the rules. With slots, subclasses cannot reach it by `super()`."""
        check_arguments(self.name, self.rules, self.given())
        self.check()

    def check(self) -> None:
        """Checks what rules cannot say."""

    @property
    def is_start(self) -> bool:
        """Whether it is a demand on the start alone."""
        return getattr(self, "at", "all") == "start" and self.facts.rules.starts

    def given(self) -> dict[str, Any]:
        """Parameters with values that are not those of a modifier without arguments."""
        kind = type(self)
        if kind not in _DEFAULTS:
            _DEFAULTS[kind] = tuple((field.name, field.default) for field in fields(kind))
        values = ((name, default, getattr(self, name)) for name, default in _DEFAULTS[kind])
        return {
            name: value for name, default, value in values if value is not None and value != default
        }


_DEFAULTS: dict[type[Modifier], tuple[tuple[str, object], ...]] = {}
"""What the parameters of modifiers are without arguments, of those that were looked at."""
