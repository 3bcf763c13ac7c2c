"""What each version of OpenSCENARIO XML has: elements, their order, attributes and literals.

The table `schema.json` is made from the schemas by `tools/make_xosc_schema.py`.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from functools import cache
from importlib.resources import files
from typing import Any, NamedTuple

from osc2tx.options import XmlVersion

ROOT_TYPE = ""
"""Type of the document; its only child is the root element."""


class Part(NamedTuple):
    """An attribute or a child of an element.

    Attributes:
        type: Its type in the schema.
        since: First version that has it.
        until: Last version that has it.
        required: Versions in which it cannot be left out.
    """

    type: str
    since: str
    until: str
    required: Sequence[str]

    def is_in(self, version: XmlVersion) -> bool:
        """Whether a version has it."""
        return self.since <= version <= self.until


class ElementType(NamedTuple):
    """A type of the schema, its parts in the order of the schema."""

    attributes: Mapping[str, Part]
    children: Mapping[str, Part]


class _Tables(NamedTuple):
    types: Mapping[str, ElementType]
    enums: Mapping[str, Mapping[str, Sequence[str]]]


@cache
def _tables() -> _Tables:
    text = (files(__package__) / "schema.json").read_text(encoding="utf-8")
    data: Any = json.loads(text)
    types = {
        name: ElementType(
            {key: Part(*part) for key, part in entry["attributes"].items()},
            {key: Part(*part) for key, part in entry["children"].items()},
        )
        for name, entry in data["types"].items()
    }
    return _Tables(types, data["enums"])


@cache
def element_type(name: str) -> ElementType:
    """Return a type of the schema; one without parts for simple types."""
    return _tables().types.get(name, ElementType({}, {}))


def has_attribute(type_name: str, attribute: str, version: XmlVersion) -> bool:
    """Whether elements of a type have an attribute in a version."""
    part = element_type(type_name).attributes.get(attribute)
    return part is not None and part.is_in(version)


@cache
def required_attributes(type_name: str, version: XmlVersion) -> tuple[str, ...]:
    """Return the attributes that elements of a type must have in a version."""
    parts = element_type(type_name).attributes
    return tuple(name for name, part in parts.items() if version in part.required)


@cache
def required_children(type_name: str, version: XmlVersion) -> tuple[str, ...]:
    """Return the children that elements of a type must have in a version."""
    parts = element_type(type_name).children
    return tuple(name for name, part in parts.items() if version in part.required)


@cache
def attribute_order(type_name: str) -> tuple[str, ...]:
    """Return the attributes of a type: `name` first, for people, the rest as in the schema."""
    return tuple(sorted(element_type(type_name).attributes, key=lambda name: name != "name"))


@cache
def child_order(type_name: str) -> Mapping[str, int]:
    """Return the place of each child of a type among the others."""
    return {name: place for place, name in enumerate(element_type(type_name).children)}


@cache
def literals(type_name: str, version: XmlVersion) -> frozenset[str] | None:
    """Return the literals that an enumeration has in a version; `None` for other types."""
    enum = _tables().enums.get(type_name)
    if enum is None:
        return None
    return frozenset(name for name, (since, until) in enum.items() if since <= version <= until)
