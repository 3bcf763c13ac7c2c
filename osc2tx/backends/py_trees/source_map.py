"""The sidecar map: which source line each part of a generated module comes from.

The module itself cites lines only at the head of its methods, so that inserting one statement
in the source does not stir the rest. Everything else is looked up here at run time.
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import dataclass, field

from osc2tx import ir

VERSION = 1


@dataclass(slots=True)
class ScenarioMap:
    """The entries of one scenario.

    Attributes:
        file: Source file.
        line: Line of the scenario's declaration.
        fields: Line of each declaration, by Python name.
        constraints: Line and text of each constraint, in order.
        placements: Line of each placement, in order.
        nodes: Line and readable name of each node of the tree, in pre-order.
        invocations: Names of the invoked scenarios, in the same order.
        draws: What their random values depend on besides the seed, in the same order.
    """

    file: str
    line: int
    fields: dict[str, int] = field(default_factory=dict)
    constraints: list[tuple[int, str]] = field(default_factory=list)
    placements: list[int] = field(default_factory=list)
    nodes: list[tuple[int, str]] = field(default_factory=list)
    invocations: list[str] = field(default_factory=list)
    draws: list[str] = field(default_factory=list)


def scenario_map(scenario: ir.Scenario) -> ScenarioMap:
    """Return an empty map for a scenario."""
    return ScenarioMap(scenario.span.source.name, scenario.span.line)


def render_source_map(maps: dict[str, ScenarioMap]) -> str:
    """Return the map as JSON, an entry a line, so that diffs stay local."""
    scenarios = ",\n".join(f"  {_string(name)}: {_scenario(m)}" for name, m in maps.items())
    return f'{{"version": {VERSION}, "scenarios": {{\n{scenarios}\n}}}}\n'


def _scenario(entry: ScenarioMap) -> str:
    fields = _lines(f"{_string(name)}: {line}" for name, line in entry.fields.items())
    nodes = _lines(f"[{line}, {_string(name)}]" for line, name in entry.nodes)
    constraints = _lines(f"[{line}, {_string(text)}]" for line, text in entry.constraints)
    kept = f'    "constraints": [{constraints}],\n' if constraints else ""
    placements = ", ".join(map(str, entry.placements))
    names = ", ".join(map(_string, entry.invocations))
    invocations = f'    "invocations": [{names}],\n' if names else ""
    keys = _lines(map(_string, entry.draws))
    draws = f'    "draws": [{keys}],\n' if keys else ""
    return (
        f'{{"file": {_string(entry.file)}, "line": {entry.line},\n'
        f'    "fields": {{{fields}}},\n'
        f"{kept}"
        f'    "placements": [{placements}],\n'
        f"{invocations}"
        f"{draws}"
        f'    "nodes": [{nodes}]}}'
    )


def _lines(items: Iterable[str]) -> str:
    return ",\n      ".join(items)


def _string(text: str) -> str:
    return json.dumps(text, ensure_ascii=False)
