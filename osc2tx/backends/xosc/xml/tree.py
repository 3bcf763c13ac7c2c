"""Elements of a document, and the document as text.

Elements are immutable. Order and versions are those of `schema`: a document that a version does
not allow is a mistake of osc2tx, never one of the scenario.
"""

from __future__ import annotations

import re
from typing import TypeAlias

from lxml import etree

from osc2tx.backends.xosc.report import Inexpressible
from osc2tx.backends.xosc.values.symbolic_numbers import Symbol
from osc2tx.backends.xosc.xml.names import number_text
from osc2tx.backends.xosc.xml.schema import (
    ROOT_TYPE,
    attribute_order,
    child_order,
    element_type,
    literals,
    required_attributes,
    required_children,
)
from osc2tx.diagnostics import InternalCompilerError
from osc2tx.options import XmlVersion
from osc2tx_shared.classes import dataclass
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
"""Elements whose children are parts of one thing: they stay on one line."""


def lay_out(node: etree._Element, line: str = "\n") -> None:
    """Put white space between the elements below a node; there is none yet.

    Each of several children begins a line, an only child of no list stands on that of its parent.
    That depends on no value, so that a longer one changes only its own line.

    Args:
        node: The node.
        line: What begins the line that it stands on.
    """
    if len(node) == 0 or node.tag in TOGETHER:
        return
    if len(node) == 1 and node.tag not in LISTS:
        lay_out(node[0], line)
        return
    inner = f"{line}  "
    node.text = inner
    for child in node:
        lay_out(child, inner)
        child.tail = inner
    node[-1].tail = line


Value: TypeAlias = str | int | float | bool


@dataclass(frozen=True, slots=True)
class Element:
    """An element.

    Attributes:
        name: Its tag.
        attributes: Their texts, in any order.
        children: In any order where the schema gives one; elements of one name keep theirs.
        text: What stands in it.
    """

    name: str
    attributes: tuple[tuple[str, str], ...] = ()
    children: tuple[Element, ...] = ()
    text: str | None = None

    def get(self, attribute: str) -> str | None:
        """Return the text of an attribute."""
        return dict(self.attributes).get(attribute)


def element(tag: str, /, *children: Element | None, **attributes: Value | None) -> Element:
    """Return an element; what is `None` is left out.

    An underscore at the end of a name is dropped: `from_` is the attribute `from`.
    """
    given = ((key.removesuffix("_"), value) for key, value in attributes.items())
    texts = tuple((key, text_of(value)) for key, value in given if value is not None)
    return Element(tag, texts, tuple(c for c in children if c is not None))


def text_of(value: Value) -> str:
    """Return the text of a value; numbers are as short as possible, without exponent.

    Raises:
        Inexpressible: It is a text that XML cannot hold, or that readers take for a parameter.
    """
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, Symbol):
        return value.attribute
    if isinstance(value, float):
        return number_text(value)
    if isinstance(value, str):
        _require_plain_text(value)
    return str(value)


_NOT_XML = re.compile("[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def _require_plain_text(text: str) -> None:
    if text.startswith("$"):
        raise Inexpressible(f"{text!r} begins with `$`, so it would be taken for a parameter")
    if _NOT_XML.search(text):
        raise Inexpressible(f"{text!r} has characters that XML cannot hold")


def serialize(root: Element, version: XmlVersion) -> str:
    """Return a document as text.

    Raises:
        InternalCompilerError: If the version has no such document.
    """
    tree = _build(root, ROOT_TYPE, version)
    lay_out(tree)
    body = etree.tostring(tree, encoding="unicode")
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{in_xml(body)}\n'


def _build(node: Element, parent_type: str, version: XmlVersion) -> etree._Element:
    part = element_type(parent_type).children.get(node.name)
    if part is None or not part.is_in(version):
        raise _impossible(f"<{node.name}> below {parent_type or 'the document'}", version)
    made = etree.Element(node.name)
    made.text = node.text
    for name, text in _ordered_attributes(node, part.type, version):
        made.set(name, text)
    present = {child.name for child in node.children}
    for name in required_children(part.type, version):
        if name not in present:
            raise _impossible(f"<{node.name}> without <{name}>", version)
    order = child_order(part.type)
    for child in sorted(node.children, key=lambda c: order.get(c.name, 0)):
        made.append(_build(child, part.type, version))
    return made


def _ordered_attributes(node: Element, type_: str, version: XmlVersion) -> list[tuple[str, str]]:
    given = dict(node.attributes)
    known_parts = element_type(type_).attributes
    for name, text in given.items():
        part = known_parts.get(name)
        if part is None or not part.is_in(version):
            raise _impossible(f"{name} of <{node.name}>", version)
        known = literals(part.type, version)
        if known is not None and text not in known and not text.startswith("$"):
            raise _impossible(f"{name}={text!r} of <{node.name}>", version)
    for name in required_attributes(type_, version):
        if name not in given:
            raise _impossible(f"<{node.name}> without {name}", version)
    return [(name, given[name]) for name in attribute_order(type_) if name in given]


def _impossible(what: str, version: str) -> InternalCompilerError:
    return InternalCompilerError(f"OpenSCENARIO XML {version} has no {what}")
