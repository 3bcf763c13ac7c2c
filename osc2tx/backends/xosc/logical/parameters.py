"""Open parameters: what a scenario leaves to be chosen for each run.

A parameter is open if constraints leave it a range or several values, and nobody gives it one; in
an invoked scenario it is open once for each invocation. Where `one_of` chooses a member for each
run, that choice is an open parameter too.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import chain
from typing import TypeAlias

from osc2tx import ir
from osc2tx.backends.xosc.scopes import Scope, key_of, open_scopes
from osc2tx.backends.xosc.values.constants import Constant, Member
from osc2tx.backends.xosc.values.folding import Values
from osc2tx.diagnostics import Span
from osc2tx.losses.entries import Inexpressible
from osc2tx.options import XmlVersion
from osc2tx.xosc import elements as xml
from osc2tx.xosc.columns import declared
from osc2tx.xosc.element import text_of
from osc2tx.xosc.expressions import Symbol
from osc2tx.xosc.literals import ParameterType
from osc2tx.xosc.names import Names, plain
from osc2tx_shared.classes import dataclass, replace

STEPS = 4
"""Steps from end to end of a range of which a few values are listed."""

INSIDE = 0.3137
"""A place in a range where nothing special is to be expected."""

MOST_WHOLE = 20
"""Whole numbers that are listed one by one."""

Point: TypeAlias = Mapping[str, Constant]
"""Values of open parameters, by their keys."""


@dataclass(frozen=True, slots=True, eq=False)
class OpenParameter:
    """A parameter that may have several values.

    Attributes:
        key: What tells it apart: labels of invocations and its name, as for `--set`.
        name: Its name in the document.
        path: Of the scope that it belongs to.
        span: Where it is declared, or the choice stands.
        construct: What it is called in reports.
        choices: All its values, if they are a set.
        range_: Its bounds, if it has any.
        is_whole: It has no fractions.
        site: Where the `one_of` stands whose member it chooses, or the lane change whose side.
        is_branch: It chooses a member.
    """

    key: str
    name: str
    path: str
    span: Span
    construct: str
    choices: tuple[Constant, ...] = ()
    range_: ir.RangeValue | None = None
    is_whole: bool = False
    site: Span | None = None
    is_branch: bool = False

    @property
    def is_number(self) -> bool:
        """Whether attributes can be computed from it."""
        return all(
            isinstance(choice, (int, float)) and not isinstance(choice, bool)
            for choice in self.choices
        )

    @property
    def is_dependent(self) -> bool:
        """Whether its bounds are computed from other parameters."""
        return self.range_ is not None and any(
            isinstance(part, ir.FieldRef)
            for bound in (self.range_.lower, self.range_.upper)
            for part in ir.walk(bound)
        )

    @property
    def type(self) -> ParameterType:
        """The type of its declaration: `double`, `int`, `boolean` or `string`."""
        if self.is_number:
            return "int" if self.is_whole else "double"
        return "boolean" if isinstance(self.choices[0], bool) else "string"

    def limits(self, values: Values) -> tuple[float, float]:
        """Return the bounds of a range, for values of the others."""
        if self.range_ is None:
            numbers = [float(n) for n in self.choices if isinstance(n, (int, float))]
            return min(numbers), max(numbers)
        low, high = float(values.number(self.range_.lower)), float(values.number(self.range_.upper))
        return (low, high) if low <= high else (high, low)

    def at(self, share: float, values: Values) -> Constant:
        """Return the value at a place between its first (0) and its last one (1)."""
        if self.choices:
            return self.choices[min(int(share * len(self.choices)), len(self.choices) - 1)]
        low, high = self.limits(values)
        if self.is_whole:
            return min(int(low + share * (high - low + 1.0)), int(high))
        return high if share == 1.0 else low + share * (high - low)

    def probes(self) -> tuple[float, ...]:
        """Return places at which a document is tested: all that are listed, and one more."""
        count = len(self.choices)
        if count:
            return tuple(index / count for index in range(count))
        return (*(step / STEPS for step in range(STEPS + 1)), INSIDE)

    def told(self, values: Values) -> str:
        """Return its values for people."""
        if self.choices:
            return f"[{', '.join(map(told, self.choices))}]"
        if self.range_ is not None and self.is_dependent:
            return f"[{self.range_.lower.span.text}..{self.range_.upper.span.text}]"
        low, high = self.limits(values)
        return f"[{low:g}..{high:g}]"

    def symbol(self, nominal: Constant, longest: int) -> Constant:
        """Return the number that stands for it, in expressions of so many characters at most.

        What is no number has no expressions.
        """
        if not self.is_number or not isinstance(nominal, (int, float)):
            return nominal
        return Symbol(nominal, f"${self.name}", longest=longest)


def told(value: Constant) -> str:
    """Return a value for people."""
    return f"{value:g}" if isinstance(value, float) else value_text(value)


def value_text(value: Constant) -> str:
    """Return a value as the text of an attribute.

    Raises:
        Inexpressible: Readers would take it for a parameter, or it is no text of XML.
    """
    if isinstance(value, Member):
        return value.name
    if isinstance(value, (bool, int, float, str)):
        return text_of(value)
    raise Inexpressible("such values are no parameters of OpenSCENARIO XML")


def open_parameters(scenario: ir.Scenario, module: ir.Module) -> tuple[OpenParameter, ...]:
    """Return the open parameters of a scenario and of those that it invokes.

    Those from which the bounds of others are computed come first.
    """
    names = Names()
    found: dict[str, OpenParameter] = {}
    for scope in open_scopes(scenario, module).all():
        for declaration in scope.scenario.declarations:  # each after those that it is computed from
            if not isinstance(declaration, ir.Parameter) or scope.values.is_given(declaration.name):
                continue
            parameter = _open(declaration, scope, names)
            if parameter is not None:
                found.setdefault(parameter.key, parameter)
        found.update((side.key, side) for side in _sides(scope, names))
        branches = _branches(scope, names, module.one_of)
        found.update((branch.key, branch) for branch in branches)
    return _with_known_bounds(scenario, module, tuple(found.values()))


def _with_known_bounds(
    scenario: ir.Scenario, module: ir.Module, parameters: tuple[OpenParameter, ...]
) -> tuple[OpenParameter, ...]:
    """Leave out those whose bounds are only known during the run; it is reported where one is read.

    Args:
        scenario: The scenario.
        module: Where it stands.
        parameters: Those from which the bounds of others are computed come first.
    """
    if not any(parameter.is_dependent for parameter in parameters):
        return parameters
    point: dict[str, Constant] = {}
    kept = []
    for parameter in parameters:
        scopes = open_scopes(scenario, module, point).all()
        values = next(scope.values for scope in scopes if scope.path == parameter.path)
        try:
            point[parameter.key] = parameter.at(0.0, values)
        except Inexpressible:
            continue
        kept.append(parameter)
    return tuple(kept)


def _open(declaration: ir.Parameter, scope: Scope, names: Names) -> OpenParameter | None:
    """Return a parameter if it is open."""
    if declaration.value is not None:
        return None
    domain, name = declaration.domain, declaration.name
    key = key_of(scope.path, declaration)
    is_whole = declaration.type.kind is ir.Kind.INTEGER
    choices: tuple[Constant, ...] = ()
    range_ = None
    try:
        match domain:
            case ir.RangeValue():
                range_ = domain
            case ir.Choices(elements=elements):
                values = (scope.values.of(each) for each in elements)
                lists = (v if isinstance(v, tuple) else (v,) for v in values)  # of elements
                choices = tuple(chain.from_iterable(lists))
                if not is_whole and all(type(each) in (int, float) for each in choices):
                    choices = tuple(float(n) for n in choices if isinstance(n, (int, float)))
                for choice in choices:
                    value_text(choice)
            case _:
                return None
    except Inexpressible:  # it keeps one value, and where that is used it is reported
        return None
    made = OpenParameter(
        key,
        name,
        scope.path,
        declaration.span,
        f"parameter {key}",
        choices=choices,
        range_=range_,
        is_whole=is_whole,
    )
    if range_ is not None and not made.is_dependent:
        low, high = made.limits(scope.values)
        if low == high:
            return None
        if is_whole and high - low < MOST_WHOLE:
            choices, range_ = tuple(range(int(low), int(high) + 1)), None
    preferred = name if declaration.is_global else f"{scope.prefix}{name}"
    return replace(made, name=names.new(preferred), choices=choices, range_=range_)


def _branches(scope: Scope, names: Names, policy: str) -> Iterator[OpenParameter]:
    """Yield the choices between members of which one is drawn."""
    for node in ir.walk_behaviors(scope.scenario.body):
        if not isinstance(node, ir.OneOf) or len(node.members) < 2 or not ir.is_drawn(node, policy):
            continue
        members = Names()
        name = names.new(f"{scope.prefix}{node.label or 'branch'}")
        choices = tuple(members.new(plain(each.label or each.name)) for each in node.members)
        made = _drawn(scope, name, node.span, choices)
        yield replace(made, is_branch=True)


def _sides(scope: Scope, names: Names) -> Iterator[OpenParameter]:
    """Yield the sides of lane changes that state none: they are drawn for each run."""
    for node in ir.invocations(scope.scenario.body):
        calls: tuple[ir.Invoke | ir.ModifierCall, ...] = (node, *node.modifiers)
        for call in calls:
            called = call.action if isinstance(call, ir.Invoke) else call.name
            said = {argument.parameter for argument in call.arguments}
            if called != "change_lane" or said & {"side", "target"}:
                continue
            name = names.new(f"{scope.prefix}{node.label or called}_side")
            yield _drawn(scope, name, call.span, ("left", "right"))


def _drawn(scope: Scope, name: str, span: Span, choices: tuple[Constant, ...]) -> OpenParameter:
    """Return the parameter of a choice that has no name in the scenario."""
    key, construct = f"{scope.path}.{name}", f"parameter {name}"
    return OpenParameter(key, name, scope.path, span, construct, choices, site=span)


def declaration(
    parameter: OpenParameter, nominal: Constant, values: Values, version: XmlVersion
) -> xml.ParameterDeclaration:
    """Return the declaration, from 1.1 on with its limits if they are constants."""
    limits = None
    if version >= "1.1" and not parameter.choices and not parameter.is_dependent:
        low, high = parameter.limits(values)
        limits = xml.ConstraintGroup(
            xml.ValueConstraint(rule="greaterOrEqual", value=low),
            xml.ValueConstraint(rule="lessOrEqual", value=high),
        )
    return declared(parameter.name, parameter.type, value_text(nominal), version, limits)
