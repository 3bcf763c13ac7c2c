"""Initial placement: what holds at the start of the run is taken out of the tree.

Only invocations that begin at the very start can place an actor. Their `at: start` modifiers
become its placement, modifiers that hold throughout hold at the start as well, and an
`assign_position` that says nothing else disappears. An `at: start` further on would ask for a
jump in the middle of the run, and is refused.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

from osc2tx import ir
from osc2tx.diagnostics import Span
from osc2tx.lowering.context import LoweringContext

# Modifiers that say something about a single instant and so can place an actor.
PLACING = frozenset({"acceleration", "lane", "lateral", "orientation", "position", "speed", "yaw"})

# Actions that take no time, so that the next member of a serial still begins at the start.
INSTANT = frozenset(
    {"air", "assign_acceleration", "assign_celestial_position", "assign_orientation"}
    | {"assign_position", "assign_speed", "clouds", "fog", "rain", "set_lights", "snow", "wind"}
)


@dataclass(slots=True)
class _Found:
    """The placement of one actor, being collected."""

    span: Span
    comments: list[str] = field(default_factory=list)
    modifiers: dict[str, ir.ModifierCall] = field(default_factory=dict)


class PlacementLowering:
    """Splits a tree into initial placement and what is left of the tree."""

    def __init__(self, ctx: LoweringContext) -> None:
        """Take the place for complaints."""
        self._ctx = ctx
        self._found: dict[str, _Found] = {}

    def split(self, body: ir.Behavior) -> tuple[tuple[ir.Placement, ...], ir.Behavior | None]:
        """Return the placements in source order, and the tree without them."""
        rest = self._rewrite(body, is_start=True)
        placements = tuple(
            ir.Placement(
                actor=actor,
                modifiers=tuple(found.modifiers.values()),
                span=found.span,
                comments=tuple(found.comments),
            )
            for actor, found in self._found.items()
            if found.modifiers
        )
        return placements, rest

    def _rewrite(self, node: ir.Behavior, *, is_start: bool) -> ir.Behavior | None:
        match node:
            case ir.Serial():
                return self._composition(node, self._serial_members(node, is_start=is_start))
            case ir.Parallel() | ir.OneOf():
                members = (self._rewrite(member, is_start=is_start) for member in node.members)
                return self._composition(node, members)
            case ir.Invoke():
                return self._lift(node) if is_start else self._refuse_start(node)
            case ir.InvokeScenario() | ir.Wait() | ir.Emit() | ir.On():
                return node

    def _serial_members(self, node: ir.Serial, *, is_start: bool) -> Iterator[ir.Behavior | None]:
        for member in node.members:
            yield self._rewrite(member, is_start=is_start)
            is_start = is_start and is_instant(member)

    def _composition(
        self, node: ir.Composition, members: Iterator[ir.Behavior | None]
    ) -> ir.Composition | None:
        left = tuple(member for member in members if member is not None)
        return replace(node, members=left) if left else None

    def _lift(self, node: ir.Invoke) -> ir.Invoke | None:
        if not isinstance(node.actor, ir.FieldRef):
            return self._refuse_start(node)
        placing = [m for m in node.modifiers if m.name in PLACING and m.at != "end"]
        if not placing:
            return self._refuse_start(node)
        found = self._found.setdefault(node.actor.name, _Found(node.span))
        for modifier in placing:
            if modifier.at == "start" or modifier.name not in found.modifiers:
                # What holds throughout stays in the tree as well, and its comments with it.
                comments = modifier.comments if modifier.at == "start" else ()
                found.modifiers[modifier.name] = replace(modifier, at="start", comments=comments)
        rest = tuple(m for m in node.modifiers if m.at != "start")
        if node.action == "assign_position" and not rest and not node.arguments:
            found.comments.extend(node.comments)
            return None
        return self._refuse_start(replace(node, modifiers=rest))

    def _refuse_start(self, node: ir.Invoke) -> ir.Invoke:
        for modifier in node.modifiers:
            if modifier.at == "start":
                self._ctx.unsupported(
                    "OSC505",
                    modifier.span,
                    f"`{modifier.name}(…, at: start)` would make the actor jump during the run",
                    help="place the actor at the start, or let the action take it there",
                )
        return node


def is_instant(node: ir.Behavior) -> bool:
    """Whether a member takes no time."""
    match node:
        case ir.Serial() | ir.Parallel():
            return all(is_instant(member) for member in node.members)
        case ir.OneOf():
            return any(is_instant(member) for member in node.members)
        case ir.Invoke(action=action):
            return action in INSTANT
        case ir.Emit():
            return True
        case ir.InvokeScenario() | ir.Wait() | ir.On():
            return False
