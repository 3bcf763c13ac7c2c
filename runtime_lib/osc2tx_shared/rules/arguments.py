"""Which arguments of one call go together."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Literal, Protocol

from osc2tx_shared.classes import dataclass

LIMITS = {
    "at_least": "not be less than",
    "at_most": "not be more than",
    "above": "be above",
}


@dataclass(frozen=True, slots=True)
class Rule:
    """What holds for the arguments of one call.

    Attributes:
        kind: `at_most_one` or `at_least_one` of the parameters is given, `none` of them, or each
            that is given is `at_least` or `at_most` some number, or `above` it.
        of: Parameters.
        when: It only holds if one of these is given,
        values: with one of these values,
        unless: and none of these is given.
        number: The number.
    """

    kind: Literal["at_most_one", "at_least_one", "none", "at_least", "at_most", "above"]
    of: tuple[str, ...]
    when: tuple[str, ...] = ()
    values: tuple[str, ...] = ()
    unless: tuple[str, ...] = ()
    number: int = 0


class Given(Protocol):
    """The arguments of a call, by the names of their parameters."""

    def __contains__(self, name: str, /) -> bool:
        """Whether there is such an argument."""

    def word(self, name: str, /) -> str | None:
        """Return the word that an argument is in a scenario (`left`, `true`); None if none.

        Of an object it is the type (`path`).
        """

    def bounds(self, name: str, /) -> tuple[float, float] | None:
        """Return the least and the greatest number that an argument can be; None if not known."""


@dataclass(frozen=True, slots=True)
class Violation:
    """A broken rule.

    Attributes:
        parameter: The invalid argument; None if one is missing.
        text: Description of the error.
    """

    parameter: str | None
    text: str


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
    return Rule("at_least", of, tuple(when), unless=tuple(unless), number=least)


def at_most(most: int, *of: str) -> Rule:
    """These parameters are numbers that are not greater."""
    return Rule("at_most", of, number=most)


def above(least: int, *of: str) -> Rule:
    """These parameters are numbers that are greater."""
    return Rule("above", of, number=least)


def violations(subject: str, rules: Iterable[Rule], given: Given) -> Iterator[Violation]:
    """Yield what breaks a rule, in the order of the rules.

    Args:
        subject: The call in messages: `it`, "`speed`".
        rules: Those of the action or modifier.
        given: The arguments.
    """
    for rule in rules:
        cause = next((name for name in rule.when if _counts(rule, name, given)), None)
        if (rule.when and cause is None) or any(name in given for name in rule.unless):
            continue
        found = [name for name in rule.of if name in given]
        yield from _violations(rule, found, given, _shown(rule, cause, given) or subject)


def _violations(
    rule: Rule, found: Sequence[str], given: Given, subject: str
) -> Iterator[Violation]:
    match rule.kind:
        case "at_most_one" if len(found) > 1:
            yield Violation(found[1], f"`{found[0]}` and `{found[1]}` exclude each other")
        case "at_least_one" if not found:
            yield Violation(None, f"{subject} needs {_or(rule.of)}")
        case "none" if found:
            yield Violation(found[0], f"{subject} leaves no room for `{found[0]}`")
        case "at_least" | "at_most" | "above":
            for name in found:
                bounds = given.bounds(name)
                if bounds is not None and not _keeps(rule, *bounds):
                    yield Violation(name, f"`{name}` must {LIMITS[rule.kind]} {rule.number}")


def _keeps(rule: Rule, least: float, greatest: float) -> bool:
    """Whether a number between these can keep a rule."""
    match rule.kind:
        case "at_least":
            return greatest >= rule.number
        case "at_most":
            return least <= rule.number
        case _:
            return greatest > rule.number


def _counts(rule: Rule, name: str, given: Given) -> bool:
    return name in given and (not rule.values or given.word(name) in rule.values)


def _shown(rule: Rule, cause: str | None, given: Given) -> str:
    """Return the argument for which the rule holds, as one would write it."""
    if cause is None:
        return ""
    return f"`{cause}: {given.word(cause)}`" if rule.values else f"`{cause}`"


def _or(names: Sequence[str]) -> str:
    quoted = [f"`{name}`" for name in names]
    return quoted[0] if len(quoted) == 1 else f"{', '.join(quoted[:-1])} or {quoted[-1]}"
