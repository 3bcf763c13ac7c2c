"""Bases of declared actors and objects, as far as the language needs to know them."""

from __future__ import annotations

from typing import Any, ClassVar

__all__ = ["BaseActor", "DeclaredObject", "not_given"]


class _NotGiven:
    def __repr__(self) -> str:
        return "not_given"


not_given: Any = _NotGiven()
"""What a field of a user's own type is that its file never speaks of, and that nobody gives."""


class DeclaredObject:
    """Something that a scenario declares.

    Attributes:
        source: Where it is declared.
    """

    source: str | None = None


class BaseActor(DeclaredObject):
    """What the language knows of an actor; the domain model says what it is.

    Args:
        name: Role name.

    Attributes:
        kinds: Actor kinds of the DSL, most derived first.
        one_per_run: Scenarios that are invoked share the one of the scenario that runs.
        id: Name of the field that holds it; given by the scenario.
    """

    kinds: ClassVar[tuple[str, ...]] = ("osc_actor",)
    one_per_run: ClassVar[bool] = False

    def __init__(self, *, name: str | None = None) -> None:
        self.id = name or ""
        self.name = name

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.id})"
