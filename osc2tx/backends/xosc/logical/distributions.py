"""The document with the values that open parameters may have (`ParameterValueDistribution`, 1.1).

Values are listed deterministically: runs can be repeated, and not every tool carries out stochastic
distributions.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import floor, prod
from typing import TypeAlias

from osc2tx.backends.xosc.logical.parameters import STEPS, OpenParameter, declared, value_text
from osc2tx.backends.xosc.logical.sampling import Domain, Row
from osc2tx.backends.xosc.names import Names
from osc2tx.options import XmlVersion
from osc2tx.xosc import elements as xml
from osc2tx.xosc.comparison import Place, story_of, with_texts
from osc2tx.xosc.element import Element
from osc2tx.xosc.literals import ParameterType
from osc2tx.xosc.schema import ROOT_TYPE, element_type
from osc2tx_shared.classes import dataclass


def needs_table(domain: Domain) -> bool:
    """Whether values have to be listed together: they depend on each other, or are too many."""
    if domain.is_joint:
        return True
    combinations = prod(len(p.choices) or STEPS + 1 for p in domain.parameters)
    return len(domain.parameters) > 1 and combinations > domain.most_rows


def document(
    header: xml.FileHeader, file: str, distributions: Sequence[xml.DeterministicPart]
) -> xml.OpenSCENARIO:
    """Return the document.

    Args:
        header: The `FileHeader`.
        file: Name of the document of the scenario.
        distributions: What it holds.
    """
    return xml.OpenSCENARIO(
        header,
        xml.ParameterValueDistribution(
            xml.ScenarioFile(filepath=file), xml.Deterministic(*distributions)
        ),
    )


def single(
    parameter: OpenParameter, domain: Domain
) -> xml.DeterministicSingleParameterDistribution:
    """Return the values of one parameter; tools combine them with those of others."""
    values: xml.DistributionSet | xml.DistributionRange
    if parameter.choices:
        values = xml.DistributionSet(
            *(xml.Element(value=value_text(choice)) for choice in parameter.choices)
        )
    else:
        low, high = parameter.limits(domain.values(parameter))
        values = xml.DistributionRange(
            xml.Range(lowerLimit=low, upperLimit=high),
            stepWidth=floor((high - low) / STEPS * 1e9) / 1e9,  # reach the end
        )
    return xml.DeterministicSingleParameterDistribution(values, parameterName=parameter.name)


def table(
    parameters: Sequence[OpenParameter], rows: Sequence[Row], columns: Sequence[Column]
) -> xml.DeterministicMultiParameterDistribution:
    """Return the values of parameters together, with those of what follows from them."""
    known = {parameter.name for parameter in parameters}
    following = [column for column in columns if column.name not in known]
    return xml.DeterministicMultiParameterDistribution(
        xml.ValueSetDistribution(
            *(
                xml.ParameterValueSet(
                    *(_assigned(p.name, value_text(row.point[p.key])) for p in parameters),
                    *(_assigned(column.name, column.texts[index]) for column in following),
                )
                for index, row in enumerate(rows, start=1)
            )
        )
    )


def _assigned(name: str, value: str) -> xml.ParameterAssignment:
    return xml.ParameterAssignment(parameterRef=name, value=value)


MOST_COLUMNS = 60
"""Attributes that follow from parameters; a table with more is no help to anyone."""

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
