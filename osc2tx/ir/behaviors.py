"""Behavior of the IR: the tree of `do`, and its triggers."""

from __future__ import annotations

from enum import Enum
from typing import TypeAlias

from osc2tx.diagnostics import Span
from osc2tx.ir.expressions import Argument, Expression, FieldRef
from osc2tx.ir.values import qualified
from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class EventRef:
    """A declared event, by name."""

    span: Span
    name: str


class Moment(Enum):
    """The life-cycle events of a behavior (§7.3.13)."""

    START = "start"
    END = "end"
    FAIL = "fail"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LabelEvent:
    """A life-cycle event of a labelled member, `@cut_in.end`."""

    span: Span
    label: str
    moment: Moment


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class InnerEvent:
    """An event of an invoked scenario, `@approach.near`."""

    span: Span
    label: str
    name: str


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Level:
    """True as long as the expression is."""

    span: Span
    expression: Expression


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Edge:
    """`rise` or `fall` of an expression."""

    span: Span
    rising: bool
    expression: Expression


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Elapsed:
    """True once the time has passed."""

    span: Span
    duration: Expression


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Every:
    """True at each multiple of the period."""

    span: Span
    period: Expression
    offset: Expression | None


Condition: TypeAlias = Level | Edge | Elapsed | Every


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Trigger:
    """An event specification: an event, a condition, or an event with a condition."""

    span: Span
    event: EventRef | LabelEvent | InnerEvent | None
    condition: Condition | None
    comments: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BehaviorBase:
    """The common base of the members of the tree.

    Attributes:
        span: The statement in the source.
        label: Its label, if it has one.
        name: Its name for readers; not unique.
        comments: Comment lines above it in the source.
    """

    span: Span
    label: str | None
    name: str
    comments: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CompositionBase(BehaviorBase):
    """The common base of the compositions.

    Attributes:
        members: In source order.
        duration: Time or range of time.
        until: Any of these ends it.
        is_phase: Labelled, or directly below a `do`: a separate part of the output.
        end_comments: Comment lines below the last member.
    """

    members: tuple[Behavior, ...]
    is_phase: bool = False
    duration: Expression | None = None
    until: tuple[Trigger, ...] = ()
    end_comments: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Serial(CompositionBase):
    """One member after the other."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Parallel(CompositionBase):
    """Members together; `overlap` (§7.3.13.2) only if written, offsets as times or ranges."""

    overlap: str | None = None
    start_to_start: Expression | None = None
    end_to_end: Expression | None = None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class OneOf(CompositionBase):
    """Alternatives; the policy belongs to the module."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Application:
    """An application of a user-defined modifier, which modifiers of the library replace.

    Attributes:
        key: Key of the modifier, see `UserModifier.key`.
        arguments: The values of its parameters, where they have one.
    """

    span: Span
    key: str
    arguments: tuple[Argument, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ModifierCall:
    """A modifier of the library with its arguments.

    Attributes:
        at: When it applies (`start`, `end`, `all`), taken out of the arguments.
        applied: The applications whose bodies contain it, the outermost first.
    """

    span: Span
    name: str
    arguments: tuple[Argument, ...]
    at: str = "all"
    comments: tuple[str, ...] = ()
    applied: tuple[Application, ...] = ()

    def application(self, depth: int) -> Application | None:
        """Return the application around it with this number of applications around itself."""
        return self.applied[depth] if depth < len(self.applied) else None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Invoke(BehaviorBase):
    """An action.

    Attributes:
        actor: The actor; none for an action without one.
        owner: The actor type that the action belongs to, if it has an actor.
        action: Its name.
        arguments: In source order, without `duration`.
        modifiers: Those that act during the invocation.
        duration: Time or range of time.
        until: Any of these ends it.
        is_own: The scenario's own files declare it, and a package of the user carries it out.
    """

    actor: Expression | None
    owner: str | None
    action: str
    arguments: tuple[Argument, ...]
    modifiers: tuple[ModifierCall, ...]
    duration: Expression | None = None
    until: tuple[Trigger, ...] = ()
    is_own: bool = False

    @property
    def qualified_name(self) -> str:
        """`vehicle.drive`; the name alone if there is no actor."""
        return qualified(self.owner, self.action)

    @property
    def actor_name(self) -> str | None:
        """Name of the actor, if that is a field of the scenario."""
        return self.actor.name if isinstance(self.actor, FieldRef) else None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SpecialScenario:
    """A conditional scenario that runs instead of its base if the arguments have these values.

    Attributes:
        scenario: Its name.
        key: As `Scenario.key`.
        values: The arguments that it depends on, each with the constant that it must be.
    """

    scenario: str
    key: str
    values: tuple[Argument, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class InvokeScenario(BehaviorBase):
    """Another scenario as a part of this one.

    Attributes:
        scenario: Its name.
        key: Distinguishes it from others of the same name, see `Scenario.key`.
        specials: Scenarios that may run instead, decided when it is invoked: the first that
            applies, so the most derived ones come first.
        actor: The value of its `actor`.
        arguments: Its parameters and cast, in source order, without `duration`.
        duration: Time or range of time.
        until: Any of these ends it.
        times: Values of times that it would draw, and those that it invokes, by path.
    """

    scenario: str
    key: str
    actor: Expression | None
    arguments: tuple[Argument, ...]
    specials: tuple[SpecialScenario, ...] = ()
    duration: Expression | None = None
    until: tuple[Trigger, ...] = ()
    times: tuple[Argument, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Wait(BehaviorBase):
    """Blocks until the trigger."""

    trigger: Trigger


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Emit(BehaviorBase):
    """Emits an event."""

    event: EventRef
    arguments: tuple[Argument, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Finish(BehaviorBase):
    """Ends the scenario: `emit end`, or `emit fail`."""

    succeeds: bool


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Call(BehaviorBase):
    """Calls a method, in no time."""

    call: Expression


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class On(BehaviorBase):
    """Reacts at each occurrence of the trigger, while the members beside it run."""

    trigger: Trigger
    reactions: tuple[Emit | Finish | Call, ...]


Composition: TypeAlias = Serial | Parallel | OneOf
Directive: TypeAlias = Wait | Emit | Finish | Call | On
Behavior: TypeAlias = Serial | Parallel | OneOf | Invoke | InvokeScenario | Directive
