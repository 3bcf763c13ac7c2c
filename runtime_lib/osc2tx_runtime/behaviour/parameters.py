"""Values of parameters: given, set, drawn or default."""

from __future__ import annotations

import random
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from osc2tx_runtime.errors import ScenarioError, SettingsError

__all__ = ["Range", "choose", "within"]


@dataclass(frozen=True, slots=True)
class Range:
    """Values from `low` to `high`, SI units; one is drawn from the seed of the run."""

    low: float
    high: float

    def __post_init__(self) -> None:
        if not self.low <= self.high:
            raise ValueError(f"within({self.low}, {self.high}): from the lower to the upper bound")


def within(one: float, other: float) -> Range:
    """Return the range of a sampled parameter; its bounds may come in either order."""
    return Range(min(one, other), max(one, other))


def choose(
    name: str,
    default: Any,
    domain: Range | None,
    generator: random.Random,
    *,
    given: Any = None,
    settings: Mapping[str, float | str],
) -> Any:
    """Return the value of a parameter: as given, else set, else drawn, else its default.

    A range is drawn from whether the value is used or not, so that setting one parameter does
    not change what is drawn for the next.

    Args:
        name: Name, in an invoked scenario with the path before it.
        default: Value or range, SI units.
        domain: What is allowed; the range itself where `default` is one.
        generator: Draws.
        given: Value or range that the caller gives; None for none.
        settings: What `--set` sets.

    Raises:
        ScenarioError: If a given value is outside of the domain.
        SettingsError: If a set one is, or has another type.
    """
    value = default
    if isinstance(default, Range):
        value = generator.uniform(default.low, default.high)
        domain = domain or default
    if isinstance(given, Range):
        given = generator.uniform(given.low, given.high)
    if given is not None:
        problem = outside(given, domain)
        if problem:
            raise ScenarioError(f"{name}={problem}")
        return given
    if name not in settings:
        return value
    value = fit(name, settings[name], value)
    problem = outside(value, domain)
    if problem:
        raise SettingsError(f"--set {name}={problem}")
    return value


def outside(value: Any, domain: Range | None) -> str:
    """Return what is wrong with a value that is not in its domain."""
    if domain is None or domain.low <= value <= domain.high:
        return ""
    return f"{value:g}: the scenario allows {domain.low:g} to {domain.high:g} (SI units)"


def fit(name: str, value: float | str, like: Any) -> Any:
    """Return a value of the settings in the type of the parameter it is for."""
    text = str(value)
    if isinstance(like, bool):
        if text in ("true", "false"):
            return text == "true"
        raise SettingsError(f"--set {name}={text}: write true or false")
    if isinstance(like, str):
        return f"{value:g}" if isinstance(value, float) else value
    if isinstance(value, str):
        raise SettingsError(f"--set {name}={text}: write a number in SI units")
    if isinstance(like, int):
        if value != int(value):
            raise SettingsError(f"--set {name}={text}: write a whole number")
        return int(value)
    return value
