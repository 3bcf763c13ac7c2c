"""The base class of all actions."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any, ClassVar, TypedDict, TypeVar

from osc2tx_rules import Rule
from osc2tx_runtime.errors import (
    OwnCode,
    UnsupportedError,
    is_own,
    name_of,
)
from osc2tx_runtime.language.method import Method
from osc2tx_runtime.language.tree.base import (
    FAILURE,
    INVALID,
    RUNNING,
    SUCCESS,
    Leaf,
    Status,
    checked,
)
from osc2tx_runtime.language.tree.duration_limits import Duration, Limits

if TYPE_CHECKING:
    from osc2tx_runtime.language.declared import BaseActor
    from osc2tx_runtime.language.modifier import Modifier
    from osc2tx_runtime.world.commands import Command
    from osc2tx_runtime.world.deviation import Deviation

__all__ = ["Action", "ActionOptions"]

T = TypeVar("T")


class ActionOptions(TypedDict, total=False):
    """Keywords that every action takes: `**options: Unpack[ActionOptions]`."""

    duration: Duration | None
    label: str | None


class Action(Leaf):
    """One action of one actor.

    Subclasses write `on_start`, `on_update`, `on_stop`. They read the world's snapshot
    (`self.context.world.state(...)`, fields of actors) and hand in commands with `self.command`,
    which act from this instant to the next, and changes of state with `self.effect`, which are
    carried out at this instant: the action does not end before they are.

    Attributes:
        method: How the class is registered: name, slots, ending.
        rules: Which arguments go together (`with`: the modifiers); the compiler knows them as well.
        accepts: Types of modifiers the action takes; others are an `UnsupportedError` at setup.
        physical: It moves the actor, and cannot let it jump (`prefer_non_physical`).
        actor: Who acts.
        modifiers: As given.
        duration: As given: seconds, or (least, most) seconds.
        slots: What it claims while it runs; `__init__` of a subclass may narrow it.
        action_name: `hero change_lane`: the name in the trace, whatever the node is called.
    """

    method: ClassVar[Method]
    rules: ClassVar[tuple[Rule, ...]] = ()
    accepts: ClassVar[tuple[type, ...]] = ()
    physical: ClassVar[bool] = False

    def __init__(
        self,
        actor: BaseActor,
        *modifiers: Modifier,
        duration: Duration | None = None,
        label: str | None = None,
    ) -> None:
        super().__init__("")
        self.actor = actor
        self.modifiers = modifiers
        self.duration = duration
        self.label = label
        self._limits = None if duration is None else Limits(self, duration)
        self._start_step = 0
        method = getattr(type(self), "method", None)
        if method is None:
            method = Method("osc_actor", type(self).__name__, (), "goal")
        self.registered: Method = method
        self.slots: tuple[str, ...] = method.slots
        self.become(method)

    def become(self, method: Method) -> None:
        """Take name, slots and ending of the method the action was made for."""
        if self.slots is self.registered.slots:  # not narrowed by a subclass
            self.slots = method.slots
        self.registered = method
        self.action_name = f"{self.actor.id} {method.name}"
        self.name = self.label or self.action_name
        self.open_ended = method.ends == "open" and self._limits is None
        self.instant = method.ends == "instant" and self._limits is None
        self._momentary = method.is_momentary and self._limits is None

    # --- what subclasses write ---

    def on_start(self) -> None:
        """Start: sample what the action needs, hand in commands. The slots are claimed."""

    def on_update(self) -> Status:
        """Return RUNNING, SUCCESS or `self.fail(reason)`; called each pass, at the start too."""
        return RUNNING

    def on_stop(self) -> None:
        """Clean up; called however the action is left, before its slots are released."""

    def takes(self, modifier: Modifier) -> bool:
        """Return whether the action carries out a modifier."""
        return isinstance(modifier, self.accepts)

    # --- what subclasses call ---

    def command(self, slot: str, command: Command) -> None:
        """Command the actor in a claimed slot until the next call or the end of the action."""
        self.context.command(self.actor.id, slot, self, command)

    def effect(self, what: str, value: object, apply: Callable[[], None]) -> None:
        """Ask for a change of state of the actor at this instant.

        Args:
            what: What changes: `speed`, `lights`.
            value: The new value; parallel actions may only want equal ones.
            apply: Carries it out at this instant.
        """
        self.context.effect((what, self.actor.id), self, value, partial(with_blame, self, apply))

    def length(self) -> int | None:
        """Return how many steps the action takes; None where only the run can tell.

        A subclass that knows overrides it; a `duration` is known anyway.
        """
        ends = self.registered.ends
        content = 0 if self.registered.is_momentary else None
        return content if self._limits is None else self._limits.length(content, ends == "open")

    @property
    def elapsed_steps(self) -> int:
        """Steps since the start of the action."""
        return self.context.step - self._start_step

    @property
    def elapsed(self) -> float:
        """Seconds since the start of the action."""
        return self.elapsed_steps * self.context.dt

    # --- how it runs ---

    def setup(self, **kwargs: Any) -> None:
        """Check the modifiers, then take the context."""
        super().setup(**kwargs)
        wrong = [m for m in self.modifiers if not with_blame(self, partial(self.takes, m))]
        if wrong:
            names = ", ".join(dict.fromkeys(f"{type(modifier).__name__}" for modifier in wrong))
            raise UnsupportedError(
                f"{self.action_name} does not take the modifier {names}", self.source or None
            )

    def initialise(self) -> None:
        """Claim the slots and start."""
        self._start_step = self.context.step
        if self._limits is not None:
            self._limits.begin()
        self.context.trace.action("start", self)
        for slot in self.slots:
            self.context.claim(self.actor.id, slot, self)
        with_blame(self, self.on_start)

    def update(self) -> Status:
        """Update, within the duration."""
        limits = self._limits
        status = self._content()
        if limits is None:
            return status
        holds = status is SUCCESS and self.fills_its_time()
        return limits.judge(RUNNING if holds else status, holds or self.registered.ends == "open")

    def fills_its_time(self) -> bool:
        """Return whether what it has reached goes on for its duration."""
        return self.registered.ends != "goal"

    def _content(self) -> Status:
        """Update; it does not end before its effects are carried out."""
        status = checked(self, with_blame(self, self.on_update))
        pending = status is SUCCESS and self.context.effects.is_pending(self)
        return RUNNING if pending else status

    def lateness(self) -> float:
        """Return that of the duration, if it ends the action."""
        late = None if self._limits is None else self._limits.late
        return super().lateness() if late is None else late

    def terminate(self, new_status: Status) -> None:
        """Clean up, release the slots and write the trace."""
        try:
            with_blame(self, self.on_stop)
        finally:
            if new_status is INVALID:
                self.context.effects.withdraw(self)
            momentary = self._momentary and new_status is SUCCESS
            for slot in self.slots:
                self.context.release(self.actor.id, slot, self, momentary)
            if new_status is FAILURE:
                self.context.trace.action("fail", self, self.feedback_message)
            else:
                reason = "stopped" if new_status is INVALID else None
                self.context.trace.action("end", self, reason, self._deviation())

    def _deviation(self) -> Deviation | None:
        """How far the actor is from where it was to be, if that was measured."""
        if not self.slots:
            return None
        return self.context.world.deviation(self.actor.id, self.slots)


def with_blame(action: Action, function: Callable[[], T]) -> T:
    """Call a function of an action; what an action of the user's own raises is a mistake of its.

    Raises:
        ScenarioError: If the class of the action does not come from this library.
    """
    if not is_own(type(action)):
        return function()
    with OwnCode(f"{action.action_name}: {name_of(type(action))} raised", action.source):
        return function()
