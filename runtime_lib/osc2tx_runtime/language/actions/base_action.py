"""Common base of actions of actors and global actions: start, duration and end."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar

from osc2tx_runtime.errors import OwnCode, ScenarioError, is_own, name_of
from osc2tx_runtime.language.actions.method import Method
from osc2tx_runtime.language.tree.base import (
    FAILURE,
    INVALID,
    RUNNING,
    SUCCESS,
    Leaf,
    Status,
    checked,
)
from osc2tx_runtime.language.tree.duration_limits import Duration, DurationLimits
from osc2tx_shared.rules import Rule

if TYPE_CHECKING:
    from osc2tx_runtime.world.measuring.deviation import Deviation

T = TypeVar("T")


class BaseAction(Leaf):
    """One action.

    Subclasses write `on_start`, `on_update`, `on_stop`. They read the world's snapshot
    (`self.context.world.state(...)`, fields of actors) and request changes of state with
    `self.effect`, which are applied at this instant, before the action ends.

    Attributes:
        method: Its registration: name, slots, ending.
        rules: Rules of the arguments (`with`: the modifiers); the compiler applies them as well.
        duration: Seconds, or (least, most) seconds, as given.
        action_name: `hero change_lane`: the name in the trace, independent of that of the node.
        failure_source: Source position of the condition that fails it, if any.
    """

    method: ClassVar[Method]
    rules: ClassVar[tuple[Rule, ...]] = ()

    def __init__(self, *, duration: Duration | None = None, label: str | None = None) -> None:
        super().__init__("")
        self.duration = duration
        self.label = label
        self._limits = None if duration is None else DurationLimits(self, duration)
        self._start_step = 0
        self.failure_source = ""
        self._is_ours = not is_own(type(self))
        self.registered = registered_as(type(self))
        self.become(self.registered)

    @property
    def actor_id(self) -> str | None:
        """The actor; None for an action without one."""
        return None

    def become(self, method: Method) -> None:
        """Take name and ending of the method of the action."""
        self.registered = method
        self.action_name = full_name(self.actor_id, method.name)
        self.name = self.label or self.action_name
        self.open_ended = method.ends == "open" and self._limits is None
        self.instant = method.ends == "instant" and self._limits is None
        self._momentary = method.is_momentary and self._limits is None

    # --- written by subclasses ---

    def on_start(self) -> None:
        """Start: sample the inputs of the action, issue commands. The slots are claimed."""

    def on_update(self) -> Status:
        """Return RUNNING, SUCCESS or `self.fail(reason)`.

        Called in each pass, including the first.
        """
        return RUNNING

    def on_stop(self) -> None:
        """Clean up; called whenever the action is left, before its slots are released."""

    # --- called by subclasses ---

    def effect(self, what: str, value: object, apply: Callable[[], None]) -> None:
        """Request a change of state at this instant.

        Args:
            what: The quantity: `speed`, `lights`.
            value: The new value; parallel actions may only request equal values.
            apply: Applies it at this instant.
        """
        whose = () if self.actor_id is None else (self.actor_id,)
        self.context.effect((what, *whose), self, value, partial(with_blame, self, apply))

    def length(self) -> int | None:
        """Return the number of steps of the action; None if only the run determines it.

        Subclasses override it if they know it; a `duration` is known in any case.
        """
        ends = self.registered.ends
        content = 0 if self.registered.is_momentary else None
        return content if self._limits is None else self._limits.length(content, ends == "open")

    def seconds(self) -> float | None:
        """Return its duration, if it is a single number."""
        return super().seconds() if self._limits is None else self._limits.fixed

    @property
    def elapsed_steps(self) -> int:
        """Steps since the start of the action."""
        return self.context.step - self._start_step

    @property
    def elapsed(self) -> float:
        """Seconds since the start of the action."""
        return self.elapsed_steps * self.context.dt

    # --- execution ---

    def look_ahead(self) -> None:
        """Check that the map has the requested elements, after placement and setup.

        Raises:
            BeyondMapError: The map lacks them at all possible positions of the actor.
        """

    def initialise(self) -> None:
        """Claim the slots and start."""
        self._start_step = self.context.step
        if self._limits is not None:
            self._limits.begin()
        if self.context.entries is not None:
            self.context.entries.begins(self)
        self.context.trace.action("start", self)
        if self.context.monitors is not None:
            self.context.monitors.begins(self)
        self._claim()
        with_blame(self, self.on_start)

    def update(self) -> Status:
        """Update, within the duration."""
        limits = self._limits
        status = self._content()
        if limits is None:
            return status
        holds = status is SUCCESS and self.lasts_its_duration()
        return limits.judge(RUNNING if holds else status, holds or self.registered.ends == "open")

    def lasts_its_duration(self) -> bool:
        """Return whether the reached state continues for its duration."""
        return self.registered.ends != "goal"

    def _content(self) -> Status:
        """Update; it does not end before its effects are applied."""
        if self._is_ours:  # called in each step of each action
            status = self.on_update()
        else:
            status = checked(self, with_blame(self, self.on_update))
        pending = status is SUCCESS and self.context.effects.is_pending(self)
        return RUNNING if pending else status

    def lateness(self) -> float:
        """Return the status of the duration, if it ends the action."""
        late = None if self._limits is None else self._limits.late
        return super().lateness() if late is None else late

    def judge_end(self, status: Status) -> Status:
        """Fail if a condition of its phase does not hold; interrupted phases are not checked."""
        monitors = self.context.monitors
        if monitors is None:
            return status
        if status is not SUCCESS:
            monitors.leaves(self)
            return status
        failures = monitors.ends(self)
        if not failures:
            return status
        self.failure_source = failures[0].source
        return self.fail("; ".join(map(str, failures)))

    def terminate(self, new_status: Status) -> None:
        """Clean up, release the slots and write the trace."""
        try:
            with_blame(self, self.on_stop)
        finally:
            if new_status is INVALID:
                self.context.effects.withdraw(self)
            self._release(self._momentary and new_status is SUCCESS)
            if new_status is FAILURE:
                self.context.trace.action("fail", self, self.feedback_message)
            else:
                reason = "stopped" if new_status is INVALID else None
                self.context.trace.action("end", self, reason, self._deviation())

    def _claim(self) -> None:
        """Claim the slots of the actor."""

    def _release(self, momentary: bool) -> None:
        """Release the slots of the actor.

        Args:
            momentary: Whether it held them for no time, and changed a state that they control.
        """

    def _deviation(self) -> Deviation | None:
        """Return the deviation of the actor from its command, if it was measured."""
        return None


def registered_as(factory: type[BaseAction]) -> Method:
    """Return the registration of a class; by default one with a goal and without slots."""
    method: Method | None = getattr(factory, "method", None)
    return Method(None, factory.__name__, (), "goal") if method is None else method


def full_name(actor_id: str | None, name: str) -> str:
    """Return the name of an action in the trace, with its actor if there is one."""
    return name if actor_id is None else f"{actor_id} {name}"


def with_blame(action: BaseAction, function: Callable[[], T]) -> T:
    """Call a function of an action.

    Exceptions of user-defined actions are reported as their errors.

    Raises:
        ScenarioError: The class is user code, and raised an exception.
    """
    if action._is_ours:
        return function()
    with OwnCode(f"{action.action_name}: {name_of(type(action))} raised", action.source):
        return function()


class RefusedAction(BaseAction):
    """Represents an action without a class, or with wrong arguments.

    Its source position is unknown when it is created; at setup, before the first step, it is known,
    and the node rejects the run. Until then the tree can be shown and counted like any other.

    Args:
        name: Of the action, with its actor if there is one.
        error: Why it cannot.
        label: Label of the node.
    """

    def __init__(self, name: str, error: ScenarioError, label: str | None = None) -> None:
        super().__init__(label=label)
        self.action_name = name
        self.name = label or self.action_name
        self.error = error

    def setup(self, **kwargs: Any) -> None:
        """Reject the run.

        Raises:
            ScenarioError: Always; it names the source position.
        """
        self.error.source = self.error.source or self.source or None
        raise self.error
