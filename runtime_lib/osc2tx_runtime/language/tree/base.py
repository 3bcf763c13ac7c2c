"""Base classes of tree nodes, on py_trees behaviours.

A node's work is `pulse()`: one call per pass that returns the new status. The generator `tick()` of
py_trees is kept for viewers and visitors, but each node costs a pass through all its ancestors;
`pulse()` calls descend the tree directly.

A node is left in one of three ways, which `stop` distinguishes by its status: SUCCESS (it ended, on
its own or at its open end), FAILURE, INVALID (interrupted).
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping
from typing import Any, Protocol

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from osc2tx_runtime.errors import ScenarioError, is_own, message_of, name_of
from osc2tx_runtime.language.context import ExecutionContext, PostedEvent

__all__ = [
    "Activity",
    "Behaviour",
    "Leaf",
    "Node",
    "Status",
    "checked",
    "place_key",
    "split_label",
]

RUNNING = Status.RUNNING
SUCCESS = Status.SUCCESS
FAILURE = Status.FAILURE
INVALID = Status.INVALID


class Activity:
    """The visible activity of a node: a change in a pass is visible from the next."""

    def __init__(self) -> None:
        self._active = self._was_active = False
        self._changed = self._started = self._started_before = 0

    def begin(self, tick: int) -> None:
        """Note a start in pass `tick`."""
        self._change(True, tick)
        if self._started != tick:
            self._started_before, self._started = self._started, tick

    def end(self, tick: int) -> None:
        """Note an end in pass `tick`."""
        self._change(False, tick)

    def started_since(self, begin: int, tick: int) -> bool:
        """Return whether a start since pass `begin` is visible in pass `tick`."""
        started = self._started_before if self._started == tick else self._started
        return 0 < begin <= started < tick

    def is_active(self, tick: int) -> bool:
        """Return whether the node is visibly running in pass `tick`."""
        return self._was_active if self._changed == tick else self._active

    def _change(self, active: bool, tick: int) -> None:
        if self._changed != tick:
            self._was_active, self._changed = self._active, tick
        self._active = active


NEEDS_RUN = (
    "the tree of a scenario needs the world of a run: call `run_scenario(TheScenario)` of"
    " osc2tx_runtime instead of ticking it"
)


class Node(Behaviour):
    """Common base of leaves and compositions.

    Attributes:
        source: Position in the scenario, `hello_world.osc:57`; the line comes from the source map.
        position: Position in the whole tree, as written in the modules; occurrences of one instant
            are reported in this order.
        draws: Key of the node's random values, besides the seed: names in the module.
        label: Name that `@label.end` and similar events refer to; None without one.
        open_ended: Whether it never ends on its own, but only with its surroundings.
        instant: Whether it takes no time (emit, call, assignments), and so bounds no composition.
        service: Whether it accompanies the others (on, sampled variables); no interval rule counts
            it.
        synthetic: Whether it is not in the module, so that the source map does not count it.
        scope: Path of the nested scenario the node belongs to; empty in the main scenario.
        listeners: (label, `start` | `end` | `fail`) of that scenario to the event waited for.
        activity: When the node was last active; only kept where an `override` asks.
        failed_at: Time in seconds of the last failure.
        started_late: Seconds by which its exact start precedes the step at which it started.
        ended_late: The same of its end with success.
        context: The run; there from `setup` on.
    """

    source: str = ""
    position: int = 0
    draws: str = ""
    label: str | None = None
    open_ended: bool = False
    instant: bool = False
    service: bool = False
    synthetic: bool = False
    scope: str = ""
    listeners: Mapping[tuple[str, str], PostedEvent] | None = None
    activity: Activity | None = None
    failed_at: float | None = None
    started_late: float = 0.0
    ended_late: float = 0.0
    context: ExecutionContext
    _started: PostedEvent | None = None
    _first_step: int = 0
    _ended: PostedEvent | None = None
    _failed: PostedEvent | None = None

    def __getattr__(self, name: str) -> Any:
        """Report a tree that is ticked without setup."""
        if name == "context":
            raise ScenarioError(NEEDS_RUN)
        raise AttributeError(f"{type(self).__name__} has no attribute {name!r}")

    def setup(self, **kwargs: Any) -> None:
        """Take the `context` of the run.

        Raises:
            ScenarioError: It is set up outside a run.
        """
        if "context" not in kwargs:
            raise ScenarioError(NEEDS_RUN)
        self.context = kwargs["context"]
        if self.label is not None:
            events = self.context.label_events if self.listeners is None else self.listeners
            self._started = events.get((self.label, "start"))
            self._ended = events.get((self.label, "end"))
            self._failed = events.get((self.label, "fail"))

    def pulse(self) -> Status:
        """Do the work of one pass.

        A repeated call at the same instant must have no effect, unless an event occurred.
        """
        raise NotImplementedError

    def length(self) -> int | None:
        """Return the number of steps of the node; None if only the run determines it."""
        return 0 if self.instant else None

    def seconds(self) -> float | None:
        """Return the duration (s) that the node states; it may be called before setup."""
        return 0.0 if self.instant else None

    def lateness(self) -> float:
        """Return the seconds by which its exact end precedes this step.

        A node without a time limit ends at the step; an instantaneous one at its start.
        """
        return self.started_late if self.context.step == self._first_step else 0.0

    def lasted(self, late: float) -> float:
        """Return its duration (s) so far, up to a time (s) before this step."""
        context = self.context
        return (context.step - self._first_step) * context.dt + self.started_late - late

    @property
    def takes_no_time(self) -> bool:
        """Whether it is over at once; known before it is set up."""
        return self.instant

    def situation(self) -> str:
        """Return a description of a node that is still running; empty by default."""
        return ""

    def waits_in_vain(self) -> bool:
        """Whether it waits, or waited, for a change to a value that it already has."""
        return False

    def generator(self, what: str) -> random.Random:
        """Return the generator of this node: its draws do not depend on the order of starts."""
        scope = f"{self.scope}/" if self.scope else ""
        return self.context.random_for(f"{scope}{what}/{self.draws}")

    def fail(self, reason: str) -> Status:
        """Return FAILURE and keep the reason for the verdict."""
        self.feedback_message = reason
        return FAILURE

    def update(self) -> Status:
        """Return the status of one pass, as py_trees requires."""
        return self.pulse()

    def tick_once(self) -> None:
        """Pulse; py_trees' name for it."""
        self.pulse()

    def tick(self) -> Iterator[Behaviour]:
        """Pulse, then yield the active nodes for the visitors of py_trees."""
        self.pulse()
        for node in self.iterate():
            if node.status is not INVALID:
                yield node

    def stop(self, new_status: Status = INVALID) -> None:
        """Leave the node; running children are left first.

        An end with success becomes a failure if a child that ends with it fails; `status` says so.
        """
        if self.status is RUNNING:
            late = self.lateness() if new_status is SUCCESS else 0.0
            new_status = self.judge_end(self._stop_children(new_status))
            if new_status is FAILURE:
                self.failed_at = self.context.time
            elif new_status is SUCCESS:
                self.ended_late = late
            self.context.resting.forget(self)
            self.terminate(new_status)
            self._post_life_event(new_status)
            self.context.trace.node_ends(self, self.context.time, new_status.name)
            if self.activity is not None:
                self.activity.end(self.context.tick)
        elif new_status is INVALID:
            self._stop_children(new_status)
        self.status = new_status

    def goes_on(self) -> bool:
        """Return whether only its surroundings end it from here on; asked while it runs."""
        return self.open_ended

    def open_since(self) -> tuple[int, float]:
        """Return since when only they do: the step, and the seconds by which it precedes it."""
        return self._first_step, self.started_late

    def least_length(self) -> int | None:
        """Return the steps it needs though it is open-ended; None if only the run shows it."""
        return 0

    def judge_end(self, status: Status) -> Status:
        """Return the final status of the node, given its preliminary one."""
        return status

    def _stop_children(self, new_status: Status) -> Status:
        """End running children with an ended parent; interrupt them otherwise.

        Returns:
            The status; a failure if it was success and one of them fails at its end.
        """
        result = new_status
        for child in self.children:
            if child.status is RUNNING:
                child.stop(SUCCESS if new_status is SUCCESS else INVALID)
                if new_status is SUCCESS and child.status is FAILURE:
                    result = FAILURE
            elif new_status is INVALID and child.status is not INVALID:
                child.stop(INVALID)
        return result

    def _begin(self) -> None:
        """Enter the node.

        The status is RUNNING from here, so that a clean-up finds a half-started node.
        """
        for child in self.children:
            if child.status is not INVALID:
                child.stop(INVALID)
        self.status = RUNNING
        self.feedback_message = ""
        self.started_late, self._first_step = self.context.late, self.context.step
        self.context.trace.node_starts(self, self.context.time)
        if self._started is not None:
            self.context.post(self._started)
        if self.activity is not None:
            self.activity.begin(self.context.tick)
            self.context.request_pass()
        try:
            self.initialise()
        except ScenarioError as error:
            error.source = error.source or self.source or None
            raise

    def _post_life_event(self, new_status: Status) -> None:
        event = {SUCCESS: self._ended, FAILURE: self._failed}.get(new_status)
        if event is not None:
            self.context.post(event)


class Leaf(Node):
    """A node without members; subclasses write `initialise`, `update` and `terminate`.

    `terminate` is called exactly once for each `initialise`.
    """

    def update(self) -> Status:
        """Return the status of this pass."""
        raise NotImplementedError

    def pulse(self) -> Status:
        """Start if needed, update, and leave when that is done."""
        try:
            if self.status is not RUNNING:
                self._begin()
            status = self.update()
            if status is not RUNNING:
                self.stop(checked(self, status))
            return self.status
        except ScenarioError as error:
            error.source = error.source or self.source or None
            raise
        except KeyboardInterrupt:
            raise
        except BaseException as error:  # a user-defined subclass may raise anything
            if not is_own(type(self)):
                raise
            text = f"{self.name}: {name_of(type(self))} raised {message_of(error)}"
            raise ScenarioError(text, self.source or None) from error


def checked(node: Behaviour, status: object) -> Status:
    """Return the status if it is valid at the end of a pass.

    Raises:
        ScenarioError: It is invalid: the class is user code.
    """
    if status is RUNNING or status is SUCCESS or status is FAILURE:
        if isinstance(node.feedback_message, str):
            return status
        raise ScenarioError(f"{node.name} gives a reason that is not a string")
    shown = status if isinstance(status, Status | None) else f"a {type(status).__name__}"
    raise ScenarioError(f"{node.name} returns {shown}, which is not a status of a node")


class Named(Protocol):
    """An object with a name, such as a node."""

    name: str


def place_key(node: Named) -> tuple[int, str]:
    """Return the sort key of a node: its position in the tree; its name without a position."""
    return getattr(node, "position", 0), node.name


def split_label(arguments: tuple[Any, ...]) -> tuple[str | None, tuple[Any, ...]]:
    """Return the label that may stand before the positional arguments of a node, and these."""
    if arguments and isinstance(arguments[0], str | None):
        return arguments[0], arguments[1:]
    return None, arguments
