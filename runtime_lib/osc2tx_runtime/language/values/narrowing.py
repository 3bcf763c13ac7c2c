"""Inherited declarations, narrowed by constraints of the scenario."""

from __future__ import annotations

from types import FunctionType
from typing import Any

from osc2tx_runtime.language.values.written_units import AnyUnit
from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True)
class Narrowed:
    """A declaration of a base, narrowed by constraints of the scenario.

    Attributes:
        given: The value or default, or a function that returns it while the base is declared.
        given_domain: The domain of the value, likewise.
        unit: Its unit in the scenario; empty: that of the base.
        is_fixed: Whether the value is constant.
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
        """The domain of the value; None if that is the default."""
        return _computed(self.given_domain)


def _computed(given: Any) -> Any:
    return given() if isinstance(given, FunctionType) else given
