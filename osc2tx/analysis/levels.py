"""The level of a scenario: abstract, logical or concrete (§6.3).

A scenario is concrete if nothing is open: all parameters have values, every actor has a position
and a speed at the start, there is a map, and every member ends. It is logical if only choices from
stated ranges and sets are open, and abstract otherwise.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from enum import Enum

from osc2tx.analysis.constraints.operation_list import Key
from osc2tx.analysis.constraints.parameter_lookup import is_of_scope, name_of
from osc2tx.analysis.constraints.propagation import ConstraintAnalysis, State
from osc2tx.analysis.constraints.value_text import format_free, format_range, format_value
from osc2tx.analysis.lints.cast_checks import openings_of_cast
from osc2tx.analysis.lints.liveness import keyword_span
from osc2tx.analysis.lints.termination import Endings
from osc2tx.analysis.tree_walk import do_directives, do_members
from osc2tx.catalogue import catalogue
from osc2tx.diagnostics import Span
from osc2tx.options import OneOfPolicy
from osc2tx.semantics import SemanticModel, types
from osc2tx.semantics import symbols as sym
from osc2tx.syntax import ast
from osc2tx_shared.classes import dataclass

MOST_SHOWN = 5

# Overlaps of `parallel` that leave start and end of the members open (§7.3.13.2).
LOOSE_OVERLAPS = frozenset({"initial", "final", "inside", "full", "any"})


class Level(Enum):
    """Levels of abstraction, the most worked out first."""

    CONCRETE = "concrete"
    LOGICAL = "logical"
    ABSTRACT = "abstract"


ORDER = list(Level)


@dataclass(frozen=True, slots=True)
class Opening:
    """An open choice.

    Attributes:
        text: Description for a list.
        span: Its position.
        level: The level that the scenario has because of it.
    """

    text: str
    span: Span
    level: Level


@dataclass(frozen=True, slots=True)
class ScenarioLevel:
    """The level of a scenario, with its open values."""

    scenario: sym.ScenarioSymbol
    level: Level
    open: tuple[Opening, ...]

    def __str__(self) -> str:
        """One line: `scenario cut_in: logical (open: v_other in [80 kph..95 kph])`."""
        line = f"scenario {self.scenario.qualified_name}: {self.level.value}"
        texts = [o.text for o in self.open if o.level is self.level]
        if not texts:
            return line
        shown = "; ".join(texts[:MOST_SHOWN])
        more = len(texts) - MOST_SHOWN
        return f"{line} (open: {shown}{f'; and {more} more' if more > 0 else ''})"


def find_levels(
    model: SemanticModel,
    constraints: ConstraintAnalysis,
    endings: Endings,
    one_of: OneOfPolicy,
) -> tuple[ScenarioLevel, ...]:
    """Judge the scenarios of the root file.

    A `one_of` is a choice only if one is drawn; a race or a rule leaves nothing open.
    """
    is_drawn = one_of == "seeded"
    return tuple(
        _judge(model, scenario, constraints, endings, is_drawn) for scenario in model.scenarios
    )


def _judge(
    model: SemanticModel,
    scenario: sym.ScenarioSymbol,
    constraints: ConstraintAnalysis,
    endings: Endings,
    is_drawn: bool,
) -> ScenarioLevel:
    openings = [
        *_open_parameters(model, scenario, constraints),
        *(
            Opening(text, span, Level.ABSTRACT)
            for text, span in openings_of_cast(model, scenario, constraints)
        ),
        *_open_members(model, scenario, is_drawn),
    ]
    if not do_directives(scenario):
        openings.append(Opening("no `do`", scenario.span, Level.ABSTRACT))
    elif scenario in endings.endless_behaviors:
        openings.append(Opening("nothing ends it", scenario.span, Level.ABSTRACT))
    level = max((o.level for o in openings), key=ORDER.index, default=Level.CONCRETE)
    return ScenarioLevel(scenario, level, tuple(openings))


def _open_parameters(
    model: SemanticModel, scenario: sym.ScenarioSymbol, constraints: ConstraintAnalysis
) -> Iterator[Opening]:
    for parameter in constraints.parameters(scenario):
        root = parameter.key[0]
        if parameter.state is State.BOUNDED:
            text = f"{parameter.name} {format_range(model, parameter)}"
            yield Opening(text, root.span, Level.LOGICAL)
        elif parameter.state is State.FREE and root not in model.elements:
            yield Opening(format_free(model, parameter), root.span, Level.ABSTRACT)
    for key, text, span in _open_members_of_fields(model, scenario, constraints):
        yield Opening(f"{name_of(key)} {text}", span, Level.LOGICAL)


def _open_members_of_fields(
    model: SemanticModel, scenario: sym.ScenarioSymbol, constraints: ConstraintAnalysis
) -> Iterator[tuple[Key, str, Span]]:
    """Yield the members of objects that a constraint only bounds."""
    found = constraints.types[scenario]
    for key in found.by_key:
        last = key[-1]
        if len(key) < 2 or not isinstance(last, sym.FieldSymbol) or not is_of_scope(key):
            continue
        parameter = found.parameter(key, last.type)
        if parameter.state is State.BOUNDED:
            yield key, format_range(model, parameter), parameter.constraints[-1].span


def _open_members(
    model: SemanticModel, scenario: sym.ScenarioSymbol, is_drawn: bool
) -> Iterator[Opening]:
    """Yield the open parts of the `do` tree."""
    for directive in do_directives(scenario):
        for member in do_members(directive.member):
            match member:
                case ast.Composition():
                    yield from _open_composition(member, is_drawn)
                    yield from _open_with(model, member.with_members)
                case ast.Invocation():
                    name = member.behavior.text
                    yield from _open_arguments(model, member, name)
                    yield from _open_with(model, member.with_members)
                case ast.WaitDirective():
                    yield from _open_event(member.event)
                case _:
                    continue


def _open_composition(node: ast.Composition, is_drawn: bool) -> Iterator[Opening]:
    given = {
        argument.name.text if argument.name is not None else "": argument
        for argument in node.arguments
    }
    span = keyword_span(node)
    is_choice = node.operator is ast.CompositionOperator.ONE_OF and len(node.members) > 1
    if is_choice and is_drawn:
        yield Opening(f"one_of in line {span.line}", span, Level.LOGICAL)
    for name, argument in given.items():
        if isinstance(argument.value, ast.RangeLiteral):
            what = name or "duration"
            yield Opening(f"{what} {_within(argument.value)}", argument.span, Level.LOGICAL)
    overlap = given.get("overlap", given.get(""))
    if node.operator is ast.CompositionOperator.PARALLEL and overlap is not None:
        text = overlap.value.span.text.rpartition("!")[2]
        if text in LOOSE_OVERLAPS and not {"start_to_start", "end_to_end"} & given.keys():
            yield Opening(f"overlap `{text}` in line {span.line}", overlap.span, Level.ABSTRACT)


def _open_with(model: SemanticModel, members: tuple[ast.WithMember, ...]) -> Iterator[Opening]:
    for member in members:
        match member:
            case ast.ModifierApplication():
                yield from _open_arguments(model, member, member.modifier.text)
                yield from _open_relations(model, member)
            case ast.UntilDirective():
                yield from _open_event(member.event)
            case ast.KeepConstraint() | ast.RemoveDefault():
                yield from _open_keep(member)


def _open_keep(node: ast.KeepConstraint | ast.RemoveDefault) -> Iterator[Opening]:
    if isinstance(node, ast.KeepConstraint) and isinstance(node.expression, ast.Binary):
        right = node.expression.right
        if isinstance(right, ast.RangeLiteral):
            left = node.expression.left.span.text
            yield Opening(f"{left} {_within(right)}", node.expression.span, Level.LOGICAL)


def _open_arguments(
    model: SemanticModel, node: ast.Invocation | ast.ModifierApplication, name: str
) -> Iterator[Opening]:
    """Yield ranges given to plain numbers: one value is chosen and kept (§7.3.5.1.3)."""
    binding = model.bindings.get(node)
    for parameter, value in binding.arguments if binding is not None else ():
        if isinstance(value, ast.RangeLiteral) and not isinstance(parameter.type, types.RangeType):
            what = name if name == parameter.name else f"{name} {parameter.name}"
            yield Opening(f"{what} {_within(value)}", value.span, Level.LOGICAL)


def _open_relations(model: SemanticModel, node: ast.ModifierApplication) -> Iterator[Opening]:
    """Yield orders without an amount, such as `faster_than`."""
    binding = model.bindings.get(node)
    if binding is None or binding.callee.origin == "user":
        return
    given = {parameter.name: value for parameter, value in binding.arguments}
    entry = catalogue().modifiers.get(binding.callee.name)
    if entry is None or entry.orders.isdisjoint(given):
        return
    if entry.amounts.isdisjoint(given):
        text = " ".join(node.span.text.split())
        yield Opening(f"amount of {text}", node.span, Level.ABSTRACT)


def _open_event(event: ast.EventSpecification) -> Iterator[Opening]:
    match event.condition:
        case ast.ElapsedCondition(duration=ast.RangeLiteral() as within, span=span):
            yield Opening(f"elapsed {_within(within)}", span, Level.LOGICAL)


def _within(value: ast.RangeLiteral) -> str:
    return f"in [{value.lower.span.text}..{value.upper.span.text}]"


def fixed_values(
    model: SemanticModel, scenario: sym.ScenarioSymbol, constraints: ConstraintAnalysis
) -> Mapping[str, str]:
    """Return the constants at compile time, by path: `about.priority`, as written in a scenario.

    Strings come without quotes.
    """
    found = constraints.types[scenario]
    members = (
        found.parameter(key, last.type)
        for key in found.by_key
        if is_of_scope(key) and isinstance(last := key[-1], sym.FieldSymbol)
    )
    values = {
        name_of(parameter.key): format_value(model, parameter)
        for parameter in (*constraints.parameters(scenario), *members)
        if parameter.state is State.FIXED
    }
    return dict(sorted(values.items()))
