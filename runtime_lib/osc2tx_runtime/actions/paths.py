"""Actions along paths and trajectories (DSL 8.8.2.8, 8.8.2.9, 8.8.2.16, 8.8.2.17).

A vehicle leaves its lane for the path and returns to the nearest lane behind its end. Along a path
the speed is free: it stays, or another action controls it; who stands sets out at `CRUISE`.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, ClassVar, Generic, TypeVar, Unpack

from osc2tx_runtime.action import ActionOptions
from osc2tx_runtime.behaviour.base import Status
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.modifiers import Modifier
from osc2tx_runtime.paths import PathError, absolute
from osc2tx_runtime.registry import LATERAL, LONGITUDINAL, action
from osc2tx_runtime.values import (
    Path,
    Pose,
    RelativePath,
    RelativeTrajectory,
    RelativeTransform,
    Trajectory,
)
from osc2tx_runtime.world.commands import Command

from .courses import path_command, trajectory_commands
from .support import MotionAction

if TYPE_CHECKING:
    from osc2tx_runtime.actors import MovableObject, PhysicalObject

__all__ = ["FollowPath", "FollowTrajectory", "ReplayPath", "ReplayTrajectory"]

ValueT = TypeVar("ValueT")


class CourseAction(MotionAction):
    """An action on a course that may turn out to be impossible when it starts."""

    def __init__(
        self, actor: MovableObject, modifiers: tuple[Modifier, ...], options: ActionOptions
    ) -> None:
        super().__init__(actor, *modifiers, **options)
        self._refused: str | None = None

    def on_start(self) -> None:
        """Commands the course."""
        try:
            commands = self.commands()
        except PathError as error:
            self._refused = error.message
            return
        for slot, command in commands.items():
            self.command(slot, command)

    def on_update(self) -> Status:
        """Ends behind the last point, fails if there is no way."""
        return super().on_update() if self._refused is None else self.fail(self._refused)

    def commands(self) -> dict[str, Command]:
        """What to command in which slot.

        Raises:
            PathError: There is no such way.
        """
        raise NotImplementedError


def now(value: ValueT | Callable[[], ValueT]) -> ValueT:
    """A value that may be read late."""
    return value() if callable(value) else value


CourseT = TypeVar("CourseT", bound=Path | Trajectory)
RelativeT = TypeVar("RelativeT", bound=RelativePath | RelativeTrajectory)


class _OnCourse(CourseAction, Generic[CourseT, RelativeT]):
    """What paths and trajectories have in common: two ways to say where they are."""

    exact: ClassVar[bool]

    def __init__(
        self,
        actor: MovableObject,
        *modifiers: Modifier,
        absolute: CourseT | Callable[[], CourseT] | None = None,
        relative: RelativeT | Callable[[], RelativeT] | None = None,
        reference: PhysicalObject | None = None,
        transform: RelativeTransform = "object_relative",
        start_offset: float = 0.0,
        end_offset: float = 0.0,
        **options: Unpack[ActionOptions],
    ) -> None:
        super().__init__(actor, modifiers, options)
        if (absolute is None) == (relative is None):
            raise ScenarioError(f"{self.action_name}: give either absolute or relative")
        self.absolute: CourseT | Callable[[], CourseT] | None = absolute
        self.relative: RelativeT | Callable[[], RelativeT] | None = relative
        self.reference = reference or actor
        self.transform: RelativeTransform = transform
        self.offsets = (start_offset, end_offset)

    def course(self) -> CourseT:
        """The course in the world, now."""
        if self.absolute is not None:
            return now(self.absolute)
        assert self.relative is not None
        relative, reference = now(self.relative), self.world.state(self.reference.id)
        points = absolute(self.world.map, relative.points, reference, self.transform)
        return self.resolved(relative, points)

    def resolved(self, relative: RelativeT, points: tuple[Pose, ...]) -> CourseT:
        """The course whose points have been brought into the world."""
        raise NotImplementedError


class _OnPath(_OnCourse[Path, RelativePath]):
    def commands(self) -> dict[str, Command]:
        """The path, from here."""
        return {LATERAL: path_command(self.here, self.course(), self.offsets, exact=self.exact)}

    def resolved(self, relative: RelativePath, points: tuple[Pose, ...]) -> Path:
        """The path through the points."""
        return Path(points, relative.interpolation)


class _OnTrajectory(_OnCourse[Trajectory, RelativeTrajectory]):
    def commands(self) -> dict[str, Command]:
        """The trajectory, from now."""
        return trajectory_commands(self.here, self.course(), self.offsets, exact=self.exact)

    def resolved(self, relative: RelativeTrajectory, points: tuple[Pose, ...]) -> Trajectory:
        """The trajectory through the points."""
        return Trajectory(points, relative.time_stamps, relative.interpolation)


@action("movable_object", "follow_path", slots=(LATERAL,))
class FollowPath(_OnPath):
    """Follow a path as the limits of the actor allow.

    Args:
        actor: Who.
        *modifiers: None are taken.
        absolute: The path.
        relative: Or a path relative to a reference, where that is at the start.
        reference: Default: the actor itself.
        transform: Frame of the relative points.
        start_offset: Metres of the path that are left out at its start.
        end_offset: Metres that are left out at its end.
        **options: Duration and label.
    """

    exact = False


@action("movable_object", "replay_path", slots=(LATERAL,))
class ReplayPath(_OnPath):
    """Be on a path exactly, whatever the limits; arguments as of `follow_path`."""

    exact = True


@action("movable_object", "follow_trajectory", slots=(LONGITUDINAL, LATERAL))
class FollowTrajectory(_OnTrajectory):
    """Follow a trajectory as the limits of the actor allow; late arrival is no failure.

    Args:
        actor: Who.
        *modifiers: None are taken.
        absolute: The trajectory; its times count from the start of the action.
        relative: Or one relative to a reference, where that is at the start.
        reference: Default: the actor itself.
        transform: Frame of the relative points.
        start_offset: Metres left out at the start: the action begins at their end, at once.
        end_offset: Metres that are left out at its end.
        **options: Duration and label.
    """

    exact = False


@action("movable_object", "replay_trajectory", slots=(LONGITUDINAL, LATERAL))
class ReplayTrajectory(_OnTrajectory):
    """Be on a trajectory at its times exactly; arguments as of `follow_trajectory`."""

    exact = True
