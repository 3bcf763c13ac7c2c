"""Conventions of ScenarioRunner: predefined events, speeds as strings."""

from __future__ import annotations

from osc2tx.semantics.dialects import QUANTITY_TEXTS, RUNNER_EVENTS
from osc2tx.semantics.names.member_lookup import lookup_value
from osc2tx.semantics.resolution import Environment, Resolution
from osc2tx.semantics.symbols import FieldSymbol
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
    """Whether a string denotes a quantity of an actor, as `"npc_speed"` the speed of `npc`.

    It changes during the run, also as the value of a parameter, which is another name for it.
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
            return _read_quantity(r, expression, name, quantity, env)
    return False


def _read_quantity(
    r: Resolution, text: ast.StringLiteral, actor: ast.Name, quantity: str, env: Environment
) -> bool:
    read = r.relaxes(
        "OSC621",
        text.span,
        f'the text `"{text.value}"` stands for `{actor}.{quantity}` at the time of the comparison',
        key=text.value,
        help=f"write `{actor}.{quantity}` there",
    )
    if read:
        base = ast.NameExpression(span=text.span, name=actor)
        name = ast.Name(span=text.span, text=quantity)
        r.quantities[text] = ast.MemberAccess(span=text.span, base=base, name=name)
        r.type_of(r.quantities[text], env)
    return read


def _has_dimension(r: Resolution, target: PhysicalType, quantity: str) -> bool:
    return any(
        getattr(symbol, "dimension", None) == target.dimension
        for symbol in r.scope.types_named(quantity)
    )
