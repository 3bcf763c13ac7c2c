"""Symbols for the members of a type: fields, events, methods and labels."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypedDict

from osc2tx.diagnostics import Span
from osc2tx.semantics.scope import Context
from osc2tx.semantics.symbols import (
    EventSymbol,
    FieldSymbol,
    LabelSymbol,
    Member,
    MemberOwner,
    MethodSymbol,
    ParameterSymbol,
)
from osc2tx.syntax import ast


class Basics(TypedDict):
    """The arguments that all symbols have."""

    name: str
    namespace: str
    span: Span
    origin: str


def _basics(name: ast.Name, context: Context, origin: str) -> Basics:
    return Basics(
        name=name.text,
        namespace=name.namespace or context.namespace,
        span=name.span,
        origin=origin,
    )


def make_field(
    basics: Basics,
    owner: MemberOwner | None,
    node: ast.ParameterDeclaration | ast.VariableDeclaration,
) -> FieldSymbol:
    """Make the symbol of one name of a field declaration."""
    constraints = node.constraints if isinstance(node, ast.ParameterDeclaration) else ()
    return FieldSymbol(
        **basics,
        owner=owner,
        is_variable=isinstance(node, ast.VariableDeclaration),
        default=node.default,
        node=node,
        constraints=tuple(c for c in constraints if isinstance(c, ast.KeepConstraint)),
    )


def members_of(
    statement: ast.Statement, owner: MemberOwner, context: Context, origin: str
) -> Iterator[Member]:
    """Yield the members that a statement in the body of a type defines."""
    match statement:
        case ast.ParameterDeclaration() | ast.VariableDeclaration():
            for name in statement.names:
                yield make_field(_basics(name, context, origin), owner, statement)
        case ast.EventDeclaration():
            yield EventSymbol(
                **_basics(statement.name, context, origin),
                owner=owner,
                parameters=_parameters(statement.parameters, context, origin),
                node=statement,
            )
        case ast.MethodDeclaration():
            yield MethodSymbol(
                **_basics(statement.name, context, origin),
                owner=owner,
                parameters=_parameters(statement.parameters, context, origin),
                node=statement,
            )
        case ast.DoDirective():
            yield from _labels(statement.member, owner, context, origin)
        case _:
            return


def _parameters(
    specifications: tuple[ast.ParameterSpecification, ...], context: Context, origin: str
) -> tuple[ParameterSymbol, ...]:
    return tuple(
        ParameterSymbol(**_basics(s.name, context, origin), default=s.default)
        for s in specifications
    )


def _labels(
    member: ast.BehaviorMember, owner: MemberOwner, context: Context, origin: str
) -> Iterator[LabelSymbol]:
    if member.label is not None:
        yield LabelSymbol(**_basics(member.label, context, origin), owner=owner, node=member)
    if isinstance(member, ast.Composition):
        for child in member.members:
            yield from _labels(child, owner, context, origin)
