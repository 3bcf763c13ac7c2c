"""The document with the values that open parameters may have (`ParameterValueDistribution`, 1.1).

Values are listed deterministically: runs can be repeated, and not every tool carries out stochastic
distributions.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import floor, prod
from typing import TypeAlias

from osc2tx.backends.xosc.logical.comparison import SAID_BESIDE, Place, story_of
from osc2tx.backends.xosc.logical.parameters import STEPS, OpenParameter, declared, value_text
from osc2tx.backends.xosc.logical.sampling import Domain, Row
from osc2tx.backends.xosc.xml.names import Names
from osc2tx.backends.xosc.xml.schema import ROOT_TYPE, element_type
from osc2tx.backends.xosc.xml.tree import Element, element
from osc2tx.options import XmlVersion
from osc2tx_shared.classes import dataclass, replace


def needs_table(domain: Domain) -> bool:
    """Whether values have to be listed together: they depend on each other, or are too many."""
    if domain.is_joint:
        return True
    combinations = prod(len(p.choices) or STEPS + 1 for p in domain.parameters)
    return len(domain.parameters) > 1 and combinations > domain.most_rows


def document(header: Element, file: str, distributions: Sequence[Element]) -> Element:
    """Return the document.

    Args:
        header: The `FileHeader`.
        file: Name of the document of the scenario.
        distributions: What it holds.
    """
    return element(
        "OpenSCENARIO",
        header,
        element(
            "ParameterValueDistribution",
            element("ScenarioFile", filepath=file),
            element("Deterministic", *distributions),
        ),
    )


def single(parameter: OpenParameter, domain: Domain) -> Element:
    """Return the values of one parameter; tools combine them with those of others."""
    if parameter.choices:
        values = element(
            "DistributionSet",
            *(element("Element", value=value_text(choice)) for choice in parameter.choices),
        )
    else:
        low, high = parameter.limits(domain.values(parameter))
        values = element(
            "DistributionRange",
            element("Range", lowerLimit=low, upperLimit=high),
            stepWidth=floor((high - low) / STEPS * 1e9) / 1e9,  # reach the end
        )
    return element("DeterministicSingleParameterDistribution", values, parameterName=parameter.name)


def table(
    parameters: Sequence[OpenParameter], rows: Sequence[Row], columns: Sequence[Column]
) -> Element:
    """Return the values of parameters together, with those of what follows from them."""
    known = {parameter.name for parameter in parameters}
    following = [column for column in columns if column.name not in known]
    return element(
        "DeterministicMultiParameterDistribution",
        element(
            "ValueSetDistribution",
            *(
                element(
                    "ParameterValueSet",
                    *(_assigned(p.name, value_text(row.point[p.key])) for p in parameters),
                    *(_assigned(column.name, column.texts[index]) for column in following),
                )
                for index, row in enumerate(rows, start=1)
            ),
        ),
    )


def _assigned(name: str, value: str) -> Element:
    return element("ParameterAssignment", parameterRef=name, value=value)


MOST_COLUMNS = 60
"""Attributes that follow from parameters; a table with more is no help to anyone."""

_TYPES = {
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
    type: str
    texts: Texts
    places: tuple[Place, ...]

    def declaration(self, version: XmlVersion) -> Element:
        """Return its declaration."""
        return declared(self.name, self.type, self.texts[0], version)


def columns_of(
    places: Sequence[Place], documents: Sequence[Element], known: Mapping[Texts, str], names: Names
) -> list[Column]:
    """Return the columns for attributes of documents of one shape.

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
    found = []
    for texts, alike in by_texts.items():
        type_, wish = _type_and_name(stories[0], alike[0])
        name = known.get(texts) if type_ == "string" else None
        found.append(Column(name or names.new(wish), type_, texts, tuple(alike)))
    return found


def _text(node: Element, place: Place) -> str:
    for index in place.path:
        node = node.children[index]
    return dict(node.attributes)[place.attribute]


def _type_and_name(story: Element, place: Place) -> tuple[str, str]:
    """Return the type of a parameter for an attribute, and what it is called after."""
    node, owner = story, ""
    part = element_type(ROOT_TYPE).children[story.name]
    for index in place.path:
        node = node.children[index]
        part = element_type(part.type).children[node.name]
        if node.name != "Action":  # its event is called after the source
            owner = node.get("name") or node.get("entityRef") or owner
    attribute = element_type(part.type).attributes[place.attribute]
    return _TYPES.get(attribute.type, "string"), f"{owner or node.name}_{place.attribute}"


def with_columns(document: Element, columns: Sequence[Column], version: XmlVersion) -> Element:
    """Return a document whose attributes refer to columns, which it declares."""
    names = {place: column.name for column in columns for place in column.places}
    story = _referring(story_of(document), names, ())
    beside = [part for part in document.children if part.name in SAID_BESIDE]
    declared_ = [
        n for part in beside if part.name == "ParameterDeclarations" for n in part.children
    ]
    known = {node.get("name") for node in declared_}
    added = [column.declaration(version) for column in columns if column.name not in known]
    parts = [part for part in beside if part.name != "ParameterDeclarations"]
    parts.append(element("ParameterDeclarations", *declared_, *added))
    return replace(document, children=(*parts, *story.children))


def _referring(node: Element, names: Mapping[Place, str], path: tuple[int, ...]) -> Element:
    attributes = tuple(
        (key, f"${names[Place(path, key)]}" if Place(path, key) in names else text)
        for key, text in node.attributes
    )
    children = tuple(
        _referring(child, names, (*path, index)) for index, child in enumerate(node.children)
    )
    return replace(node, attributes=attributes, children=children)
