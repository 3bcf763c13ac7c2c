"""How a document is broken into lines: one for each thing that it says, so that diffs are short.

An action, a condition, a parameter is a line of its own, however deep its elements are nested. What
would be too long has a line for each part.
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

HEADED = frozenset({"Event"})
"""Lists whose first member stands on the line of their start tag."""

WIDTH = 400
"""Characters of an element, without its indentation, that share a line."""


def lay_out(node: etree._Element, outer: str = "\n") -> None:
    """Put white space between the elements below a node.

    Args:
        node: The node; there is none yet.
        outer: What begins a line on which its end tag stands.
    """
    if not len(node) or not (node.tag in LISTS or _length(node) > WIDTH):
        return
    if len(node) == 1 and node.tag not in LISTS:  # the two share their lines
        lay_out(node[0], outer)
        return
    inner = f"{outer}  "
    node.text = None if node.tag in HEADED else inner
    for child in node:
        lay_out(child, inner)
        child.tail = inner
    node[-1].tail = outer


def _length(node: etree._Element) -> int:
    return len(etree.tostring(node, encoding="unicode"))
