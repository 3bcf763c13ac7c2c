"""The declarations of the library with their meanings."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from functools import cache, partial

from osc2tx.stdlib import LIBRARY, library_file, member_meanings
from osc2tx.syntax import ast
from osc2tx.syntax.si_notation import si_notation
from osc2tx_shared.classes import dataclass

OLD, NEW = "2.1", "2.2"
_SECTION = re.compile(r"§([\d.]*\d)\s*")


@dataclass(frozen=True, slots=True, kw_only=True)
class Member:
    """A field, parameter, method or enum member.

    Attributes:
        kind: `field`, `variable`, `parameter`, `method` or `value`.
        name: Its name.
        type: Its type; of a method that of its result, empty for one without.
        parameters: Of a method, as declared.
        default: As declared; empty without one.
        section: Of the standard, where it has one of its own.
        meaning: Its description.
        version: `2.1` or `2.2` if only this version of the standard has it, else empty.
    """

    kind: str
    name: str
    type: str = ""
    parameters: tuple[str, ...] = ()
    default: str = ""
    section: str = ""
    meaning: str = ""
    version: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Declaration:
    """A declaration of the library.

    Attributes:
        kind: `actor`, `action`, `modifier`, `struct`, `enum` or `type`.
        name: With the actor it belongs to: `vehicle.drive`.
        base: Its base type; of a modifier, its behavior. Empty without one.
        section: Of OpenSCENARIO DSL 2.2; empty if the text names none.
        meaning: Its description.
        members: In the order of positional arguments.
        units: Of a physical type, from the library.
    """

    kind: str
    name: str
    base: str = ""
    section: str = ""
    meaning: str = ""
    members: tuple[Member, ...] = ()
    units: tuple[str, ...] = ()


@cache
def declarations() -> tuple[Declaration, ...]:
    """Return all of them, in the order of the library; members of both versions."""
    old = {(each.kind, each.name): each for each in _of_version(OLD)}
    return tuple(_both(each, old.get((each.kind, each.name))) for each in _of_version(NEW))


def _both(new: Declaration, old: Declaration | None) -> Declaration:
    """Join the members of both versions; a member of only one version is marked."""
    if old is None or old == new:
        return new
    names = {(each.name, each.type) for each in old.members}
    kept = {(each.name, each.type) for each in new.members}
    members = [
        each if (each.name, each.type) in names else _only(each, NEW) for each in new.members
    ]
    members += [_only(each, OLD) for each in old.members if (each.name, each.type) not in kept]
    return Declaration(
        kind=new.kind,
        name=new.name,
        base=new.base,
        section=new.section,
        meaning=new.meaning,
        members=tuple(members),
        units=new.units,
    )


def _only(member: Member, version: str) -> Member:
    return Member(
        kind=member.kind,
        name=member.name,
        type=member.type,
        parameters=member.parameters,
        default=member.default,
        section=member.section,
        meaning=member.meaning,
        version=version,
    )


def _of_version(standard: str) -> Iterator[Declaration]:
    for name in LIBRARY:
        statements = library_file(name, standard).statements
        units: dict[str, list[str]] = {}
        for statement in statements:
            if isinstance(statement, ast.UnitDeclaration):
                units.setdefault(str(statement.physical_type), []).append(str(statement.name))
        for statement in statements:
            found = _declaration(statement, units)
            if found is not None:
                yield found


def _declaration(
    statement: ast.FileStatement, units: Mapping[str, list[str]]
) -> Declaration | None:
    match statement:
        case ast.EnumDeclaration():
            means = partial(member_meanings().of_value, str(statement.name))
            members = tuple(
                Member(
                    kind="value",
                    name=str(each.name),
                    default=_source(each.value),
                    meaning=means(str(each.name)),
                )
                for each in statement.members
            )
            return _made("enum", statement, "", members)
        case ast.StructDeclaration():
            return _made("struct", statement, statement.base, _members(statement, "field"))
        case ast.ActorDeclaration():
            return _made("actor", statement, statement.base, _members(statement, "field"))
        case ast.ActionDeclaration():
            return _made("action", statement, statement.base, _members(statement, "parameter"))
        case ast.ModifierDeclaration():
            return _made(
                "modifier", statement, statement.behavior, _members(statement, "parameter")
            )
        case ast.PhysicalTypeDeclaration():
            unit = si_notation((each.base, each.exponent) for each in statement.exponents)
            return Declaration(
                kind="type",
                name=str(statement.name),
                section="8.14.1",
                meaning=f"A physical type; in SI units {unit}.",
                units=tuple(units.get(str(statement.name), ())),
            )
        case _:
            return None


_Named = (
    ast.EnumDeclaration
    | ast.StructDeclaration
    | ast.ActorDeclaration
    | ast.ActionDeclaration
    | ast.ModifierDeclaration
)


def _made(kind: str, statement: _Named, base: object, members: tuple[Member, ...]) -> Declaration:
    section, meaning = _told(statement.comments)
    name = str(statement.name)
    return Declaration(
        kind=kind,
        name=name,
        base="" if base is None else str(base),
        section=section,
        meaning=meaning or member_meanings().of_declaration(name),
        members=members,
    )


def _members(owner: ast.Statement, kind: str) -> tuple[Member, ...]:
    name = str(getattr(owner, "name", ""))
    found: list[Member] = []
    for each in getattr(owner, "members", ()):
        section, above = _told(each.comments)
        told = above or (_told((each.trailing_comment or "",))[1])
        if section == "" and each.trailing_comment:
            section = _told((each.trailing_comment,))[0]
        match each:
            case ast.ParameterDeclaration() | ast.VariableDeclaration():
                is_variable = isinstance(each, ast.VariableDeclaration)
                found += [
                    Member(
                        kind="variable" if is_variable else kind,
                        name=str(item),
                        type=_source(each.type),
                        default=_source(each.default),
                        section=section,
                        meaning=told or member_meanings().of(name, str(item)),
                    )
                    for item in each.names
                ]
            case ast.MethodDeclaration():
                found.append(
                    Member(
                        kind="method",
                        name=str(each.name),
                        type=_source(each.result),
                        parameters=tuple(_source(item) for item in each.parameters),
                        section=section,
                        meaning=told or member_meanings().of(name, str(each.name)),
                    )
                )
    return tuple(found)


def _told(comments: tuple[str, ...]) -> tuple[str, str]:
    """The section and the meaning that the comments right above a declaration state."""
    last: list[str] = []
    for line in comments:
        if not line or line.startswith(("====", "----")):
            last.clear()
        elif not line.startswith("!"):
            last.append(line)
    text = " ".join(last)
    section = _SECTION.match(text)
    words = text if section is None else text[section.end() :]
    return section[1] if section else "", words.partition("#!")[0].strip()


def _source(node: object) -> str:
    """The text of a node as it is declared."""
    if node is None:
        return ""
    if isinstance(node, ast.Node):
        return node.span.source.text[node.span.start : node.span.end]
    return str(node)
