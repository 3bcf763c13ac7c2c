"""Traces of scenarios that differ in the order of parallel members alone."""

import json
from collections.abc import Iterable


def whatever_the_order(lines: Iterable[str]) -> list[str]:
    """The lines, with the nodes of the tree sorted by what they are and when they ran."""
    return [_sorted_tree(line) if line.startswith('{"kind":"tree"') else line for line in lines]


def _sorted_tree(line: str) -> str:
    nodes = json.loads(line)["nodes"]
    return repr(sorted(repr((node["depth"], node["kind"], node["runs"])) for node in nodes))
