"""Actors of type `Path` of the dialect `carla`, which require a road for the start.

A `Path` becomes one declared part of a road with all constraints on it, and `set_map` the map of
the scenario. `drive(path)` places the driving actor, which then follows the road.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from osc2tx import ir
from osc2tx.lowering.context import LoweringContext
from osc2tx.lowering.modifiers.modifiers import lower_modifier
from osc2tx.semantics import symbols as sym
from osc2tx.semantics import types
from osc2tx.syntax import ast
from osc2tx_shared.classes import dataclass, replace

TYPE = "Path"
MAP_MODIFIER = "set_map"
START = "on_path"

# Modifier -> its constraint on the piece of road.
SEARCH_CRITERIA = {
    "path_different_dest": "different_dest",
    "path_different_origin": "different_origin",
    "path_length": "min_length",
    "path_max_lanes": "max_lanes",
    "path_min_driving_lanes": "min_lanes",
}


@dataclass(frozen=True, slots=True)
class PathMember:
    """A modifier of a path that is a member of a scenario."""

    owner: sym.FieldSymbol
    modifier: ir.ModifierCall


def is_path(type_: types.Type) -> bool:
    """Whether a field is a path of the dialect."""
    return (
        isinstance(type_, types.ActorType)
        and type_.symbol.origin == "prelude"
        and type_.symbol.name == TYPE
    )


def path_members(
    ctx: LoweringContext, statements: Iterable[ast.Statement]
) -> tuple[PathMember, ...]:
    """Return the supported constraints on paths."""
    members = []
    for statement in statements:
        if isinstance(statement, ast.ModifierApplication) and is_path_member(ctx, statement):
            owner = ctx.model.symbol_of(statement.actor) if statement.actor else None
            assert isinstance(owner, sym.FieldSymbol)
            modifier = lower_modifier(ctx, statement, statement.span.text.partition("(")[0])
            members.append(PathMember(owner, modifier))
    return tuple(members)


def is_path_member(ctx: LoweringContext, node: ast.ModifierApplication) -> bool:
    """Whether a modifier is one of those."""
    target = node.actor and ctx.model.symbol_of(node.actor)
    known = node.modifier.text in SEARCH_CRITERIA or node.modifier.text == MAP_MODIFIER
    return known and isinstance(target, sym.FieldSymbol) and is_path(target.type)


def path_declarations(
    ctx: LoweringContext,
    field: sym.FieldSymbol,
    members: Sequence[PathMember],
    comments: tuple[str, ...],
) -> tuple[ir.Actor | ir.Struct, ...]:
    """Return the part of a road that a path denotes, below its map."""
    own = [member.modifier for member in members if member.owner is field]
    for index, modifier in enumerate(own):
        if any(other.name == modifier.name for other in own[:index]):
            ctx.unsupported(
                "OSC508", modifier.span, f"modifier `{modifier.name}` is applied twice here"
            )
    maps = [
        ir.Actor(
            name=f"{field.name}.map",
            span=modifier.span,
            comments=modifier.comments,
            type="map",
            lineage=("map", "osc_actor"),
            values=_values(modifier, "map_file", ()),
        )
        for modifier in own
        if modifier.name == MAP_MODIFIER
    ]
    criteria = [modifier for modifier in own if modifier.name in SEARCH_CRITERIA]
    road = ir.Struct(
        name=field.name,
        span=field.span,
        comments=comments,
        type=TYPE,
        lineage=(TYPE,),
        values=tuple(v for m in criteria for v in _values(m, SEARCH_CRITERIA[m.name], m.comments)),
    )
    return (*maps, road)


def _values(
    modifier: ir.ModifierCall, field: str, comments: tuple[str, ...]
) -> tuple[ir.FieldValue, ...]:
    return tuple(
        ir.FieldValue(path=(field,), value=a.value, span=a.span, comments=comments)
        for a in modifier.arguments
    )


def start_on_path(node: ir.Invoke) -> ir.Invoke:
    """Return `drive(path)` as a `drive()` that begins on the path."""
    paths = [argument for argument in node.arguments if argument.value.type.name == TYPE]
    if not paths:
        return node
    start = ir.ModifierCall(
        span=paths[0].span,
        name=START,
        arguments=(replace(paths[0], parameter="path", is_positional=True),),
        at="start",
    )
    rest = tuple(argument for argument in node.arguments if argument not in paths)
    return replace(node, arguments=rest, modifiers=(start, *node.modifiers))
