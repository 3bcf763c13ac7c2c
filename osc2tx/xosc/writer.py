"""A document as text: parts in the order of the schema, laid out so that a change stays small.

A document that its version does not allow is a mistake of osc2tx, never one of the scenario.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from osc2tx.diagnostics import InternalCompilerError
from osc2tx.options import XmlVersion
from osc2tx.xosc.checking import problems
from osc2tx.xosc.element import Element
from osc2tx.xosc.schema import ROOT_TYPE, attribute_order, child_order, type_below
from osc2tx_shared.text import in_xml

LISTS = frozenset(
    {
        "OpenSCENARIO",
        "ParameterDeclarations",
        "VariableDeclarations",
        "MonitorDeclarations",
        "Entities",
        "ScenarioObject",
        "Vehicle",
        "Pedestrian",
        "MiscObject",
        "Storyboard",
        "Init",
        "Actions",
        "Private",
        "Story",
        "Act",
        "ManeuverGroup",
        "Maneuver",
        "Event",
        "StartTrigger",
        "StopTrigger",
        "ConditionGroup",
        "ParameterValueDistribution",
        "Deterministic",
        "ValueSetDistribution",
    }
)
"""Elements that list others: each of those begins a line, and the end tag does."""

TOGETHER = frozenset({"BoundingBox", "ConstraintGroup", "Polyline", "Properties"})
"""Elements whose children stay on one line."""


def serialize(root: Element, version: XmlVersion) -> str:
    """Return a document as text.

    Raises:
        InternalCompilerError: If the version has no such document.
    """
    for problem in problems(root, version):
        if not problem.is_warning:
            raise InternalCompilerError(f"OpenSCENARIO XML {version} has no {problem.reason}")
    return written(root)


def written(root: Element) -> str:
    """Return a document as text, without checks."""
    body = "".join(_with_notes(_element(root, type_below(ROOT_TYPE, root.tag), "\n")))
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{in_xml(body)}'


class _Note(str):
    """The origins of the numbers of the line."""

    __slots__ = ()


def _with_notes(parts: Iterable[str]) -> Iterator[str]:
    """Yield parts of the text, and the notes of a line as a comment at its end."""
    notes: dict[str, None] = {}
    for part in (*parts, "\n"):
        if isinstance(part, _Note):
            notes[part] = None
            continue
        if part.startswith("\n") and notes:
            yield f"  <!-- {_uncommented('; '.join(notes))} -->"
            notes = {}
        yield part


def _uncommented(text: str) -> str:
    """Return a text as a comment may have it: without two dashes."""
    return re.sub("-(?=-)", "- ", text)


def _element(node: Element, type_: str, line: str | None) -> Iterator[str]:
    """Yield the text of an element of a type; children that the type does not have are at the end.

    Each of several children begins a line, an only child of no list is on the line of its parent.
    This is independent of values, so a longer value changes only its own line.

    Args:
        node: The element.
        type_: Its type in the schema.
        line: Beginning of its line; `None`: all of it stays on one line.
    """
    given = dict(node.attributes)
    known = [name for name in attribute_order(type_) if name in given]
    names = dict.fromkeys((*known, *given))
    yield from map(_Note, node.notes)
    start = "".join((node.tag, *(f' {name}="{_quoted(given[name])}"' for name in names)))
    if not node.children and node.text is None:
        yield f"<{start}/>"
        return
    yield f"<{start}>{_escaped(node.text or '')}"
    order = child_order(type_)
    children = sorted(node.children, key=lambda each: order.get(each.tag, len(order)))
    inner = None if node.tag in TOGETHER else line
    is_list = inner is not None and children and (len(children) > 1 or node.tag in LISTS)
    if is_list:
        inner = f"{line}  "
    for child in children:
        if is_list:
            yield f"{inner}"
        yield from _element(child, type_below(type_, child.tag), inner)
    yield f"{line}</{node.tag}>" if is_list else f"</{node.tag}>"


def _escaped(text: str) -> str:
    for char, reference in _REFERENCES:
        text = text.replace(char, reference)
    return text


_REFERENCES = (("&", "&amp;"), ("<", "&lt;"), (">", "&gt;"), ("\r", "&#13;"))


def _quoted(text: str) -> str:
    """Return a text as an attribute has it: readers take white space there for blanks."""
    text = _escaped(text).replace('"', "&quot;")
    return text.replace("\n", "&#10;").replace("\t", "&#9;")
