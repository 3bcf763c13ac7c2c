"""Values of parameters: given, set, drawn, default; ranges and choices."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, Generic, TypeAlias, TypeVar

from osc2tx_runtime.errors import ScenarioError, SettingsError
from osc2tx_runtime.language.values.walks import Draws
from osc2tx_runtime.language.values.written_units import Unit, read_value, shown_value
from osc2tx_shared.classes import dataclass

NumberT = TypeVar("NumberT", int, float)
ValueT = TypeVar("ValueT", bound=bool | int | float | str)

INFINITY: Any = math.inf  # a bound of whole numbers as well
ROUNDING = 1e-9  # relative, of values that are written down


@dataclass(frozen=True, slots=True)
class Range(Generic[NumberT]):
    """Values from `low` to `high`, SI units; one is drawn from the seed of the run.

    With an infinite bound nothing can be drawn, and a value has to be given.
    """

    low: NumberT
    high: NumberT

    def __post_init__(self) -> None:
        if not self.low <= self.high:
            raise ValueError(f"within({self.low}, {self.high}): the lower bound comes first")

    @property
    def is_bounded(self) -> bool:
        """Whether both bounds are finite."""
        return math.isfinite(self.low) and math.isfinite(self.high)

    def draw(self, generator: Draws) -> NumberT:
        """Return a value; a whole number if both bounds are."""
        if isinstance(self.low, int) and isinstance(self.high, int):
            return generator.randint(self.low, self.high)
        drawn: Any = generator.uniform(self.low, self.high)
        return drawn  # type: ignore[no-any-return]

    def __contains__(self, value: Any) -> bool:
        if isinstance(value, Range):
            return value.low in self and value.high in self
        return bool(self.low <= value <= self.high)

    def shown(self, unit: Unit | None) -> str:
        """Return its text in a unit; default: SI units."""
        low, high = (shown_value(bound, unit) for bound in (self.low, self.high))
        si = "" if unit is not None else " (SI units)"
        if not math.isfinite(self.high):
            return f"at least {low}{si}"
        if not math.isfinite(self.low):
            return f"at most {high}{si}"
        return f"{low} to {high}{si}"


@dataclass(frozen=True, slots=True)
class Choice(Generic[ValueT]):
    """Values, one of which is drawn from the seed of the run."""

    values: tuple[ValueT, ...]

    @property
    def is_bounded(self) -> bool:
        """Whether a value can be drawn: always."""
        return True

    def draw(self, generator: Draws) -> ValueT:
        """Return one of the values."""
        return generator.choice(self.values)

    def __contains__(self, value: Any) -> bool:
        return value in self.values

    def shown(self, unit: Unit | None) -> str:
        """Return the text of its values, in their unit if they have one."""
        return f"{{{', '.join(shown_value(value, unit) for value in self.values)}}}"


Domain: TypeAlias = Range[Any] | Choice[Any]


def within(one: NumberT, other: NumberT) -> Range[NumberT]:
    """Return the range of a sampled parameter; its bounds may be in either order."""
    return Range(min(one, other), max(one, other))


def at_least(bound: NumberT) -> Range[NumberT]:
    """Return the range without upper bound."""
    return Range(bound, INFINITY)


def at_most(bound: NumberT) -> Range[NumberT]:
    """Return the range without lower bound."""
    return Range(-INFINITY, bound)


def any_of(*values: ValueT) -> Choice[ValueT]:
    """Return a set of values."""
    return Choice(values)


def fixed(value: ValueT) -> ValueT:
    """Return the only possible value of an enum.

    With `self.mood: Mood = fixed("calm")` its type is that of the enum for type checkers, so it can
    be compared with other values.
    """
    return value


def only(value: Any) -> Domain:
    """Return the domain of a single value."""
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    return Range(value, value) if is_number else Choice((value,))


def choose(
    name: str,
    default: Any,
    domain: Domain | None,
    generator: Draws,
    *,
    given: Any = None,
    settings: Mapping[str, float | str],
    unit: Unit | None = None,
) -> Any:
    """Return the value of a parameter: given, else set, else drawn, else the default.

    Ranges are drawn in any case, so that setting one parameter does not change the draws of the
    next.

    Args:
        name: Name, in an invoked scenario with the path before it.
        default: Value, or a range or choice to draw from, SI units; a type if a value must be
            given.
        domain: The allowed values; the default itself if it is a range or choice.
        generator: Draws.
        given: Value, or a range from the caller; None without one.
        settings: The values of `--set`.
        unit: Its unit in messages.

    Raises:
        ScenarioError: A given value is outside the domain.
        SettingsError: A set value is outside the domain or has another type, or no value is given.
    """
    value = default
    if isinstance(default, Range | Choice):
        value = default.draw(generator)
        domain = domain or default
    if isinstance(given, Range | Choice):
        given = draw(name, given, domain, generator, unit)
    if given is not None:
        problem = outside(given, domain, unit)
        if problem:
            raise ScenarioError(f"{name}={problem}")
        return given
    if name not in settings:
        if isinstance(value, type):
            allowed = "" if domain is None else f"; the scenario allows {domain.shown(unit)}"
            raise SettingsError(
                f"the scenario leaves {name} open{allowed}: give it a value, --set {name}=VALUE"
            )
        return value
    value = fit(name, settings[name], value() if isinstance(value, type) else value, unit)
    value = _unrounded(value, domain)
    problem = outside(value, domain, unit)
    if problem:
        raise SettingsError(f"--set {name}={problem}")
    return value


def draw(
    name: str, given: Domain, domain: Domain | None, generator: Draws, unit: Unit | None
) -> Any:
    """Return a value from the intersection of the caller's values and the domain of the scenario.

    Raises:
        ScenarioError: The intersection is empty or infinite.
    """
    if isinstance(given, Range) and isinstance(domain, Range):
        low, high = max(given.low, domain.low), min(given.high, domain.high)
        if low > high:
            asked, allowed = given.shown(unit), domain.shown(unit)
            raise ScenarioError(f"{name}: {asked} is requested, the scenario allows {allowed}")
        given = Range(low, high)
    if not given.is_bounded:
        shown = given.shown(unit)
        raise ScenarioError(f"{name}: {shown} is not a finite range to choose from; give a value")
    return given.draw(generator)


def outside(value: Any, domain: Domain | None, unit: Unit | None) -> str:
    """Return the error for a value outside its domain."""
    if domain is None or value in domain:
        return ""
    return f"{shown_value(value, unit)}: the scenario allows {domain.shown(unit)}"


def _unrounded(value: Any, domain: Domain | None) -> Any:
    """Return the bound or choice that a value is but for the rounding of its decimals.

    80 km/h are 22.2222222222 m/s in a document, which is less.
    """
    if domain is None or isinstance(value, str):
        return value
    exact = (domain.low, domain.high) if isinstance(domain, Range) else domain.values
    return next((each for each in exact if math.isclose(value, each, rel_tol=ROUNDING)), value)


def fit(name: str, value: float | str, like: Any, unit: Unit | None) -> Any:
    """Return a value of the settings, converted to the type of its parameter.

    Raises:
        SettingsError: It is not a value of that type, or its unit has another dimension.
    """
    if isinstance(like, bool):
        if isinstance(value, bool):
            return value
        if str(value) in ("true", "false"):
            return str(value) == "true"
        raise SettingsError(f"--set {name}={value}: write true or false")
    if isinstance(like, str):
        return f"{value:g}" if isinstance(value, float) else value
    if isinstance(value, str):
        value = read_value(name, value, unit)
    if isinstance(like, int):
        if value != int(value):
            raise SettingsError(f"--set {name}={value}: write a whole number")
        return int(value)
    return value
