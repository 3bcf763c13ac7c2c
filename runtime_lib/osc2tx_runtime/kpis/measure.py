"""The base class of measures."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import NamedTuple, Protocol

from osc2tx_runtime.language.context import ExecutionContext
from osc2tx_runtime.world.measuring.collision import Box, box_of
from osc2tx_runtime.world.state import ActorState


class Moving(NamedTuple):
    """An actor at one step.

    Attributes:
        id: Of the actor.
        state: Its state.
        box: Its bounding box.
        vx: Velocity along the x axis of the world (m/s): its speed along its heading.
        vy: The same along y (m/s).
        reach: Metres from the centre of the box to a corner.
    """

    id: str
    state: ActorState
    box: Box
    vx: float
    vy: float
    reach: float


class Scene(NamedTuple):
    """All actors at one step.

    Attributes:
        step: From 0.
        time: Seconds.
        dt: Length of a step (s).
        actors: In the order of the cast.
        context: The run.
    """

    step: int
    time: float
    dt: float
    actors: tuple[Moving, ...]
    context: ExecutionContext


class Measure(Protocol):
    """Evaluates the steps of one run; created anew for each run. All values have SI units.

    Its class may have an attribute `worst`, `min` or `max`: whether a search minimizes or maximizes
    the value to find the worst case.
    """

    def observe(self, scene: Scene) -> None:
        """Evaluate a step, including the first."""

    def results(self) -> Mapping[str, float | None]:
        """Return values by name, including the name of the measure."""


def scene_of(context: ExecutionContext, step: int) -> Scene:
    """Return all actors of a run in their present states."""
    state = context.world.state
    actors = tuple(_moving(actor_id, state(actor_id)) for actor_id in context.cast())
    return Scene(step, step * context.dt, context.dt, actors, context)


def _moving(actor_id: str, state: ActorState) -> Moving:
    box = box_of(state)
    reach = (box.half_length**2 + box.half_width**2) ** 0.5
    return Moving(actor_id, state, box, state.v * box.cos, state.v * box.sin, reach)


def pairs_of(actors: tuple[Moving, ...]) -> Iterator[tuple[Moving, Moving]]:
    """Yield each pair of actors once."""
    for index, one in enumerate(actors):
        for other in actors[index + 1 :]:
            yield one, other
