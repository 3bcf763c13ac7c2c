"""Attributes in which documents of one shape differ, as parameters with a value for each."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TypeAlias

from osc2tx.options import XmlVersion
from osc2tx.xosc import elements as xml
from osc2tx.xosc.comparison import Place, story_of, with_texts
from osc2tx.xosc.element import Element
from osc2tx.xosc.literals import ParameterType
from osc2tx.xosc.names import Names
from osc2tx.xosc.schema import ROOT_TYPE, element_type
from osc2tx_shared.classes import dataclass

_TYPES: Mapping[str, ParameterType] = {
    "Boolean": "boolean",
    "Double": "double",
    "Int": "int",
    "UnsignedInt": "unsignedInt",
    "UnsignedShort": "unsignedShort",
}

Texts: TypeAlias = tuple[str, ...]
"""Texts of one attribute in all rows; that of the declaration comes first."""


@dataclass(frozen=True, slots=True, eq=False)
class Column:
    """A parameter that stands for attributes.

    Attributes:
        name: Its name in the document.
        type: Of its declaration.
        texts: Its values, that of the declaration first.
        places: The attributes.
    """

    name: str
    type: ParameterType
    texts: Texts
    places: tuple[Place, ...]

    def declaration(self, version: XmlVersion) -> xml.ParameterDeclaration:
        """Return its declaration."""
        return declared(self.name, self.type, self.texts[0], version)


def columns_of(
    places: Sequence[Place], documents: Sequence[Element], known: Mapping[Texts, str], names: Names
) -> tuple[list[Column], dict[Place, str]]:
    """Return the columns for attributes of documents of one shape, and texts that never differ.

    Args:
        places: The attributes.
        documents: One for the declarations, and one for each row.
        known: Names of parameters that have such values already.
        names: Those taken.
    """
    stories = [story_of(document) for document in documents]
    by_texts: dict[Texts, list[Place]] = {}
    for place in sorted(places):
        texts = tuple(_text(story, place) for story in stories)
        by_texts.setdefault(texts, []).append(place)
    found: list[Column] = []
    same: dict[Place, str] = {}
    for texts, alike in by_texts.items():
        if len(set(texts)) == 1:
            same.update((place, texts[0]) for place in alike)
            continue
        type_, preferred = _type_and_name(stories[0], alike[0])
        name = known.get(texts) if type_ == "string" else None
        found.append(Column(name or names.new(preferred), type_, texts, tuple(alike)))
    return found, same


def _text(node: Element, place: Place) -> str:
    for index in place.path:
        node = node.children[index]
    return dict(node.attributes)[place.attribute]


def _type_and_name(story: Element, place: Place) -> tuple[ParameterType, str]:
    """Return the type of a parameter for an attribute, and what it is called after."""
    node, owner = story, ""
    part = element_type(ROOT_TYPE).children[story.tag]
    for index in place.path:
        node = node.children[index]
        part = element_type(part.type).children[node.tag]
        if node.tag != "Action":  # its event is called after the source
            owner = node.get("name") or node.get("entityRef") or owner
    attribute = element_type(part.type).attributes[place.attribute]
    return _TYPES.get(attribute.type, "string"), f"{owner or node.tag}_{place.attribute}"


def with_columns(
    document: Element, columns: Sequence[Column], same: Mapping[Place, str], version: XmlVersion
) -> Element:
    """Return a document whose attributes refer to columns, which it declares, or never differ."""
    texts = dict(same)
    texts.update((place, f"${column.name}") for column in columns for place in column.places)
    document = with_texts(document, texts)
    declarations = document.find(xml.ParameterDeclarations) or xml.ParameterDeclarations()
    known = {node.name for node in declarations.all(xml.ParameterDeclaration)}
    added = [column.declaration(version) for column in columns if column.name not in known]
    declarations = declarations.with_children(*declarations.children, *added)
    parts = [part for part in document.children if part.tag != "ParameterDeclarations"]
    return document.with_children(declarations, *parts)


def declared(
    name: str,
    type_: ParameterType,
    value: str,
    version: XmlVersion,
    limits: xml.ConstraintGroup | None = None,
) -> xml.ParameterDeclaration:
    """Return the declaration of a parameter; before 1.2 `int` is called `integer`."""
    type_ = "integer" if type_ == "int" and version < "1.2" else type_
    return xml.ParameterDeclaration(limits, name=name, parameterType=type_, value=value)
