"""Constructs of a document that a version of OpenSCENARIO XML does not allow, or discourages.

The schemas do not express all rules: an empty `choice` is valid up to 1.2. Documents are compared
with the schemas; references and names are checked where the storyboard is read.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from functools import cache
from typing import TypeAlias

from osc2tx.options import XML_VERSIONS, XmlVersion
from osc2tx.xosc.element import Element, Place
from osc2tx.xosc.schema import (
    ROOT_TYPE,
    Part,
    all_literals,
    element_type,
    literals,
    required_attributes,
    required_children,
    type_below,
)
from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True)
class Problem:
    """A finding in a document.

    Attributes:
        reason: The part that the version does not have, or a sentence on a deprecated one.
        place: Where its element begins; `None`: it was not read from a file.
        is_warning: The document is valid.
    """

    reason: str
    place: Place | None
    is_warning: bool = False


def version_of(root: Element) -> XmlVersion:
    """Return the version that a document states; the newest known one if that is newer.

    Without a statement it is the first version.
    """
    header = next((child for child in root.children if child.tag == "FileHeader"), None)
    major, minor = (_whole(header, name) for name in ("revMajor", "revMinor"))
    if major > 1:
        return XML_VERSIONS[-1]
    return XML_VERSIONS[min(max(minor, 0), len(XML_VERSIONS) - 1)]


def _whole(header: Element | None, name: str) -> int:
    text = "" if header is None else header.get(name) or ""
    return int(text) if text.strip().isdecimal() else 0


def problems(root: Element, version: XmlVersion) -> Iterator[Problem]:
    """Yield the defects of a document, in its order."""
    part = element_type(ROOT_TYPE).children.get(root.tag)
    if part is None:
        yield Problem(f"<{root.tag}> below the document", root.place)
        return
    yield from _of_tree(root, part.type, version)


def problems_of_entry(entry: Element, version: XmlVersion) -> Iterator[Problem]:
    """Yield the defects of an entry of a catalog."""
    part = element_type("Catalog").children.get(entry.tag)
    if part is None:
        yield Problem(f"<{entry.tag}> in a catalog", entry.place)
    else:
        yield from _of_tree(entry, part.type, version)


def _of_tree(root: Element, type_name: str, version: XmlVersion) -> Iterator[Problem]:
    """Yield what is wrong with an element of a type and all below it, in their order."""
    right: set[tuple[str, ...]] = set()  # types with the names and children that they may have
    pending = [(root, type_name)]
    while pending:
        node, type_name = pending.pop()
        tags = [child.tag for child in node.children]
        names = [name for name, _ in node.attributes]
        shape = (type_name, *names, "", *tags)
        if shape not in right:
            found = [
                problem
                for check in (_of_names, _of_children)
                for problem in check(node, type_name, version)
            ]
            yield from found
            if not found:
                right.add(shape)
        yield from _of_texts(node, type_name, version)
        known = element_type(type_name).children
        pending += [
            (child, type_below(type_name, tag))
            for tag, child in zip(reversed(tags), reversed(node.children), strict=True)
            if tag in known
        ]


def _of_children(node: Element, type_name: str, version: XmlVersion) -> Iterator[Problem]:
    type_ = element_type(type_name)
    counts = Counter(child.tag for child in node.children)
    seen = set()
    for child in node.children:
        part = type_.children.get(child.tag)
        if part is None or not part.is_in(version):
            yield Problem(f"<{child.tag}> below <{node.tag}>", child.place)
        elif child.tag in seen:
            continue
        elif counts[child.tag] > 1 and not part.many:
            yield Problem(f"second <{child.tag}> below <{node.tag}>", child.place)
        elif is_deprecated(part, version):
            yield Problem(f"<{child.tag}> is deprecated", child.place, is_warning=True)
        seen.add(child.tag)
    for name in required_children(type_name, version):
        if name not in counts:
            yield Problem(f"<{node.tag}> without <{name}>", node.place)
    chosen = sorted(seen & set(type_.choice_in(version)))
    if len(chosen) > 1:
        yield Problem(f"<{node.tag}> with both <{chosen[0]}> and <{chosen[1]}>", node.place)
    elif not chosen and version in type_.needed:
        listed = " or ".join(f"<{name}>" for name in type_.choice)
        yield Problem(f"<{node.tag}> without {listed}", node.place)


def is_deprecated(part: Part, version: XmlVersion) -> bool:
    """Whether a version discourages a part."""
    return bool(part.deprecated) and part.deprecated <= version


def _of_names(node: Element, type_name: str, version: XmlVersion) -> Iterator[Problem]:
    """Yield what is wrong with the attributes, whatever their texts are."""
    known = element_type(type_name).attributes
    given = [name for name, _ in node.attributes if not _is_of_xml(name)]
    for name in given:
        part = known.get(name)
        if part is None or not part.is_in(version):
            yield Problem(f"{name} of <{node.tag}>", node.place)
            continue
        if is_deprecated(part, version):
            yield Problem(f"{name} of <{node.tag}> is deprecated", node.place, is_warning=True)
    for name in required_attributes(type_name, version):
        if name not in given:
            yield Problem(f"<{node.tag}> without {name}", node.place)


def _of_texts(node: Element, type_name: str, version: XmlVersion) -> list[Problem]:
    """Return what is wrong with the texts of the attributes that there are in a version."""
    found: list[Problem] = []
    forms = _forms_of(type_name, version)
    for name, text in node.attributes:
        if (form := forms.get(name)) is not None and not form[0](text):
            found += _of_text(node, name, text, form[1], version)
    return found


def _is_of_xml(name: str) -> bool:
    """Whether an attribute belongs to XML itself, as the place of a schema does."""
    return name == "xmlns" or ":" in name


_FORMS = {
    "Double": re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?|-?INF|NaN"),
    "Int": re.compile(r"[-+]?\d+"),
    "UnsignedInt": re.compile(r"\+?\d+"),
    "UnsignedShort": re.compile(r"\+?\d+"),
    "Boolean": re.compile("true|false|0|1"),
    "DateTime": re.compile(
        r"-?\d{4,}-\d\d-\d\dT\d\d:\d\d:\d\d(\.\d+)?(Z|[-+]\d\d:\d\d)?", re.ASCII
    ),
}
_NOTHING = re.compile(r"(?!)")
_Form: TypeAlias = Callable[[str], object]


@cache
def _forms_of(type_name: str, version: XmlVersion) -> Mapping[str, tuple[_Form, str]]:
    """Return which texts of attributes are right without a closer look, with their types."""
    return {
        name: (_FORMS.get(part.type, _NOTHING).fullmatch, part.type)
        for name, part in element_type(type_name).attributes.items()
        if part.is_in(version)
    }


def _of_text(
    node: Element, name: str, text: str, type_name: str, version: XmlVersion
) -> Iterator[Problem]:
    if text.startswith("$"):
        return
    form = _FORMS.get(type_name)
    known = literals(type_name, version)
    wrong_form = form is not None and not form.fullmatch(text.strip())
    if wrong_form or (known is not None and text not in known):
        yield Problem(f"{name}={text!r} of <{node.tag}>", node.place)
    elif known is not None:
        since = all_literals(type_name)[text][2]
        if since and since <= version:
            reason = f"{name}={text!r} of <{node.tag}> is deprecated"
            yield Problem(reason, node.place, is_warning=True)
