"""Calls of the IR, as the rules of the library see them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from types import MappingProxyType
from typing import TypeAlias

from osc2tx import ir
from osc2tx.diagnostics import Span

Given: TypeAlias = Mapping[str, ir.Argument | str | None]
"""Arguments by name; a text for `at`, `None` for an implicit argument."""


class GivenArguments:
    """The arguments of a call.

    Args:
        given: The arguments.
        values: Values and domains of the scenario's parameters, by name.
    """

    def __init__(
        self, given: Given, values: Mapping[str, ir.Expression] = MappingProxyType({})
    ) -> None:
        self._given = given
        self._values = values

    def __contains__(self, name: str) -> bool:
        return name in self._given

    def word(self, name: str) -> str | None:
        """Return the word that an argument is in the source; `None` if it is something else."""
        argument = self._given[name]
        return word(argument) if isinstance(argument, ir.Argument) else argument

    def bounds(self, name: str) -> tuple[float, float] | None:
        """Return the least and the greatest number that an argument can be, if they are known."""
        argument = self._given[name]
        return (
            ir.bounds(argument.value, self._values) if isinstance(argument, ir.Argument) else None
        )

    def span(self, name: str | None, call: Span) -> Span:
        """Return the span of an argument, or of the call if the argument is omitted."""
        argument = None if name is None else self._given[name]
        return argument.span if isinstance(argument, ir.Argument) else call


def by_name(arguments: Sequence[ir.Argument]) -> Given:
    """Return arguments by their parameters."""
    return {argument.parameter: argument for argument in arguments}


def word(argument: ir.Argument) -> str | None:
    """Return the word that an argument is in the source; `None` if it is something else."""
    match argument.value:
        case ir.EnumValue(member=member):
            return member
        case ir.Literal(value=bool(value)):
            return str(value).lower()
        case ir.Literal(value=str(value)):
            return value
        case ir.ExpressionBase(type=ir.ValueType(kind=ir.Kind.STRUCT, name=name)):
            return name
    return None


def domains_of(declarations: Iterable[ir.Declaration]) -> dict[str, ir.Expression]:
    """Return values and domains of parameters by name, of those that no run may give any value."""
    parameters = [each for each in declarations if isinstance(each, ir.Parameter)]
    found = ((each.name, each.value if each.is_fixed else each.domain) for each in parameters)
    return {name: domain for name, domain in found if domain is not None}
