"""The loop of a run: one instant after the other until the tree ends, or up to a limit."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

from osc2tx_runtime.errors import ScenarioError, SettingsError
from osc2tx_runtime.language.actions.base_action import BaseAction
from osc2tx_runtime.language.context import ExecutionContext, PostedEvent
from osc2tx_runtime.language.outline import outline
from osc2tx_runtime.language.tree.base import FAILURE, INVALID, RUNNING, SUCCESS, Behaviour, Status
from osc2tx_runtime.language.tree.compositions import Serial
from osc2tx_runtime.language.tree.conflicts import check_claims, check_effects
from osc2tx_runtime.language.tree.coverage import Recording
from osc2tx_runtime.language.tree.failure_reasons import (
    failure_place,
    failure_reason,
    timeout_place,
    timeout_reason,
)
from osc2tx_runtime.language.tree.members import is_instant, pulse_of
from osc2tx_runtime.running.criteria import Criteria

if TYPE_CHECKING:
    from osc2tx_runtime.world.state import ActorState


class Observer(Protocol):
    """Called during a run; its exceptions end the run."""

    def begin(self, context: ExecutionContext) -> None:
        """Observe the actors at their start, before the first step."""

    def observe(self, step: int) -> None:
        """Observe the result of a step."""

    def sampled(self, kind: str, values: Mapping[str, Any]) -> None:
        """Receive the value of a coverage item, `cover` or `record`, as in the trace."""


OnProgress = Callable[[float, float], None]
"""Receives the time of the run and its time limit, in seconds."""


class Outcome(NamedTuple):
    """The outcome of a tree: `success`, `failure` or `timeout`, reason, steps, and position."""

    status: str
    reason: str
    steps: int
    place: str = ""


def run_tree(
    root: Behaviour,
    context: ExecutionContext,
    on_progress: OnProgress | None = None,
    observer: Observer | None = None,
    last_step: int | None = None,
) -> Outcome:
    """Run a tree after its setup until it ends or the time limit is reached.

    Afterwards no node is RUNNING and no slot is owned in any case, and the trace is closed.

    Args:
        root: The tree.
        context: Of the run.
        on_progress: Called about once per simulated second.
        observer: Observes the run.
        last_step: The step of the time limit; default: that of `max_time`.

    Raises:
        ScenarioError: The scenario cannot continue.
    """
    outcome = Outcome("error", "", 0)
    try:
        criteria = Criteria(context)
        if last_step is None:
            last_step = context.steps(context.settings.max_time)
        found = loop(root, context, criteria, on_progress, observer, last_step)
        outcome = judged(found, criteria)
    except BaseException as error:
        if isinstance(error, ScenarioError) and not isinstance(error, SettingsError):
            error.happened(context.time)
        text = str(error) if isinstance(error, ScenarioError) else repr(error)
        if isinstance(error, KeyboardInterrupt):
            text = f"interrupted at {context.time:g} s"
        outcome = Outcome("error", text, context.step)
        raise
    finally:
        close(root, context, outcome)
    return outcome


def judged(outcome: Outcome, criteria: Criteria) -> Outcome:
    """Return the outcome of a run; a violated criterion is a failure."""
    if not criteria.broken:
        return outcome
    reasons = [*criteria.broken, outcome.reason] if outcome.reason else criteria.broken
    return Outcome("failure", "; ".join(reasons), outcome.steps)


def close(root: Behaviour, context: ExecutionContext, outcome: Outcome) -> None:
    """Leave the tree, free the slots, and write the end of the trace."""
    try:
        if outcome.status in ("failure", "timeout"):
            for node in root.iterate():
                if isinstance(node, Recording):
                    node.run_ends(outcome.status)
        if root.status is RUNNING:
            root.stop(INVALID)
    finally:
        for node in root.iterate():  # nodes that a failed `on_stop` left running
            if node.status is RUNNING:
                node.status = INVALID
        context.clear()
        context.trace.end_instant(context.time, states(context))
        write_tree(root, context)
        found = overloads(context)
        context.trace.result(outcome.status, outcome.reason, outcome.steps, found)


def overloads(context: ExecutionContext) -> tuple[str, ...]:
    """Return the motions beyond the limits of tyres, for a run that continued."""
    if context.settings.physics == "fail":
        return ()
    return tuple(map(str, context.world.overloads()))


def write_tree(root: Behaviour, context: ExecutionContext) -> None:
    """Write when each node of the tree ran."""
    if context.trace.enabled:
        context.trace.tree((each.node, each.words()) for each in outline(root))


def loop(
    root: Behaviour,
    context: ExecutionContext,
    criteria: Criteria,
    on_progress: OnProgress | None,
    observer: Observer | None,
    last_step: int,
) -> Outcome:
    """Settle one instant after the other until the tree ends or the time limit is reached."""
    pulse = pulse_of(root)
    if observer is not None:
        observer.begin(context)
    world, settings, monitors = context.world, context.settings, context.monitors
    progress_steps = max(1, context.steps(1.0))
    signals = signals_by_step(context)
    step = 0
    while True:
        context.begin_step(step)
        status = settle(root, pulse, context, signals.get(step, ()))
        if context.slots.is_touched:
            check_claims(context)
            context.commit()
        if monitors is not None:
            monitors.observe()
        if status is SUCCESS:
            return Outcome("success", "", step)
        if status is FAILURE:
            return Outcome("failure", failure_reason(root, context), step, failure_place(root))
        if step >= last_step:
            return Outcome("timeout", timeout_reason(root, context), step, timeout_place(root))
        if context.trace.enabled:
            context.trace.end_instant(context.time, states(context))
        if on_progress is not None and step % progress_steps == 0:
            on_progress(context.time, settings.max_time)
        world.step()
        step += 1
        for one, other in world.collisions():
            context.note_collision(step, one, other)
        criteria.observe(step)
        if observer is not None:
            observer.observe(step)
        for kind, values in world.take_notes():
            context.trace.other(8, kind, **values)
        if settings.physics == "fail" and world.overloads():
            context.begin_step(step)
            return Outcome("failure", str(world.overloads()[0]), step)


def settle(
    root: Behaviour,
    pulse: Callable[[], Status],
    context: ExecutionContext,
    signals: tuple[PostedEvent, ...],
) -> Status:
    """Pulse the tree until the instant is settled; not at all while it rests.

    First all pending events are processed. Then all pending assignments are applied together, and
    the evaluation continues with the new snapshot, until nothing is pending. At the start of the
    run, conditions are evaluated after this has placed the actors.

    Signals are visible from the first pass, so a wait that starts at this instant does not register
    them. Those at the start of the run become visible one pass later, so that the first waits
    register them.
    """
    context.is_placing = context.step == 0 and assigns_at_start(root)
    if signals and context.step > 0:
        post_all(context, signals)
    context.begin_pass()
    if signals and context.step == 0:
        post_all(context, signals)
    resting = context.resting.nodes
    status = RUNNING if root in resting else pulse()
    while status is RUNNING:
        if not (context.has_news() or assigns(context)):
            if context.is_placing:
                context.placed()
            elif not context.settles():
                return status
        context.begin_pass()
        status = RUNNING if root in resting else pulse()
    assigns(context)
    return status


def assigns(context: ExecutionContext) -> bool:
    """Apply the pending assignments; return whether there were any."""
    if not context.effects.is_pending():
        return False
    check_effects(context)
    context.carry_out()
    return True


def post_all(context: ExecutionContext, signals: tuple[PostedEvent, ...]) -> None:
    """Post external events; their parameters have their defaults."""
    for event in signals:
        context.post(event, event.complete({}))


def signals_by_step(context: ExecutionContext) -> dict[int, tuple[PostedEvent, ...]]:
    """Return the signals of the settings by the first step at or after their time."""
    found: dict[int, tuple[PostedEvent, ...]] = {}
    for name, seconds in context.settings.signal.items():
        step = context.steps(seconds)
        event = context.events[name]
        problem = event.problem(())
        if problem:
            raise SettingsError(f"--signal {name}: {problem}")
        found[step] = (*found.get(step, ()), event)
    return found


def states(context: ExecutionContext) -> Iterator[tuple[str, ActorState]]:
    """Yield the states of the placed actors, in the order of the cast."""
    state = context.world.state
    return ((actor_id, state(actor_id)) for actor_id in context.cast())


def assigns_at_start(node: Behaviour) -> bool:
    """Return whether a tree may assign the state of an actor at the instant of its start."""
    if isinstance(node, BaseAction):
        return _assigns(node)
    for child in node.children:
        if assigns_at_start(child):
            return True
        if isinstance(node, Serial) and not is_instant(child):
            return False
    return False


def _assigns(action: BaseAction) -> bool:
    return action.registered.is_momentary and bool(action.registered.slots)
