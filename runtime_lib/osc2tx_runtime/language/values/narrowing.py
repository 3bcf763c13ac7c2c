"""What a scenario leaves of a declaration that it inherits."""

from __future__ import annotations

from types import FunctionType
from typing import Any

from osc2tx_runtime.language.values.written_units import AnyUnit
from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True)
class Narrowed:
    """A declaration of a base, as constraints of the scenario narrow it.

    Attributes:
        given: The value or default, or a function that gives it once the base is declared so far.
        given_domain: What the value must keep to; likewise.
        unit: In which the scenario states it; empty if that is the unit of the base.
        is_fixed: Nothing can change the value.
    """

    given: Any
    given_domain: Any = None
    unit: AnyUnit = ""
    is_fixed: bool = False

    @property
    def value(self) -> Any:
        """The value or default."""
        return _computed(self.given)

    @property
    def domain(self) -> Any:
        """What the value must keep to; None if that is the default."""
        return _computed(self.given_domain)


def _computed(given: Any) -> Any:
    return given() if isinstance(given, FunctionType) else given
