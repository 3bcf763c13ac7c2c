"""Pictures of a behavior tree: text for terminals, SVG for documents."""

from __future__ import annotations

from xml.etree import ElementTree

from osc2tx_runtime.language.outline import OutlineNode, outline
from osc2tx_runtime.language.tree import Behaviour
from osc2tx_shared.classes import replace
from osc2tx_shared.text import visible

ROW = 26
STEP = 28
MARGIN = 16
CHARACTER = 7.3  # approximate width in the font below
COLORS = {
    "serial": "#2463c9",
    "parallel": "#8e3fb8",
    "one_of": "#b8860b",
    "action": "#12805c",
    "until": "#d9480f",
    "wait": "#d9480f",
    "emit": "#c2255c",
}
OTHER_COLOR = "#5c6470"
BOLD, FAINT, RESET = "\x1b[1m", "\x1b[2m", "\x1b[0m"
LEAST_TEXT = 20  # least columns for the nodes


def tree_text(root: Behaviour, *, columns: int | None = None, color: bool = False) -> str:
    """Return the tree as lines of text, with the source positions in a separate column.

    Args:
        root: The result of `create_root` of a generated module.
        columns: Width of the lines, to which texts of nodes are truncated; None: not truncated.
        color: Whether to use the colors of a terminal.
    """
    rows = _rows(root)
    lines = [f"{_branches(row.last)}{_words(row)}" for row in rows]
    if columns is not None:
        room = max(columns - 2 - max(len(row.source) for row in rows), LEAST_TEXT)
        lines = [line if len(line) <= room else f"{line[: room - 1]}\u2026" for line in lines]
    width = max(map(len, lines))
    texts = []
    for line, row in zip(lines, rows, strict=True):
        gap = " " * (width - len(line) + 2) if row.source else ""
        place = f"{FAINT}{row.source}{RESET}" if color and row.source else row.source
        texts.append(f"{_painted(line, row) if color else line}{gap}{place}".rstrip() + "\n")
    return "".join(texts)


def _painted(line: str, row: OutlineNode) -> str:
    """The line with the kind of a node, if it has one, in bold."""
    branches = _branches(row.last)
    kind = "" if row.kind == "action" else row.kind
    begins = kind and line.startswith(branches + kind)
    return f"{branches}{BOLD}{kind}{RESET}{line[len(branches + kind) :]}" if begins else line


def tree_svg(root: Behaviour) -> str:
    """Return the tree as an SVG document; equal trees give equal text.

    Args:
        root: The result of `create_root` of a generated module.
    """
    rows = _rows(root)
    column = max(
        len(row.last) * STEP + _chip_width(row) + len(row.text) * CHARACTER for row in rows
    )
    places = column + 2 * MARGIN
    width = places + max(len(row.source) for row in rows) * CHARACTER + MARGIN
    height = 2 * MARGIN + ROW * len(rows)
    svg = ElementTree.Element("svg", xmlns="http://www.w3.org/2000/svg")
    svg.set("width", _number(width))
    svg.set("height", _number(height))
    svg.set("viewBox", f"0 0 {_number(width)} {_number(height)}")
    svg.set("font-family", "ui-monospace, 'DejaVu Sans Mono', Menlo, monospace")
    svg.set("font-size", "12")
    ElementTree.SubElement(svg, "title").text = visible(root.name)
    ElementTree.SubElement(svg, "rect", width="100%", height="100%", fill="#ffffff")
    _draw_branches(svg, rows)
    for index, row in enumerate(rows):
        _draw_row(svg, row, MARGIN + ROW * index, places)
    ElementTree.indent(svg)
    return ElementTree.tostring(svg, encoding="unicode") + "\n"


def _rows(root: Behaviour) -> list[OutlineNode]:
    """The nodes, with texts for a terminal."""
    return [
        replace(row, text=visible(row.text), source=visible(row.source)) for row in outline(root)
    ]


def _words(row: OutlineNode) -> str:
    return row.text if row.kind == "action" else f"{row.kind} {row.text}".rstrip()


def _branches(last: tuple[bool, ...]) -> str:
    if not last:
        return ""
    above = "".join("   " if ended else "│  " for ended in last[:-1])
    return above + ("└─ " if last[-1] else "├─ ")


# --- SVG --------------------------------------------------------------------------------------


def _draw_branches(svg: ElementTree.Element, rows: list[OutlineNode]) -> None:
    """Draw a line from each node to its members."""
    parents: dict[int, int] = {}  # depth to the row of the last node there
    path = []
    for index, row in enumerate(rows):
        depth = len(row.last)
        parents[depth] = index
        if depth:
            x = MARGIN + STEP * (depth - 1) + STEP / 3
            top = MARGIN + ROW * parents[depth - 1] + ROW * 0.85
            middle = MARGIN + ROW * index + ROW / 2
            right = MARGIN + STEP * depth
            path.append(f"M{_number(x)} {_number(top)}V{_number(middle)}H{_number(right)}")
    ElementTree.SubElement(svg, "path", d="".join(path), fill="none", stroke="#c5ccd6")


def _draw_row(svg: ElementTree.Element, row: OutlineNode, top: float, places: float) -> None:
    left = MARGIN + STEP * len(row.last)
    baseline = _number(top + ROW / 2 + 4)
    chip = _chip_width(row)
    ElementTree.SubElement(
        svg,
        "rect",
        x=_number(left),
        y=_number(top + 4),
        width=_number(chip),
        height=_number(ROW - 8),
        rx="4",
        fill=COLORS.get(row.kind, OTHER_COLOR),
    )
    kind = {"x": _number(left + chip / 2), "y": baseline, "fill": "#ffffff"}
    ElementTree.SubElement(svg, "text", {**kind, "text-anchor": "middle"}).text = row.kind
    words = {"x": _number(left + chip + 8), "y": baseline, "fill": "#1d2430"}
    ElementTree.SubElement(svg, "text", words).text = row.text
    place = {"x": _number(places), "y": baseline, "fill": "#8993a2"}
    ElementTree.SubElement(svg, "text", place).text = row.source


def _chip_width(row: OutlineNode) -> float:
    return len(row.kind) * CHARACTER + 12


def _number(value: float) -> str:
    return f"{value:.1f}".removesuffix(".0")
