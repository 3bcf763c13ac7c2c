"""The source map: which source line each part of a generated module comes from.

The module cites no line, so that an edit of the source stirs nothing but what it says. The map is
one line of JSON with numbers only: it decides nothing, and nobody reviews it.
"""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, field

from osc2tx_text import in_json

VERSION = 2


@dataclass(slots=True)
class ScenarioMap:
    """The lines of one scenario.

    Attributes:
        fields: Line of each declaration, by Python name.
        constraints: Line of each constraint, in order.
        placements: Line of each placement, in order.
        nodes: Line of each node of the tree, in pre-order.
    """

    fields: dict[str, int] = field(default_factory=dict)
    constraints: list[int] = field(default_factory=list)
    placements: list[int] = field(default_factory=list)
    nodes: list[int] = field(default_factory=list)


def render_source_map(maps: dict[str, ScenarioMap]) -> str:
    """Return the maps of a module's scenarios as one line of JSON."""
    scenarios = {name: asdict(each) for name, each in maps.items()}
    content = {"version": VERSION, "scenarios": scenarios}
    return in_json(json.dumps(content, separators=(",", ":"), ensure_ascii=False)) + "\n"
