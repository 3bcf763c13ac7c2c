"""Bases of declared actors and objects, as far as the language requires them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, ClassVar, NoReturn, TypeVar

from osc2tx_runtime.errors import ScenarioError


class _NotGiven:
    def __repr__(self) -> str:
        return "not_given"


not_given: Any = _NotGiven()
"""Value of a field of a user-defined type that is neither stated in its file nor given."""


class DeclaredObject:
    """An object that a scenario declares.

    Attributes:
        source: Source position of its declaration.
    """

    source: str | None = None


class BaseActor(DeclaredObject):
    """The language's view of an actor; the domain model extends it.

    Args:
        name: Role name.

    Attributes:
        kinds: Actor kinds of the DSL, most derived first.
        one_per_run: Whether invoked scenarios share the instance of the main scenario.
        id: Name of the field that holds it; given by the scenario.
    """

    kinds: ClassVar[tuple[str, ...]] = ("osc_actor",)
    one_per_run: ClassVar[bool] = False

    def __init__(self, *, name: str | None = None) -> None:
        self.id = name or ""
        self.name = name

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.id})"


ObjectT = TypeVar("ObjectT")


def as_type(value: object, kind: type[ObjectT]) -> ObjectT:
    """Return an actor or a struct as an instance of a more special type.

    Raises:
        ScenarioError: If there is none.
    """
    if isinstance(value, kind):
        return value
    if isinstance(value, BaseActor) and issubclass(kind, BaseActor):
        raise ScenarioError(f"{value.id} is no {kind.kinds[0]}", value.source)
    raise ScenarioError(f"a {type(value).__name__} is no {kind.__name__}")


MemberT = TypeVar("MemberT")


def member_at(values: Sequence[MemberT], index: int) -> MemberT:
    """Return a member of a list by its index, which counts from 0 (§7.4.2.7.2).

    Raises:
        LookupError: The index is out of range: beyond the end, or negative, as the result of
            `first_index` without a match.
    """
    if not 0 <= index < len(values):
        raise LookupError(f"a list of {len(values)} has no member with the index {index}")
    return values[index]


def undefined(method: str) -> NoReturn:
    """Represent the body of an undefined method (§7.3.7.1).

    Raises:
        ScenarioError: Always.
    """
    raise ScenarioError(
        f"method `{method}` is undefined: override it, `is only expression …`, "
        "in a type that extends this one"
    )
