"""How a document is broken into lines: one for each thing that it says, so that diffs are short.

An action, a condition, a parameter is a line of its own, however deep its elements are nested. What
would be too long has a line for each part. An event begins with its action and ends with its
trigger:

    <Event …><Action …>…</Action>
      <StartTrigger>…</StartTrigger></Event>
"""

from __future__ import annotations

from lxml import etree

LISTS = frozenset(
    {
        "OpenSCENARIO",
        "ParameterDeclarations",
        "VariableDeclarations",
        "MonitorDeclarations",
        "Entities",
        "Storyboard",
        "Init",
        "Actions",
        "Private",
        "Story",
        "Act",
        "ManeuverGroup",
        "Maneuver",
        "Event",
    }
)
"""Elements that list others: each of those begins a line."""

TAGLESS = frozenset({"Event"})
"""Lists whose tags stand on the lines of their first and last member."""

CURVES = frozenset({"Polyline"})
"""Elements that are one line whatever their length: a curve is one value."""

WIDTH = 400
"""Characters of an element, without its indentation, that share a line."""


def lay_out(node: etree._Element, outer: str = "\n") -> None:
    """Put white space between the elements below a node.

    Args:
        node: The node; there is none yet.
        outer: What begins a line on which its end tag stands.
    """
    if not len(node) or node.tag in CURVES:
        return
    if node.tag not in LISTS and _length(node) <= WIDTH:
        return
    if len(node) == 1 and node.tag not in LISTS:  # the two share their lines
        lay_out(node[0], outer)
        return
    inner = f"{outer}  "
    for child in node:
        lay_out(child, inner)
        child.tail = inner
    if node.tag in TAGLESS:
        node[-1].tail = None
    else:
        node.text, node[-1].tail = inner, outer


def _length(node: etree._Element) -> int:
    return len(etree.tostring(node, encoding="unicode"))
