"""Which arguments of a modifier or action go together: data that the compiler reads as well."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

from osc2tx_runtime.errors import ScenarioError

__all__ = [
    "Rule",
    "above",
    "at_least",
    "at_least_one",
    "at_most_one",
    "check_arguments",
    "none_of",
]


@dataclass(frozen=True, slots=True)
class Rule:
    """What holds for the arguments of one call.

    Attributes:
        kind: `at_most_one` or `at_least_one` of the parameters is given, `none` of them, or each
            that is given is `at_least` some number, or `above` it.
        of: Parameters.
        when: It only holds if one of these is given,
        values: with one of these values,
        unless: and none of these is given.
        least: The number.
    """

    kind: Literal["at_most_one", "at_least_one", "none", "at_least", "above"]
    of: tuple[str, ...]
    when: tuple[str, ...] = ()
    values: tuple[str, ...] = ()
    unless: tuple[str, ...] = ()
    least: int = 0

    def violation(self, given: Mapping[str, Any]) -> str | None:
        """Return what is wrong with arguments by their names; None if nothing is."""
        cause = next((name for name in self.when if self._counts(name, given)), None)
        if (self.when and cause is None) or any(name in given for name in self.unless):
            return None
        found = [name for name in self.of if name in given]
        names = _or(self.of)
        if cause is not None and self.values:
            cause = f"{cause}: {_word(given[cause])}"
        match self.kind:
            case "at_most_one" if len(found) > 1:
                return f"`{found[0]}` and `{found[1]}` exclude each other"
            case "at_least_one" if not found:
                return f"`{cause}` needs {names}" if cause else f"it needs {names}"
            case "none" if found:
                return f"`{cause}` leaves no room for `{found[0]}`"
            case "at_least":
                low = next((n for n in found if _is_less(given[n], self.least)), None)
                return None if low is None else f"`{low}` must not be less than {self.least}"
            case "above":
                low = next((n for n in found if _is_less(given[n], self.least, equal=True)), None)
                return None if low is None else f"`{low}` must be above {self.least}"
        return None

    def _counts(self, name: str, given: Mapping[str, Any]) -> bool:
        return name in given and (not self.values or _word(given[name]) in self.values)


def at_most_one(*of: str) -> Rule:
    """These parameters exclude each other."""
    return Rule("at_most_one", of)


def at_least_one(
    *of: str, when: Sequence[str] = (), values: Sequence[str] = (), unless: Sequence[str] = ()
) -> Rule:
    """One of these parameters must be given."""
    return Rule("at_least_one", of, tuple(when), tuple(values), tuple(unless))


def none_of(*of: str, when: Sequence[str], values: Sequence[str] = ()) -> Rule:
    """These parameters make no sense together with any of `when`."""
    return Rule("none", of, tuple(when), tuple(values))


def at_least(least: int, *of: str, when: Sequence[str] = (), unless: Sequence[str] = ()) -> Rule:
    """These parameters are numbers that are not less."""
    return Rule("at_least", of, tuple(when), unless=tuple(unless), least=least)


def above(least: int, *of: str) -> Rule:
    """These parameters are numbers that are greater."""
    return Rule("above", of, least=least)


def check_arguments(what: str, rules: Sequence[Rule], given: Mapping[str, Any]) -> None:
    """Compare arguments with rules.

    Raises:
        ScenarioError: They break one.
    """
    for rule in rules:
        wrong = rule.violation(given)
        if wrong is not None:
            raise ScenarioError(f"{what}: {wrong}")


def _is_less(value: Any, least: int, *, equal: bool = False) -> bool:
    return isinstance(value, int | float) and (value < least or (equal and value == least))


def _word(value: Any) -> Any:
    """A value as the DSL writes it."""
    return str(value).lower() if isinstance(value, bool) else value


def _or(names: Sequence[str]) -> str:
    quoted = [f"`{name}`" for name in names]
    return quoted[0] if len(quoted) == 1 else f"{', '.join(quoted[:-1])} or {quoted[-1]}"
