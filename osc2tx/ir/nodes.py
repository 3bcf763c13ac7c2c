"""Modules and scenarios of the IR."""

from __future__ import annotations

from osc2tx.diagnostics import Span
from osc2tx.ir.behaviors import Behavior, ModifierCall
from osc2tx.ir.coverage import Coverage
from osc2tx.ir.declarations import Constraint, Declaration, Method
from osc2tx.ir.user_types import UserAction, UserEnum, UserModifier, UserType, UserUnit
from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Placement:
    """The start of an actor, or the roads of a map.

    Attributes:
        actor: The actor, or the map.
        modifiers: The modifiers at the start.
        span: Their span.
        comments: The comment lines above it.
        of_map: It is a statement about roads.
        is_throughout: All of it applies later as well, so it is not needed in a scenario that is
            invoked during a run.
        is_implied: It is not stated, but required by the first action of the actor. It is void if
            another placement states the start, or if the actor is on the map already.
        is_later: The action does not begin with the scenario.
    """

    actor: str
    modifiers: tuple[ModifierCall, ...]
    span: Span
    comments: tuple[str, ...] = ()
    of_map: bool = False
    is_throughout: bool = False
    is_implied: bool = False
    is_later: bool = False


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Override:
    """`override(overridden, by, mode)` (§7.3.12.1.1); the first two are labels."""

    span: Span
    overridden: str
    by: str
    mode: str
    comments: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class AbstractScenario:
    """A scenario without a `do`, for others to inherit; it has all that it inherits itself.

    Attributes:
        name: As in the source.
        comments: The comment lines above it.
        declarations: Cast, values and events in source order, those of its bases first.
        constraints: The constraints between the values.
        methods: Its methods, in source order.
        placements: Initial placement, in source order.
        base: Key of the scenario that it inherits from; `None` if it does not, or has to be
            declared as a whole.
        end_comments: Comment lines below its last member.
        overrides: Labelled members that end others.
        coverage: The coverage items.
        is_imported: It is included because a scenario of the file invokes or inherits it.
        is_action: It is an action with a `do`.
    """

    name: str
    span: Span
    comments: tuple[str, ...]
    declarations: tuple[Declaration, ...]
    methods: tuple[Method, ...]
    placements: tuple[Placement, ...]
    base: str | None = None
    end_comments: tuple[str, ...] = ()
    overrides: tuple[Override, ...] = ()
    coverage: tuple[Coverage, ...] = ()
    constraints: tuple[Constraint, ...] = ()
    is_imported: bool = False
    is_action: bool = False

    @property
    def key(self) -> str:
        """The unique key of the scenario among others of the same name."""
        return f"{self.span.source.name}:{self.span.start}"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Scenario(AbstractScenario):
    """A scenario with a behavior, ready to be written down by a backend.

    Attributes:
        body: Its `do` tree.
        is_invoked: A scenario of the module invokes it.
    """

    body: Behavior
    is_invoked: bool = False

    @property
    def is_runnable(self) -> bool:
        """Whether it can run by itself: no other one invokes it, and it is in the file."""
        return not (self.is_invoked or self.is_imported or self.is_action)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Module:
    """All scenarios of one source file, with the settings that give them their meaning.

    Attributes:
        bases: Scenarios without a `do`: those of the file, and those of imported files that its
            scenarios inherit.
        types: Types of their objects that are not the library's, bases first, then the others of
            the file.
        actions: Actions they invoke that are not the library's, in order of use, then the others
            of the file.
        enums: Enums of the file, and those of imported files that it mentions.
        modifiers: Modifiers that are functions of their parameters: those of the file, and those
            of imported files that it applies.
        units: Units of its files that have comments.
        comments: The comment lines at the head of the file.
    """

    source: str
    standard: str
    dialect: str
    one_of: str
    scenarios: tuple[Scenario, ...]
    bases: tuple[AbstractScenario, ...] = ()
    comments: tuple[str, ...] = ()
    types: tuple[UserType, ...] = ()
    actions: tuple[UserAction, ...] = ()
    enums: tuple[UserEnum, ...] = ()
    modifiers: tuple[UserModifier, ...] = ()
    units: tuple[UserUnit, ...] = ()

    @property
    def own_scenarios(self) -> list[Scenario]:
        """Return the scenarios of the file itself, without imported ones, and without actions."""
        return [each for each in self.scenarios if not each.is_imported and not each.is_action]
