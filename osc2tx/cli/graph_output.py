"""Graphs of uses: text, JSON, Graphviz, SVG."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple
from xml.etree import ElementTree

from osc2tx.building.usage_graph import Node
from osc2tx_shared.classes import dataclass
from osc2tx_shared.text import in_json, visible

VERSION = 1
COLORS = {
    "scenario": "#2463c9",
    "actor": "#12805c",
    "action": "#8e3fb8",
    "modifier": "#b8860b",
    "struct": "#c2255c",
    "enum": "#d9480f",
    "map": "#0b7285",
}
OTHER_COLOR = "#5c6470"
ROW, GAP, MARGIN, PADDING = 30, 90, 16, 10
CHARACTER = 7.3  # width of one in the font below, as far as it is known
SWEEPS = 8  # over the columns, to put users beside what they use


@dataclass(frozen=True, slots=True)
class Graph:
    """A part of the graph of a project.

    Attributes:
        nodes: Its nodes, in order.
        edges: The nodes that each node uses.
    """

    nodes: Sequence[Node]
    edges: Mapping[Node, Sequence[Node]]


def render_tree(start: Sequence[Node], edges: Mapping[Node, Sequence[Node]]) -> Iterator[str]:
    """Yield the lines of a tree for each start; a node that was shown before is not opened again.

    Args:
        start: The first node.
        edges: The targets of each node.
    """
    seen: set[Node] = set()
    for root in start:
        pending = [(root, "", "")]
        while pending:
            node, branch, indent = pending.pop()
            others = edges[node]
            is_known = node in seen and bool(others)
            yield visible(f"{branch}{node}") + (" …" if is_known else "")
            if is_known:
                continue
            seen.add(node)
            for index, each in enumerate(reversed(others)):
                tick, inner = ("└── ", "    ") if index == 0 else ("├── ", "│   ")
                pending.append((each, indent + tick, indent + inner))


def render_json(graph: Graph, affected: Mapping[str, Sequence[str]] | None = None) -> str:
    """Return nodes, and edges from user to used by number of the node.

    Args:
        graph: The graph.
        affected: Affected sources with the files that changed, instead of a graph.
    """
    number = {node: index for index, node in enumerate(graph.nodes)}
    document: dict[str, object] = {"version": VERSION}
    if affected is None:
        document["nodes"] = [node._asdict() for node in graph.nodes]
        document["edges"] = [
            [number[node], number[each]] for node in graph.nodes for each in graph.edges[node]
        ]
    else:
        document["affected"] = [
            {"file": file, "causes": list(causes)} for file, causes in affected.items()
        ]
    return in_json(json.dumps(document, indent=1)) + "\n"


def render_dot(graph: Graph) -> str:
    """Return the graph for Graphviz."""
    lines = ["digraph project {", "  rankdir=LR;", '  node [shape=box, fontname="sans-serif"];']
    lines += [
        f"  {_quoted(str(node))} [label={_quoted(node.name)}, color={_quoted(_color(node))}];"
        for node in graph.nodes
    ]
    lines += [
        f"  {_quoted(str(node))} -> {_quoted(str(each))};"
        for node in graph.nodes
        for each in graph.edges[node]
    ]
    return "\n".join([*lines, "}", ""])


def _quoted(text: str) -> str:
    escaped = visible(text).replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'


class _Point(NamedTuple):
    """A place in a column: a node in its own, else where edges to it pass."""

    node: Node
    column: int


def render_svg(graph: Graph) -> str:
    """Return a picture: users to the left of their nodes; edges to one node are bundled."""
    own = _own_columns(graph)
    edges = _edges(graph, own)
    columns = _ordered(edges, own)
    places: dict[_Point, tuple[float, float, float]] = {}
    x: float = MARGIN
    tallest = max((len(column) for column in columns), default=0)
    for column in columns:
        names = [len(each.node.name) for each in column if own[each.node] == each.column]
        width = max(names, default=0) * CHARACTER + 2 * PADDING
        top = MARGIN + (tallest - len(column)) * ROW / 2
        for row, point in enumerate(column):
            places[point] = (x, top + row * ROW, width)
        x += width + GAP
    size = (f"{max(x - GAP + MARGIN, 2 * MARGIN):.0f}", f"{2 * MARGIN + tallest * ROW}")
    svg = ElementTree.Element(
        "svg",
        {
            "xmlns": "http://www.w3.org/2000/svg",
            "width": size[0],
            "height": size[1],
            "viewBox": f"0 0 {size[0]} {size[1]}",
            "font-family": "ui-monospace, monospace",
            "font-size": "12",
        },
    )
    ElementTree.SubElement(svg, "rect", {"width": size[0], "height": size[1], "fill": "#ffffff"})
    for start, ends in edges.items():
        for end in ends:
            _draw_edge(svg, places[start], places[end], is_through=own[start.node] != start.column)
    for node in graph.nodes:
        _draw_node(svg, node, places[_Point(node, own[node])])
    ElementTree.indent(svg)
    return ElementTree.tostring(svg, encoding="unicode") + "\n"


def _draw_edge(
    svg: ElementTree.Element,
    start: tuple[float, float, float],
    end: tuple[float, float, float],
    *,
    is_through: bool,
) -> None:
    left = start[0] if is_through else start[0] + start[2]
    x1, y1, x2, y2 = start[0] + start[2], start[1] + ROW / 2, end[0], end[1] + ROW / 2
    bend = max(abs(x2 - x1) / 2, GAP / 2)
    curve = f"C{x1 + bend:.0f} {y1:.0f} {x2 - bend:.0f} {y2:.0f} {x2:.0f} {y2:.0f}"
    style = {"fill": "none", "stroke": "#9aa3af", "stroke-opacity": "0.6"}
    ElementTree.SubElement(svg, "path", {"d": f"M{left:.0f} {y1:.0f}H{x1:.0f}{curve}", **style})


def _draw_node(svg: ElementTree.Element, node: Node, place: tuple[float, float, float]) -> None:
    x, y, width = place
    box = {"x": f"{x:.0f}", "y": f"{y + 4:.0f}", "width": f"{width:.0f}", "height": f"{ROW - 8}"}
    style = {"rx": "4", "fill": "#ffffff", "stroke": _color(node)}
    ElementTree.SubElement(svg, "rect", {**box, **style})
    place_of_text = {"x": f"{x + PADDING:.0f}", "y": f"{y + ROW / 2 + 4:.0f}"}
    text = ElementTree.SubElement(svg, "text", {**place_of_text, "fill": _color(node)})
    text.text = visible(node.name)
    ElementTree.SubElement(text, "title").text = visible(str(node))


def _color(node: Node) -> str:
    return COLORS.get(node.kind, OTHER_COLOR)


def _own_columns(graph: Graph) -> dict[Node, int]:
    """Return the columns of nodes: the longest distance from a node that nothing uses."""
    own = dict.fromkeys(graph.nodes, 0)
    for node in _users_first(graph):
        for each in graph.edges[node]:
            own[each] = max(own[each], own[node] + 1)
    return own


def _edges(graph: Graph, own: Mapping[Node, int]) -> dict[_Point, dict[_Point, None]]:
    """Return the edges from column to column; in a circle, some lead back."""
    edges: dict[_Point, dict[_Point, None]] = {_Point(n, own[n]): {} for n in graph.nodes}
    for node in graph.nodes:
        for used in graph.edges[node]:
            point = _Point(node, own[node])
            for column in range(own[node] + 1, own[used]):
                passing = _Point(used, column)
                edges[point][passing] = None
                point = passing
                edges.setdefault(point, {})
            edges[point][_Point(used, own[used])] = None
    return edges


def _ordered(
    edges: Mapping[_Point, Mapping[_Point, None]], own: Mapping[Node, int]
) -> list[list[_Point]]:
    """Return the points of each column so that those that are connected are at one height."""
    last = max(own.values(), default=-1)
    columns = [[p for p in edges if p.column == column] for column in range(last + 1)]
    users: dict[_Point, list[_Point]] = {point: [] for point in edges}
    for point, others in edges.items():
        for each in others:
            users[each].append(point)
    for sweep in range(SWEEPS):
        neighbours: Mapping[_Point, Iterable[_Point]] = edges if sweep % 2 else users
        middle = {p: i - len(column) / 2 for column in columns for i, p in enumerate(column)}
        for column in columns if sweep % 2 == 0 else reversed(columns):
            heights = {}
            for point in column:
                near = [middle[each] for each in neighbours[point]]
                heights[point] = sum(near) / len(near) if near else middle[point]
            column.sort(key=heights.__getitem__)
            middle.update({p: index - len(column) / 2 for index, p in enumerate(column)})
    return columns


def _users_first(graph: Graph) -> list[Node]:
    """Return the nodes in topological order, users first, as far as there is no cycle."""
    done: dict[Node, None] = {}
    opened: set[Node] = set()
    for root in graph.nodes:
        pending = [(root, False)]
        while pending:
            node, is_left = pending.pop()
            if is_left:
                done[node] = None
            elif node not in opened:
                opened.add(node)
                pending.append((node, True))
                pending += [(each, False) for each in graph.edges[node] if each not in opened]
    return list(reversed(done))
