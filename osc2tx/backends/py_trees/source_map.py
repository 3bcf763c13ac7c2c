"""The source map: which source line each part of a generated module comes from.

The module cites no line, so that an edit of the source changes only the related code. The map is
one line of JSON with numbers only: it decides nothing, and is not reviewed.
"""

from __future__ import annotations

import json
from dataclasses import asdict, field

from osc2tx import ir
from osc2tx.diagnostics import Span
from osc2tx_shared.classes import dataclass
from osc2tx_shared.text import in_json

VERSION = 3

Place = tuple[int, int]
"""Line and column, both from 1."""


@dataclass(slots=True)
class ScenarioMap:
    """The positions of one scenario in its source.

    Parts from other files have no position here: they are in the map of their modules.

    Attributes:
        source: Name of the source.
        fields: Place of each declaration, by Python name.
        constraints: Place of each constraint, in order.
        placements: Place of each placement, in order.
        nodes: Place of each node of the tree, in pre-order.
        modifiers: Places of the modifiers of an action, by its index among the nodes.
    """

    source: str
    fields: dict[str, Place | None] = field(default_factory=dict)
    constraints: list[Place | None] = field(default_factory=list)
    placements: list[Place | None] = field(default_factory=list)
    nodes: list[Place | None] = field(default_factory=list)
    modifiers: dict[int, list[Place | None]] = field(default_factory=dict)

    def place_of(self, span: Span) -> Place | None:
        """Return where a piece of the source begins; `None` for a piece of another one."""
        return (span.line, span.column) if span.source.name == self.source else None

    def add_nodes(self, body: ir.Behavior) -> None:
        """Record the positions of the nodes of a tree; the end of a member is a node around it."""
        pending = [body]
        while pending:
            node = pending.pop()
            until = (
                ()
                if isinstance(node, ir.Wait | ir.Emit | ir.Finish | ir.Call | ir.On)
                else node.until
            )
            spans = (*(each.span for each in until[:1]), node.span)
            self.nodes += map(self.place_of, spans)
            if isinstance(node, ir.Invoke) and node.modifiers:
                index = len(self.nodes) - 1
                self.modifiers[index] = [*map(self._place_of_modifier, node.modifiers)]
            match node:
                case ir.Serial() | ir.Parallel() | ir.OneOf():
                    pending += reversed(node.members)
                case ir.On():
                    pending += reversed(node.reactions)
                case _:
                    pass

    def _place_of_modifier(self, call: ir.ModifierCall) -> Place | None:
        """Return its place, or that where a modifier of another file that states it is applied."""
        spans = (call.span, *(each.span for each in reversed(call.applied)))
        return next(filter(None, map(self.place_of, spans)), None)

    def content(self) -> dict[str, object]:
        """Return the map as text."""
        found = asdict(self)
        del found["source"]
        return found


def render_source_map(maps: dict[str, ScenarioMap]) -> str:
    """Return the maps of a module's scenarios as one line of JSON."""
    scenarios = {name: each.content() for name, each in maps.items()}
    content = {"version": VERSION, "scenarios": scenarios}
    return in_json(json.dumps(content, separators=(",", ":"), ensure_ascii=False)) + "\n"
