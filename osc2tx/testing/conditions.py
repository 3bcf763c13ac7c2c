"""Conditions on values that scenarios fix: `about.priority == high`, `v_ego >= 80kph`."""

from __future__ import annotations

import operator
import re
from collections.abc import Callable, Mapping
from typing import Any

from osc2tx_runtime.language.values.written_units import UNITS_OF, unit_named
from osc2tx_shared.classes import dataclass

_COMPARISONS: Mapping[str, Callable[[Any, Any], bool]] = {
    "==": operator.eq,
    "!=": operator.ne,
    "<=": operator.le,
    ">=": operator.ge,
    "<": operator.lt,
    ">": operator.gt,
}
_FORM = re.compile(r"\s*([\w.\[\]]+)\s*(==|!=|<=|>=|<|>)\s*(.+?)\s*")
_NUMBER = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*([^\W\d]\w*)?")
DIGITS = 9  # that count: 16.666666666666668 m/s are 60 kph
_UNITS = frozenset(name for names in UNITS_OF.values() for name in names.split())


@dataclass(frozen=True, slots=True)
class ValueCondition:
    """A comparison of a value with another one.

    Attributes:
        name: Path of the value.
        comparison: `==`, `!=`, `<`, `<=`, `>` or `>=`.
        value: The other value, as written.
    """

    name: str
    comparison: str
    value: str

    @classmethod
    def parse(cls, text: str) -> ValueCondition:
        """Read a condition.

        Raises:
            ValueError: It is none.
        """
        found = _FORM.fullmatch(text)
        if found is None:
            raise ValueError(f"{text!r} is no condition: write NAME == VALUE, or != < <= > >=")
        name, comparison, value = found.groups()
        quoted = re.fullmatch(r'"(.*)"|\'(.*)\'', value)
        value = next(part for part in quoted.groups() if part is not None) if quoted else value
        value = value.rpartition("!")[2] if re.fullmatch(r"[\w.:]+![\w]+", value) else value
        return cls(name, comparison, value)

    def holds(self, values: Mapping[str, str]) -> bool:
        """Return whether it holds of values as `ScenarioEntry` has them.

        A value that is open, or that there is not, meets no condition. Numbers compare in SI
        units, texts only with `==` and `!=`.
        """
        if self.name not in values:
            return False
        compare = _COMPARISONS[self.comparison]
        own, other = _number(values[self.name]), _number(self.value)
        if own is not None and other is not None and own[1] == other[1]:
            return compare(own[0], other[0])
        if self.comparison in ("==", "!="):
            return compare(values[self.name], self.value)
        return False


def _number(text: str) -> tuple[float, str] | None:
    """Return a number, SI where its unit is one of the library, and the unit that is left."""
    found = _NUMBER.fullmatch(text)
    if found is None:
        return None
    value, unit = float(found[1]), found[2] or ""
    if unit in _UNITS:
        meant = unit_named(unit)
        value, unit = value * meant.factor + meant.offset, ""
    return round(value, DIGITS), unit
