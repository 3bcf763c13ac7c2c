"""Topics of the reference besides declarations: the language, members of the library, units."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path
from typing import Any

from osc2tx.reference.declarations import Declaration, Member, declarations
from osc2tx.stdlib import TYPES, library_file
from osc2tx.syntax import ast
from osc2tx_shared.classes import dataclass

TABLE = Path(__file__).with_name("topics.toml")
NEWEST = "2.2"


@dataclass(frozen=True, slots=True, kw_only=True)
class Topic:
    """A construct of the language, a member of a type of the library, or a unit.

    Attributes:
        kind: `directive`, `event condition`, `method`, `field`, `unit`, …
        name: Its main name in queries: `until`, `vehicle.length`, `kph`.
        names: All names by which it is found.
        signature: Its syntax.
        section: Of OpenSCENARIO DSL 2.2; empty if the text names none.
        meaning: Its description, whole sentences or a phrase.
        example: Lines that use it; empty without.
        units: Of a member whose type, or the type of its result, is physical.
        version: `2.1` or `2.2` if only this version of the standard has a member, else empty.
    """

    kind: str
    name: str
    names: tuple[str, ...]
    signature: str
    section: str = ""
    meaning: str = ""
    example: str = ""
    units: tuple[str, ...] = ()
    version: str = ""

    @property
    def is_of_language(self) -> bool:
        """Whether it is a construct of the language, and not a name of the library."""
        return "." not in self.name and self.kind != "unit"


@cache
def topics() -> tuple[Topic, ...]:
    """Return all of them: the language first, then members in the order of the library, units."""
    return (*_language(), *_members(), *_units())


def find_topics(name: str) -> list[Topic]:
    """Return the topics of a name: `until`, `space_gap`, `method vehicle.space_gap`, `kph`."""
    exact = [t for t in topics() if name in (t.name, f"{t.kind} {t.name}")]
    return exact + [topic for topic in topics() if name in topic.names and topic not in exact]


@cache
def _table() -> Mapping[str, Any]:
    return tomllib.loads(TABLE.read_text(encoding="utf-8"))


def _language() -> Iterator[Topic]:
    for row in _table()["topic"]:
        yield Topic(
            kind=row["kind"],
            name=row["names"][0],
            names=tuple(row["names"]),
            signature=row["signature"],
            section=row["section"],
            meaning=row["meaning"],
            example=row["example"].strip("\n"),
        )


def _members() -> Iterator[Topic]:
    examples: Mapping[str, str] = _table()["methods"]
    units = {each.name: each.units for each in declarations() if each.kind == "type"}
    for declaration in declarations():
        for member in declaration.members:
            name = f"{declaration.name}.{member.name}"
            yield Topic(
                kind="method" if member.kind == "method" else _kind(declaration, member),
                name=name,
                names=(member.name,),
                signature=_signature(member),
                section=member.section or declaration.section,
                meaning=member.meaning,
                example=examples.get(name, ""),
                units=units.get(member.type.removeprefix("range of "), ()),
                version=member.version,
            )


def _kind(declaration: Declaration, member: Member) -> str:
    return "enum member" if declaration.kind == "enum" else member.kind


def _signature(member: Member) -> str:
    if member.kind == "method":
        result = f" -> {member.type}" if member.type else ""
        return f"{member.name}({', '.join(member.parameters)}){result}"
    default = f" = {member.default}" if member.default else ""
    return f"{member.name}: {member.type}{default}" if member.type else member.name


def _units() -> Iterator[Topic]:
    for statement in library_file(TYPES, NEWEST).statements:
        if isinstance(statement, ast.UnitDeclaration):
            name, type_ = str(statement.name), str(statement.physical_type)
            factor = f"{statement.factor:.10g}"
            offset = f" + {statement.offset:.10g}" if statement.offset else ""
            yield Topic(
                kind="unit",
                name=name,
                names=(name,),
                signature=f"50{name}",
                section="8.14.1",
                meaning=f"A unit of `{type_}`. In SI units its numbers are multiplied by "
                f"{factor}{offset}.",
            )
