"""How a document is broken into lines: one for each thing that it says, so that diffs are short.

Lines do not depend on how long they are, so a longer name or number changes no line but its own.
Each member of a list begins a line; so does each condition of a trigger that has several, and each
part of an event or an object but the first. All else stands on one line, curves too: their corners
are computed together and change together.

    <Event …><Action …><PrivateAction>…</PrivateAction></Action>
      <StartTrigger><ConditionGroup>
        <Condition …>…</Condition>
        <Condition …>…</Condition>
      </ConditionGroup></StartTrigger></Event>
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
        "ParameterValueDistribution",
        "Deterministic",
        "ValueSetDistribution",
    }
)
"""Elements that list others: each of those begins a line, and the end tag does."""

ALTERNATIVES = frozenset({"StartTrigger", "StopTrigger", "ConditionGroup"})
"""Elements that are lists where they have more than one child."""

PARTS = frozenset({"Event", "Vehicle", "Pedestrian", "MiscObject"})
"""Elements whose first child stands on their line; each of the others begins a line."""


def lay_out(node: etree._Element, line: str = "\n") -> None:
    """Put white space between the elements below a node; there is none yet.

    Args:
        node: The node.
        line: What begins the line that it stands on.
    """
    inner = f"{line}  "
    is_list = node.tag in LISTS or (node.tag in ALTERNATIVES and len(node) > 1)
    previous: etree._Element | None = None
    for child in node:
        begins = is_list or (node.tag in PARTS and previous is not None)
        if begins and previous is None:
            node.text = inner
        elif begins and previous is not None:
            previous.tail = inner
        lay_out(child, inner if begins else line)
        previous = child
    if is_list and previous is not None:
        previous.tail = line
