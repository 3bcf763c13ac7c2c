"""Types, actions and modifiers that the files of a program declare."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from osc2tx.diagnostics import Span
from osc2tx.ir.behaviors import ModifierCall
from osc2tx.ir.declarations import Method, MethodParameter
from osc2tx.ir.expressions import Expression
from osc2tx.ir.values import ValueType, qualified
from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class UserField:
    """A field of a type that the scenario's files declare.

    Attributes:
        name: Its name.
        type: Its type.
        default: Its default value; without one it must be given.
        is_optional: An object may do without: its own file never mentions it.
    """

    name: str
    span: Span
    type: ValueType
    default: Expression | None
    comments: tuple[str, ...] = ()
    is_optional: bool = False


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class UserType:
    """An actor or struct that the scenario's files declare, or one of the library that they extend.

    Attributes:
        name: As in the source; that of a combination names its types, `tall_and_long`.
        bases: The type it inherits from; several if it is the combination of conditional types
            that one object is of.
        is_actor: Whether it is an actor.
        fields: Those of its own that have values.
        unused: Those of its own that no file mentions.
        methods: Its own methods, in source order.
        keeps: Its constraints as the source has them, each with the comment lines above it, and
            the comment lines below the type; every object states the constraints that it needs.
        is_of_library: Whether it is a type of the library, with the members that `extend` adds to
            it or to one of its bases; its bases then are the extended ones.
    """

    name: str
    span: Span
    bases: tuple[str, ...]
    is_actor: bool
    fields: tuple[UserField, ...]
    comments: tuple[str, ...] = ()
    unused: tuple[UserField, ...] = ()
    methods: tuple[Method, ...] = ()
    keeps: tuple[str, ...] = ()
    is_of_library: bool = False

    @property
    def all_fields(self) -> tuple[UserField, ...]:
        """Its own fields, in source order."""
        return tuple(sorted((*self.fields, *self.unused), key=lambda field: field.span.start))

    def has(self, name: str) -> bool:
        """Whether it has a field or method of that name itself."""
        methods = (f"{self.name}.{name}" == each.name for each in self.methods)
        return any(each.name == name for each in self.all_fields) or any(methods)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class UserEnum:
    """An enum that the scenario's files declare, with all its members.

    Attributes:
        told: Comment lines of its members, by their names, of those that have some.
    """

    name: str
    span: Span
    members: tuple[str, ...]
    comments: tuple[str, ...] = ()
    told: tuple[tuple[str, tuple[str, ...]], ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class UserUnit:
    """A unit that the scenario's files declare and use."""

    name: str
    span: Span
    comments: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ActionParameter:
    """A parameter of a user's own action; one with a default has a value in every invocation.

    Attributes:
        default: The default, if it is the same for all invocations.
    """

    name: str
    type: ValueType
    has_default: bool
    default: Expression | None = None
    comments: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class UserAction:
    """An action that the scenario's files declare, and a package of the user carries out.

    Attributes:
        name: Its name.
        owner: The actor type that it belongs to, if any.
        parameters: Its own and those of its bases.
        takes_modifiers: Whether modifiers of movement may be applied to it.
        base: The action of the library that it inherits, and is where no package carries it out.
    """

    name: str
    owner: str | None
    span: Span
    parameters: tuple[ActionParameter, ...]
    takes_modifiers: bool
    base: str | None = None
    comments: tuple[str, ...] = ()

    @property
    def qualified_name(self) -> str:
        """`vehicle.creep`; the name alone if it belongs to no actor."""
        return qualified(self.owner, self.name)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class UserModifier:
    """A modifier that the scenario's files declare, as a function of its parameters.

    Attributes:
        name: Its name.
        key: Distinguishes it from others of the same name.
        parameters: Its parameters, in source order.
        calls: The modifiers of its body, in terms of the parameters.
        keeps: Its constraints as the source has them; every application is checked separately.
    """

    name: str
    key: str
    span: Span
    parameters: tuple[MethodParameter, ...]
    calls: tuple[ModifierCall, ...]
    comments: tuple[str, ...] = ()
    keeps: tuple[str, ...] = ()


def lineage(type_: str, own: Mapping[str, UserType]) -> tuple[str, ...]:
    """Return a type and its bases, up to the first ones of the library, most derived first.

    Args:
        type_: Name of the type.
        own: The types that the scenario's files declare.
    """
    if type_ not in own:
        return (type_,)
    return (type_, *merged([lineage(base, own) for base in own[type_].bases]))


def lineages(own: Iterable[UserType]) -> dict[str, tuple[str, ...]]:
    """Return the lineages of types that are declared bases first: each made from those before."""
    found: dict[str, tuple[str, ...]] = {}
    for each in own:
        found[each.name] = (each.name, *merged([found.get(b, (b,)) for b in each.bases]))
    return found


def merged(several: Sequence[tuple[str, ...]]) -> tuple[str, ...]:
    """Return several lineages as one: common types follow those that only some of them have."""
    if len(several) == 1:
        return several[0]
    backwards = (name for each in reversed(several) for name in reversed(each))
    return tuple(reversed(dict.fromkeys(backwards)))
