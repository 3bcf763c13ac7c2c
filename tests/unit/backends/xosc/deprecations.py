"""What of a document its schema calls deprecated."""

from collections.abc import Iterator
from functools import cache
from typing import Any

from lxml import etree

from tests.unit.xosc.schemas import schema_of

XSD = "{http://www.w3.org/2001/XMLSchema}"
ROOT_TYPE = "OpenScenario"


def deprecated(xml: str, version: str) -> set[str]:
    """Return types, elements, attributes and literals that a version would not have any more."""
    return set(_below(etree.fromstring(xml.encode()), ROOT_TYPE, version))


@cache
def _declared(version: str) -> dict[str, Any]:
    """Return types and groups of a schema by name."""
    root = schema_of(version)
    return {node.get("name"): node for node in root if node.tag != f"{XSD}element"}


def _is_deprecated(node: Any) -> bool:
    notes = node.iterfind(f"{XSD}annotation/{XSD}appinfo")
    return any((note.text or "").strip() == "deprecated" for note in notes)


def _elements(node: Any, version: str) -> Iterator[Any]:
    """Yield the elements that a type or a group allows."""
    for part in node.iter(f"{XSD}element", f"{XSD}group"):
        if part.tag == f"{XSD}element":
            yield part
        elif part.get("ref") is not None:
            yield from _elements(_declared(version)[part.get("ref")], version)


def _below(node: Any, type_name: str, version: str) -> Iterator[str]:
    declared = _declared(version)
    type_ = declared.get(type_name)
    if type_ is None:
        return
    if _is_deprecated(type_):
        yield type_name
    for attribute in type_.iter(f"{XSD}attribute"):
        name, value = attribute.get("name"), node.get(attribute.get("name"))
        if value is None:
            continue
        if _is_deprecated(attribute):
            yield f"{type_name}@{name}"
        enum = declared.get(attribute.get("type"))
        literals = () if enum is None else enum.iter(f"{XSD}enumeration")
        if any(_is_deprecated(each) for each in literals if each.get("value") == value):
            yield f"{attribute.get('type')} {value}"
    parts = {part.get("name"): part for part in _elements(type_, version)}
    for child in node:
        part = parts.get(child.tag)
        if part is not None:
            if _is_deprecated(part):
                yield f"{type_name}/{child.tag}"
            yield from _below(child, part.get("type"), version)
