"""What the concrete actions share: the state of the actor and the progress of its commands."""

from __future__ import annotations

from typing import TYPE_CHECKING

from osc2tx_runtime.action import Action
from osc2tx_runtime.behaviour.base import Status
from osc2tx_runtime.errors import ScenarioError

if TYPE_CHECKING:
    from osc2tx_runtime.context import ExecutionContext
    from osc2tx_runtime.opendrive import LanePosition
    from osc2tx_runtime.world.protocol import LightState, World
    from osc2tx_runtime.world.state import ActorState

__all__ = ["MotionAction", "OneStepAction", "note_lights"]


class MotionAction(Action):
    """An action that commands the motion of its actor."""

    @property
    def world(self) -> World:
        """The world."""
        return self.context.world

    @property
    def here(self) -> ActorState:
        """State of the actor at the present step."""
        return self.context.world.state(self.actor.id)

    def place_of(self, actor_id: str) -> LanePosition:
        """Place of an actor on the lanes.

        Raises:
            ScenarioError: If it is off the road.
        """
        place = self.world.state(actor_id).lane_position
        if place is None:
            raise ScenarioError(f"{actor_id} is not on a road, so it has no lane", self.source)
        return place

    def on_update(self) -> Status:
        """Ends with the goal in all slots, fails as soon as one cannot be reached."""
        if self.elapsed_steps == 0:
            return Status.RUNNING  # the commands act from now on
        done, progress_of, actor_id = True, self.context.world.progress, self.actor.id
        for slot in self.slots or ():
            progress = progress_of(actor_id, slot)
            if progress.failed is not None:
                return self.fail(progress.failed)
            done = done and progress.done
        open_end = self.registered.ends == "open"
        return Status.SUCCESS if done and not open_end else Status.RUNNING

    def fixed_duration(self) -> float | None:
        """The duration (s) if it is one number."""
        duration = self.duration
        return None if duration is None or isinstance(duration, tuple) else float(duration)


class OneStepAction(MotionAction):
    """An action whose change can be seen at the next step, when it ends."""

    def on_update(self) -> Status:
        """Ends at the next step."""
        return Status.SUCCESS if self.elapsed_steps else Status.RUNNING


def note_lights(context: ExecutionContext, actor_id: str, lights: LightState) -> None:
    """Writes to the trace what was asked for and what shines now."""
    context.trace.other(0, "lights", actor=actor_id, mode=lights.mode, lit=lights.lit)
