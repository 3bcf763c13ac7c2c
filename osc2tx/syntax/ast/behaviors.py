"""Behavior: `do`, `on`, compositions, invocations and directives (§7.3.13)."""

from __future__ import annotations

from enum import Enum
from typing import TypeAlias

from osc2tx.syntax.ast.base import Name, Statement
from osc2tx.syntax.ast.expressions import Argument, Expression
from osc2tx.syntax.ast.members import (
    EventSpecification,
    KeepConstraint,
    ModifierApplication,
    RemoveDefault,
)
from osc2tx_shared.classes import dataclass


class CompositionOperator(Enum):
    """The three composition operators."""

    SERIAL = "serial"
    PARALLEL = "parallel"
    ONE_OF = "one_of"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class UntilDirective(Statement):
    """`until specification`, in a `with` block."""

    event: EventSpecification


WithMember: TypeAlias = KeepConstraint | RemoveDefault | ModifierApplication | UntilDirective


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class DoMember(Statement):
    """The common base of the members of a `do` tree.

    Attributes:
        label: The name before the colon.
    """

    label: Name | None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Composition(DoMember):
    """`serial(arguments): members`, with an optional `with` block.

    Attributes:
        end_comments: Comment lines below the last member, still inside the block.
    """

    operator: CompositionOperator
    arguments: tuple[Argument, ...]
    members: tuple[BehaviorMember, ...]
    with_members: tuple[WithMember, ...]
    end_comments: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Invocation(DoMember):
    """`actor.behavior(arguments)`, with an optional `with` block."""

    actor: Expression | None
    behavior: Name
    arguments: tuple[Argument, ...]
    with_members: tuple[WithMember, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class WaitDirective(DoMember):
    """`wait specification`."""

    event: EventSpecification


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class EmitDirective(DoMember):
    """`emit event(arguments)`."""

    event: Name
    arguments: tuple[Argument, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CallDirective(DoMember):
    """`call object.method(arguments)`; `method` is a `NameExpression` or `MemberAccess`."""

    method: Expression
    arguments: tuple[Argument, ...]


BehaviorMember: TypeAlias = Composition | Invocation | WaitDirective | EmitDirective | CallDirective


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class DoDirective(Statement):
    """`do member`."""

    member: BehaviorMember


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class OnDirective(Statement):
    """`on specification:` with calls and emits."""

    event: EventSpecification
    members: tuple[CallDirective | EmitDirective, ...]


BehaviorSpecification: TypeAlias = DoDirective | OnDirective
