"""How a document is broken into lines: one for each thing that it says, so that diffs are short.

Each member of a list begins a line. What is too long for a line goes on below it, as many parts on
each line as there is room for; end tags follow together or stand on a line of their own:

    <Event …><Action …><PrivateAction><LateralAction><LaneChangeAction>
        <LaneChangeActionDynamics …/><LaneChangeTarget>…</LaneChangeTarget>
      </LaneChangeAction></LateralAction></PrivateAction></Action>
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
        "Polyline",
    }
)
"""Elements that list others: each of those begins a line, and the end tag does."""

EVENT = "Event"
"""An element whose first child stands on its line, and whose second one begins the next."""

WIDTH = 200
"""Characters of a line without its indentation: more have only single tags and names that long."""


def lay_out(node: etree._Element, line: str = "\n", used: int = 0, ends: int = 0) -> int:
    """Put white space between the elements below a node; there is none yet.

    Args:
        node: The node.
        line: What begins the line that it stands on.
        used: Characters before it on that line, without the indentation.
        ends: Characters of the end tags that follow it there.

    Returns:
        Characters up to its end on the line on which it ends.
    """
    is_list, is_event, length = node.tag in LISTS, node.tag == EVENT, _length(node)
    if not len(node) or (not is_list and not is_event and used + length <= WIDTH):
        return used + length
    end = len(f"</{node.tag}>")
    used += length - sum(map(_length, node)) - end
    ends = 0 if is_list else ends + end
    is_chain = len(node) == 1 and not is_list
    inner = line if is_chain else f"{line}  "
    for child in node:
        is_first, is_last = child is node[0], child is node[-1]
        is_far = used + (_start(child) if is_chain else _length(child)) > WIDTH
        if is_list or (not is_first if is_event else is_far):
            inner = f"{line}  "
            _break_before(child, inner)
            used = 0
        used = lay_out(child, inner, used, ends if is_last else 0)
    if is_list or used + ends > WIDTH:
        node[-1].tail, used = line, 0
    return used + end


def _break_before(child: etree._Element, line: str) -> None:
    previous, parent = child.getprevious(), child.getparent()
    if previous is not None:
        previous.tail = line
    elif parent is not None:
        parent.text = line


def _start(node: etree._Element) -> int:
    """Return how long the start tag of an element is, and the element if there is nothing in it."""
    if not len(node):
        return _length(node)
    return _length(node) - sum(map(_length, node)) - len(f"</{node.tag}>")


def _length(node: etree._Element) -> int:
    return len(etree.tostring(node, encoding="unicode", with_tail=False))
