"""The parts of each version of OpenSCENARIO XML: elements, attributes, units, defaults.

The table `schema.json` is made from the schemas by `tools/make_xosc_schema.py`.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence, Set
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
        deprecated: First version in which it is deprecated; `""`: none.
        unit: Unit of an attribute; `""`: none, or that of another quantity.
        default: The default of an omitted attribute.
        many: Whether there may be several such children.
    """

    type: str
    since: str
    until: str
    required: Sequence[str] = ()
    deprecated: str = ""
    unit: str = ""
    default: str | None = None
    many: bool = False

    def is_in(self, version: XmlVersion) -> bool:
        """Whether a version has it."""
        return self.since <= version <= self.until


class ElementType(NamedTuple):
    """A type of the schema, its parts in the order of the schema.

    Attributes:
        attributes: By name.
        children: By tag.
        choice: Children of which there is one at most.
        choice_since: First version with this restriction.
        needed: Versions in which there is one of these.
        text: Whether it has character data.
    """

    attributes: Mapping[str, Part]
    children: Mapping[str, Part]
    choice: Sequence[str] = ()
    choice_since: str = ""
    needed: Sequence[str] = ()
    text: bool = False

    def choice_in(self, version: XmlVersion) -> Sequence[str]:
        """Return the children of which a version allows one at most."""
        return self.choice if self.choice_since <= version else ()


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
            entry.get("choice", ()),
            entry.get("choice_since", ""),
            entry.get("needed", ()),
            entry.get("text", False),
        )
        for name, entry in data["types"].items()
    }
    return _Tables(types, data["enums"])


@cache
def types_of(tag: str) -> tuple[ElementType, ...]:
    """Return the types that elements with a tag may have: which one, their parent decides."""
    types = _tables().types
    names = {type_.children[tag].type for type_ in types.values() if tag in type_.children}
    return tuple(types[name] for name in sorted(names) if name in types)


@cache
def tags() -> Set[str]:
    """Return the tags of all elements."""
    return frozenset(tag for type_ in _tables().types.values() for tag in type_.children)


@cache
def attributes_of(tag: str) -> Mapping[str, Part]:
    """Return the attributes that elements with a tag may have, of any type."""
    return {name: part for each in types_of(tag) for name, part in each.attributes.items()}


@cache
def element_type(name: str) -> ElementType:
    """Return a type of the schema; one without parts for simple types."""
    return _tables().types.get(name, ElementType({}, {}))


def type_below(type_name: str, tag: str) -> str:
    """Return the type of a child of a type; that of the tag alone if it should not be there."""
    part = element_type(type_name).children.get(tag)
    return _type_of_tag(tag) if part is None else part.type


@cache
def _type_of_tag(tag: str) -> str:
    parts = (type_.children.get(tag) for type_ in _tables().types.values())
    return next((part.type for part in parts if part is not None), tag)


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
    return frozenset(name for name, (since, until, _) in enum.items() if since <= version <= until)


@cache
def all_literals(type_name: str) -> Mapping[str, Sequence[str]]:
    """Return the literals of an enumeration: first and last version, and since when deprecated."""
    return _tables().enums.get(type_name, {})
