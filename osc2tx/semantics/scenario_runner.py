"""Conventions of ScenarioRunner: predefined events, speeds as strings, actors known by name."""

from __future__ import annotations

from osc2tx.semantics.dialects import QUANTITY_TEXTS, RUNNER_EVENTS
from osc2tx.semantics.member_lookup import lookup_value
from osc2tx.semantics.resolution import Environment, Resolution, declared_here
from osc2tx.semantics.symbols import FieldSymbol, ScenarioSymbol
from osc2tx.semantics.types import ActorType, PhysicalType, Type
from osc2tx.syntax import ast


def note_runner_event(r: Resolution, node: ast.EventDeclaration) -> None:
    """Warn that an event, which ScenarioRunner raises itself, is raised by `emit` only."""
    names = frozenset(p.name.text for p in node.parameters)
    if names and names == RUNNER_EVENTS.get(node.name.text):
        r.relaxes(
            "OSC620",
            node.name.span,
            f"event `{node.name}` occurs only where it is emitted; ScenarioRunner raises it by "
            "the distance between two cars",
            key=node.name.text,
            help="give it that condition: `event … is (….object_distance(…) < …)`",
        )


def reads_as_quantity(
    r: Resolution, expression: ast.Expression, target: Type, env: Environment
) -> bool:
    """Whether a text stands for a quantity of an actor, as `"npc_speed"` for the speed of `npc`.

    It changes during the run although a parameter holds it, which no backend can express: it is
    refused here, as lowering would take it for a text.
    """
    if not isinstance(expression, ast.StringLiteral) or not isinstance(target, PhysicalType):
        return False
    for suffix, quantity in QUANTITY_TEXTS.items():
        actor = expression.value.removesuffix(suffix)
        if actor == expression.value or not _has_dimension(r, target, quantity):
            continue
        name = ast.Name(span=expression.span, text=actor)
        field = lookup_value(r, name, env, quiet=True)
        if isinstance(field, FieldSymbol) and isinstance(field.type, ActorType):
            return _read_quantity(r, expression, f"{actor}.{quantity}")
    return False


def actor_of_caller(r: Resolution, name: ast.Name, env: Environment) -> FieldSymbol | None:
    """Return the actor of another scenario that a scenario uses by its name, as its own.

    ScenarioRunner knows actors by their names alone, whichever scenario declares them. Here the
    scenario that uses one gets a field like it, so that its callers hand theirs over.
    """
    scenario = env.owner
    if not isinstance(scenario, ScenarioSymbol):
        return None
    declared = [
        field
        for other in r.scope.declared
        if isinstance(other, ScenarioSymbol)
        and isinstance(field := other.members.get(name.text), FieldSymbol)
    ]
    types = {field.type for field in declared}
    if len(types) != 1 or not isinstance(declared[0].type, ActorType):
        return None
    first = declared[0]
    if not isinstance(first.node, ast.ParameterDeclaration):
        return None
    if not r.relaxes(
        "OSC628",
        name.span,
        f"`{name}` is an actor of another scenario; it is taken as the same here",
        key=f"{scenario.qualified_name} {name}",
        help=f"declare it in `{scenario.qualified_name}`: `{name}: {first.type.symbol.name}`",
        labels=declared_here(first),
    ):
        return None
    declaration = ast.ParameterDeclaration(
        span=name.span, names=(name,), type=first.node.type, default=None, constraints=()
    )
    field = FieldSymbol(
        name=first.name,
        namespace=scenario.namespace,
        span=first.span,
        owner=scenario,
        type=first.type,
        node=declaration,
    )
    scenario.members[field.name] = field
    scenario.statements.append(declaration)
    return field


def _read_quantity(r: Resolution, text: ast.StringLiteral, quantity: str) -> bool:
    read = r.relaxes(
        "OSC621",
        text.span,
        f'the text `"{text.value}"` stands for `{quantity}`, whatever that is at the time',
        key=text.value,
    )
    if read:
        r.report(
            "OSC503",
            text.span,
            "a text that stands for a quantity cannot be run yet",
            help=f"write `{quantity}` where it is compared",
        )
    return read


def _has_dimension(r: Resolution, target: PhysicalType, quantity: str) -> bool:
    return any(
        getattr(symbol, "dimension", None) == target.dimension
        for symbol in r.scope.types_named(quantity)
    )
