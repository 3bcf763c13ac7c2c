"""Applies the runtime's rules about arguments to calls: what is missing, too much or too small."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TypeAlias

from osc2tx import ir
from osc2tx.backends.py_trees.naming import identifier
from osc2tx.backends.py_trees.runtime_api import ArgumentRule
from osc2tx.diagnostics import Span

Given: TypeAlias = Mapping[str, ir.Argument | str | None]
"""Arguments by name; a text for `at`, `None` for what is no argument, but counts as one."""


def violations(
    what: str, rules: Sequence[ArgumentRule], span: Span, given: Given
) -> Iterator[tuple[Span, str]]:
    """Yield what breaks a rule: where, and what is wrong.

    Args:
        what: Name of the modifier or action.
        rules: Of the modifier or action.
        span: The call.
        given: What is given.
    """
    for rule in rules:
        cause = next((name for name in rule.when if _counts(rule, name, given)), None)
        if (rule.when and cause is None) or any(name in given for name in rule.unless):
            continue
        yield from _violation(what, rule, span, given, cause)


def by_name(arguments: Sequence[ir.Argument]) -> Given:
    """Return arguments by the runtime's names of their parameters."""
    return {identifier(argument.parameter): argument for argument in arguments}


def _violation(
    what: str, rule: ArgumentRule, span: Span, given: Given, cause: str | None
) -> Iterator[tuple[Span, str]]:
    found = [name for name in rule.of if name in given]
    shown = cause
    if cause is not None and rule.values:
        shown = f"{cause}: {word(given[cause])}"
    match rule.kind:
        case "at_most_one" if len(found) > 1:
            yield _span(given, found[1], span), f"`{found[0]}` and `{found[1]}` exclude each other"
        case "at_least_one" if not found:
            yield span, f"`{shown or what}` needs {_or(rule.of)}"
        case "none" if found:
            yield _span(given, found[0], span), f"`{shown}` leaves no room for `{found[0]}`"
        case "at_least" | "above":
            for name in found:
                argument = given[name]
                value = ir.constant(argument.value) if isinstance(argument, ir.Argument) else None
                if value is None or value > rule.least:
                    continue
                if rule.kind == "above":
                    yield _span(given, name, span), f"`{name}` must be above {rule.least}"
                elif value < rule.least:
                    yield _span(given, name, span), f"`{name}` must not be less than {rule.least}"


def _counts(rule: ArgumentRule, name: str, given: Given) -> bool:
    return name in given and (not rule.values or word(given[name]) in rule.values)


def word(argument: ir.Argument | str | None) -> str | None:
    """Return the word that an argument is in the source; `None` if it is something else."""
    if not isinstance(argument, ir.Argument):
        return argument
    match argument.value:
        case ir.EnumValue(member=member):
            return member
        case ir.Literal(value=bool(value)):
            return str(value).lower()
    return None


def _span(given: Given, name: str, call: Span) -> Span:
    argument = given[name]
    return argument.span if isinstance(argument, ir.Argument) else call


def _or(names: Sequence[str]) -> str:
    quoted = [f"`{name}`" for name in names]
    return quoted[0] if len(quoted) == 1 else f"{', '.join(quoted[:-1])} or {quoted[-1]}"
