"""The state of one run that all nodes share: clock, events, slots, effects.

A node must not change values that another node reads in the same pass. So nodes submit their
requests here:

- `post`, `assign`: an event, a new value become visible with the next pass;
- `effect`: a change of state at one instant (assign_speed, set_lights), applied together with
  all others once no event of the instant is pending; a new snapshot follows;
- `claim`, `command`, `release`: the owners of slots, from the settled instant (`commit`).
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cached_property
from typing import Any, Protocol

from osc2tx_runtime.clock import lateness, whole_steps
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.language.declared import BaseActor, DeclaredObject
from osc2tx_runtime.language.resting import Resting
from osc2tx_runtime.language.settings import RunSettings
from osc2tx_runtime.language.slots import Effect, Effects, Owner, Slots
from osc2tx_runtime.language.trace import TraceWriter
from osc2tx_runtime.world.checks.commands import command_problem
from osc2tx_runtime.world.commands import Command
from osc2tx_runtime.world.protocol import EXACT, LATERAL, LONGITUDINAL, World

MAX_PASSES = 1000


class PostedEvent(Protocol):
    """The interface of an event for a run."""

    name: str

    def occur(self, tick: int, step: int, occurrences: Sequence[Mapping[str, Any]]) -> None:
        """Become visible in pass `tick` of an instant."""
        ...

    def problem(self, given: Iterable[str]) -> str:
        """Return the error in the names of arguments."""
        ...

    def complete(self, given: Mapping[str, Any]) -> Mapping[str, Any]:
        """Return all arguments of an occurrence."""
        ...


class AssignedVariable(Protocol):
    """The interface of a sampled variable for a run."""

    name: str
    value: Any


class NotHeld(Protocol):
    """A condition that does not hold; its text is the reason."""

    @property
    def source(self) -> str:
        """Its position in the scenario."""
        ...


class Monitors(Protocol):
    """The interface of a checker of the phases of actions."""

    def begins(self, action: Any) -> None:
        """Note the start of an action."""
        ...

    def ends(self, action: Any) -> Sequence[NotHeld]:
        """Note its end; return the conditions that let it fail."""
        ...

    def leaves(self, action: Any) -> None:
        """Note that it is interrupted."""
        ...

    def observe(self) -> None:
        """Check the states of a settled instant."""
        ...


class Entries(Protocol):
    """The interface of actors that enter, for a run."""

    def begins(self, action: Any) -> None:
        """Note the start of an action."""
        ...


class ExecutionContext:
    """One run.

    Attributes:
        world: The world; its snapshot is the present step.
        settings: Settings of the run.
        actors: Actors by id, in the order of their declaration.
        objects: Parts of the map that the scenario declares.
        events: Declared events by name.
        trace: Takes the lines of the trace.
        dt: Length of a step in seconds.
        step: Present step; `time` is `step * dt`.
        pass_number: Number of the present pass within the step, from 0.
        tick: Number of the present pass within the run, from 1: the clock of events.
        late: Seconds by which the exact start of what begins now precedes this step: in a serial, a
            member that time ends passes its exact end on to its successor.
        snapshot: Number of the values that nodes read: changes with each step, with each pass in
            which a sampled variable gets a new value, and when effects are applied.
        is_placing: Whether the first assignments of the run are not applied yet; conditions wait.
        settled: Whether the instant is settled: what is unfinished now remains so at this instant.
        one_of: Policy of the scenario: `race`, `first` or `seeded`.
        random: Seeded generator. For draws inside nodes use `random_for`: two parallel nodes
            that draw from one generator would depend on the order of their visit.
        collisions: Time in seconds and the two actors of each new contact.
        illegal: Items of coverage with the description of their first illegal value (DSL 7.5.5).
        first_come: Whether members with a duration or an `until` end with whichever comes first.
        label_events: (label, `start` | `end` | `fail`) to the awaited event.
        resting: Nodes of the tree without work until they are woken.
        monitors: Checks the phases of actions; None: no checks.
        entries: Actors that enter; None without any.
        open_starts: Actors whose position at the start the scenario leaves open.
    """

    def __init__(
        self,
        world: World,
        settings: RunSettings | None = None,
        actors: Mapping[str, BaseActor] | None = None,
        *,
        events: Mapping[str, PostedEvent] | None = None,
        objects: Sequence[DeclaredObject] = (),
        trace: TraceWriter | None = None,
        label_events: Mapping[tuple[str, str], PostedEvent] | None = None,
        one_of: str = "race",
        first_come: bool = False,
    ) -> None:
        self.world = world
        self.settings = settings or RunSettings()
        self.actors: dict[str, BaseActor] = dict(actors or {})
        self.objects = tuple(objects)
        self.events = dict(events or {})
        self.trace = trace or TraceWriter()
        self.label_events = dict(label_events or {})
        self.one_of = one_of
        self.first_come = first_come
        self.dt = self.settings.dt
        self.step = 0
        self.pass_number = 0
        self.tick = 0
        self.late = 0.0
        self.snapshot = 0
        self.is_placing = False
        self.open_starts: frozenset[str] = frozenset()
        self.settled = False
        self.random = random.Random(self.settings.seed)
        self.slots = Slots()
        self.effects = Effects()
        self.collisions: list[tuple[float, str, str]] = []
        self.illegal: dict[str, str] = {}
        self.resting = Resting()
        self.monitors: Monitors | None = None
        self.entries: Entries | None = None
        self._cast: tuple[str, ...] | None = None
        self._left: dict[str, str] = {}  # actors to behavioral models of this instant
        self._posted: dict[PostedEvent, list[Mapping[str, Any]]] = {}
        self._assigned: dict[AssignedVariable, Any] = {}
        self.samplers: list[Callable[[], None]] = []
        self._pass_wanted = False
        self._settling_wanted = False

    @property
    def time(self) -> float:
        """Seconds since the start of the scenario."""
        return self.step * self.dt

    def steps(self, seconds: float) -> int:
        """Return a duration in steps: until the first one at or after its end."""
        return whole_steps(seconds, self.dt)

    def due(self, seconds: float, late: float) -> tuple[int, float]:
        """Return the first step at or after a time (s) from now, and how late it is.

        Args:
            seconds: How long.
            late: Seconds by which their exact start precedes this step.
        """
        left = seconds - late
        steps = max(0, self.steps(left))
        return self.step + steps, lateness(steps, left, self.dt)

    def cast(self) -> tuple[str, ...]:
        """Return the ids of the placed actors, in the order of their declaration.

        Actors of invoked scenarios come last, by path.
        """
        if self._cast is None:
            placed = set(self.world.actors())
            found = (actor_id for actor_id in self.actors if actor_id in placed)
            self._cast = tuple(sorted(found, key=lambda name: name.rpartition(".")[0]))
        return self._cast

    @cached_property
    def is_measured(self) -> bool:
        """Whether a simulator moves some of the actors, so that their states are noisy."""
        return any(self.world.control(actor) not in EXACT for actor in self.cast())

    def random_for(self, key: str) -> random.Random:
        """Return a separate generator for `key`: the same seed and key give the same draws."""
        return random.Random(f"{self.settings.seed}/{key}")

    # --- events and passes ---

    def post(self, event: PostedEvent, arguments: Mapping[str, Any] | None = None) -> None:
        """Post an event; it is visible from the next pass of this instant."""
        self._posted.setdefault(event, []).append(dict(arguments or {}))
        self.trace.event(event.name, arguments)

    def assign(self, variable: AssignedVariable, value: Any) -> None:
        """Set the value of a sampled variable; it is visible from the next pass of this instant."""
        self._assigned[variable] = value
        self._pass_wanted = True

    def request_pass(self) -> None:
        """Request one more pass at this instant."""
        self._pass_wanted = True

    def request_settling(self) -> None:
        """Request a pass with `settled` set, after all others of this instant."""
        self._settling_wanted = True

    def begin_step(self, step: int) -> None:
        """Advance to a step; its first pass comes next."""
        self.step = step
        self.resting.begin_step(step, self.world.changed)
        self._left.clear()
        self.effects.begin_step()
        self.snapshot += 1
        self.pass_number = -1
        self.settled = False

    def begin_pass(self) -> None:
        """Start a pass: posted events and values become visible.

        Raises:
            ScenarioError: The instant does not settle.
        """
        self.tick += 1
        self.pass_number += 1
        if self.pass_number >= MAX_PASSES:
            changing = {event.name for event in self._posted}
            names = ", ".join(sorted(changing.union(v.name for v in self._assigned)))
            raise ScenarioError(
                f"events cause each other without end at {self.time:.3f} s"
                + (f": {names}" if names else "")
            )
        if self._posted or self._assigned:
            self.resting.wake_all()
        posted, self._posted = self._posted, {}
        for event, arguments in posted.items():
            event.occur(self.tick, self.step, arguments)
        self._assign()
        for sampler in self.samplers:
            sampler()
        self._assign()
        self._pass_wanted = self._settling_wanted = False
        self.resting.begin_pass()

    def _assign(self) -> None:
        """Set variables to their assigned values."""
        if self._assigned:
            self.snapshot += 1
            for variable, value in self._assigned.items():
                variable.value = value
                self.trace.variable(variable.name, value)
            self._assigned.clear()

    def has_news(self) -> bool:
        """Return whether events or values require another pass of this instant."""
        if not self._posted and not self._pass_wanted:
            return False
        self.settled = False
        return True

    def carry_out(self) -> None:
        """Apply the effects together."""
        self.effects.apply()
        self.snapshot += 1
        self.settled = False
        self.resting.wake_all()

    def placed(self) -> None:
        """Enable conditions: the first assignments have placed the actors."""
        self.is_placing = False
        self.snapshot += 1
        self.resting.wake_all()

    def settles(self) -> bool:
        """Return whether a pass is requested after all others of this instant.

        Then set `settled`.
        """
        if not self._settling_wanted:
            return False
        self.settled = True
        return True

    # --- owners of slots ---

    def claim(self, actor_id: str, slot: str, owner: Owner) -> None:
        """Make an action the owner of a slot; two live owners at a settled instant conflict."""
        if slot not in (LONGITUDINAL, LATERAL):
            raise ScenarioError(
                f"{owner.name} claims {slot!r:.40}, which is not a slot", owner.source or None
            )
        self.slots.claim((actor_id, slot), owner)

    def release(self, actor_id: str, slot: str, owner: Owner, momentary: bool = False) -> None:
        """Release a slot. Without a new owner the actor holds its speed or keeps its lane.

        Args:
            actor_id: The actor.
            slot: The slot.
            owner: The previous owner.
            momentary: Whether it held the slot for no time, to change a state.
        """
        self.slots.release((actor_id, slot), owner)
        if momentary:
            self.slots.pass_through((actor_id, slot), owner)

    def leave(self, actor_id: str, slot: str, model: str, command: Command | None) -> None:
        """Set the command of a slot without owner, from a behavioral model; None: hold, keep.

        Raises:
            ScenarioError: Another model was set at this instant.
        """
        other = self._left.setdefault(actor_id, model)
        if other != model:
            names = ", ".join(sorted((other, model)))
            raise ScenarioError(f"{actor_id} is assigned two behavioral models at once: {names}")
        self.slots.leave((actor_id, slot), command)

    def command(self, actor_id: str, slot: str, owner: Owner, command: Command) -> None:
        """Set the command of an owner; the world gets it when the instant is settled.

        Raises:
            ScenarioError: No world can carry it out.
        """
        problem = command_problem(command, slot, self.world.actors())
        if problem:
            raise ScenarioError(f"{owner.name}: {problem}", owner.source or None)
        self.slots.command((actor_id, slot), owner, command)

    def effect(
        self, key: tuple[str, ...], owner: Owner, value: object, apply: Callable[[], None]
    ) -> None:
        """Request a change of state at this instant.

        Args:
            key: The changed quantity, as in ("speed", "hero").
            owner: The action that changes it.
            value: New value: two actions that are not in sequence may only set equal values.
            apply: Applies it at this instant: calls of the world and the trace.
        """
        self.effects.add(key, Effect(owner, value, apply))

    def commit(self) -> None:
        """Apply the results of the settled instant."""
        self.slots.send(self.world)

    def note_collision(self, step: int, one: str, other: str) -> None:
        """Note a contact that began during a step."""
        self.collisions.append((step * self.dt, one, other))
        self.trace.collision((one, other))

    def clear(self) -> None:
        """Clear claims, effects and posted events at the end of the run."""
        self.slots = Slots()
        self.effects.clear()
        self._posted.clear()
