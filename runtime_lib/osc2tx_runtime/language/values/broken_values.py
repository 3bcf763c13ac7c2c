"""Messages on values that break a relation, or that cannot be computed."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

from osc2tx_runtime.errors import ScenarioError, why_no_result
from osc2tx_runtime.language.source_map import SourceMap
from osc2tx_runtime.language.tree.module_text import failing_part
from osc2tx_runtime.language.values.written_units import Unit, shown_value


class NotKeptError(Exception):
    """A relation of `keep` does not hold.

    Args:
        place: Its position in the scenario.
    """

    def __init__(self, place: str) -> None:
        super().__init__(place)
        self.place = place


def not_kept(
    broken: NotKeptError,
    parameters: Mapping[str, Any],
    units: Mapping[str, Unit],
    tried: str,
    rivals: Sequence[NotKeptError] = (),
) -> ScenarioError:
    """Return the message on a relation, with the values that it relates.

    Args:
        broken: The relation.
        parameters: All values.
        units: Units of the values that have one.
        tried: Number of further draws, ` in 1000 draws`; empty without any.
        rivals: The relations that it contradicts.
    """
    text = _relation(broken)
    words = set(re.findall(r"\w+", text))
    about = {name: v for name, v in parameters.items() if name in words}
    values = ", ".join(
        f"{name}={shown_value(v, units.get(name))}" for name, v in (about or parameters).items()
    )
    help_ = f" (the last values: {values})" if tried else f" ({values})" if values else ""
    what = f"`{text}`" if text else "a constraint"
    beside = " and ".join(f"`{_relation(each)}` ({each.place})" for each in rivals)
    together = f" together with {beside}" if beside else ""
    return ScenarioError(f"{what} does not hold{tried}{together}{help_}", broken.place)


def _relation(broken: NotKeptError) -> str:
    return failing_part(broken)[0].removeprefix("keep(").removesuffix(")")


def not_computed(
    error: Exception, source_map: SourceMap, kept: int, tried: str = ""
) -> ScenarioError:
    """Return the message on a value without result.

    Args:
        error: The reason.
        source_map: Positions in the scenario.
        kept: Number of constraints that hold before it.
        tried: See `not_kept`.
    """
    text, _ = failing_part(error)
    what = f"`{text}`" if text else "a value"
    why = f"{what} cannot be computed{tried}: {why_no_result(error)}"
    return ScenarioError(why, place_of(error, source_map, kept))


def place_of(error: Exception, source_map: SourceMap, kept: int) -> str | None:
    """Return the position of the value or constraint that raised an error.

    Args:
        error: The error.
        source_map: Positions in the scenario.
        kept: Number of constraints that hold before it.
    """
    _, member = failing_part(error)
    if member == "keep":
        return source_map.of_constraint(kept)
    known = member in source_map.fields
    return source_map.of_field(member if known else member.removesuffix("_"))
