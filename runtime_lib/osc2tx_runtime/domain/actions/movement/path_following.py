"""Actions along paths and trajectories (DSL 8.8.2.8, 8.8.2.9, 8.8.2.16, 8.8.2.17).

A vehicle leaves its lane for the path and returns to the nearest lane after its end. Along a path
the speed is free: it remains, or another action controls it; from standstill it becomes `CRUISE`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, ClassVar, Generic, TypeVar, Unpack

from osc2tx_runtime.domain.modifiers import (
    Along,
    AlongTrajectory,
    Modifier,
    PhysicalMovement,
    Value,
    value_of,
)
from osc2tx_runtime.domain.modifiers.base import now
from osc2tx_runtime.domain.modifiers.groups import SPEED_FREE
from osc2tx_runtime.domain.paths.path_values import (
    Path,
    RelativePath,
    RelativeTrajectory,
    Trajectory,
)
from osc2tx_runtime.domain.paths.relative_paths import absolute
from osc2tx_runtime.domain.placing.pose_resolution import one_of_kind
from osc2tx_runtime.domain.planning.motion_action import Refused
from osc2tx_runtime.domain.planning.path_commands import (
    begin_of,
    path_command,
    trajectory_commands,
)
from osc2tx_runtime.domain.points_and_poses import Pose
from osc2tx_runtime.enums import RelativeTransform
from osc2tx_runtime.language.actions.action import ActionOptions
from osc2tx_runtime.language.actions.registry import LATERAL, LONGITUDINAL, action
from osc2tx_runtime.world.commands import Command
from osc2tx_shared.rules import at_least, at_least_one, at_most_one

from .modifiable import ModifiableAction

if TYPE_CHECKING:
    from osc2tx_runtime.domain.actors import MovableObject
    from osc2tx_runtime.domain.objects.physical_objects import PhysicalObject

_AWAY = 0.5  # m between the start of the actor and that of its course


class CourseAction(ModifiableAction):
    """An action along a path that may prove impossible when it starts."""

    def on_start(self) -> None:
        """Commands the course."""
        commands = self.commands()
        if self.context.step == 0 and self.actor.id in self.context.open_starts:
            self._check_start(commands.values())
        for slot, command in commands.items():
            self.command(slot, command)

    def _check_start(self, commands: Iterable[Command]) -> None:
        """Check that an actor without a stated start starts the run where its replay begins.

        Others are set there, as the standard allows (DSL 8.8.2.8).

        Raises:
            Refused: It starts elsewhere.
        """
        for x, y, _ in filter(None, map(begin_of, commands)):
            far = math.hypot(x - self.here.x, y - self.here.y)
            if far > _AWAY:
                raise Refused(
                    f"its course begins at ({x:.1f}, {y:.1f}), {far:.1f} m from where it starts;"
                    " state its position at the start"
                )

    def commands(self) -> dict[str, Command]:
        """The command for each slot.

        Raises:
            PathError: The path does not exist.
            PlacementError: The position does not exist.
        """
        raise NotImplementedError


CourseT = TypeVar("CourseT", bound=Path | Trajectory)
RelativeT = TypeVar("RelativeT", bound=RelativePath | RelativeTrajectory)


class _OnCourse(CourseAction, Generic[CourseT, RelativeT]):
    """Common base of paths and trajectories: absolute, or relative to a reference."""

    rules = (
        at_most_one("absolute", "relative"),
        at_least_one("absolute", "relative"),
        at_least(0, "start_offset", "end_offset"),
    )
    replays: ClassVar[bool]

    @property
    def jumps_if_it_must(self) -> bool:
        """Whether it is a replay."""
        return self.option() == "prefer_non_physical"

    def option(self) -> str:
        """The option of `physical_movement`; a replay without it need not be physical."""
        physical = one_of_kind(self.modifiers, PhysicalMovement)
        if physical is None and self.replays:
            return "prefer_non_physical"
        return super().option()

    def __init__(
        self,
        actor: MovableObject,
        *modifiers: Modifier,
        absolute: CourseT | Callable[[], CourseT] | None = None,
        relative: RelativeT | Callable[[], RelativeT] | None = None,
        reference: PhysicalObject | None = None,
        transform: RelativeTransform = "object_relative",
        start_offset: Value = 0.0,
        end_offset: Value = 0.0,
        **options: Unpack[ActionOptions],
    ) -> None:
        super().__init__(actor, *modifiers, **options)
        self.absolute: CourseT | Callable[[], CourseT] | None = absolute
        self.relative: RelativeT | Callable[[], RelativeT] | None = relative
        self.reference = reference or actor
        self.transform: RelativeTransform = transform
        self._offsets = (start_offset, end_offset)

    @property
    def offsets(self) -> tuple[float, float]:
        """Metres to omit at the start and at the end, now."""
        return value_of(self._offsets[0]), value_of(self._offsets[1])

    def course(self) -> CourseT:
        """The path or trajectory in the world, now."""
        if self.absolute is not None:
            return now(self.absolute)
        assert self.relative is not None
        relative, reference = now(self.relative), self.world.state(self.reference.id)
        # The points of a trajectory have times of their own: there are none between them.
        way = relative.interpolation if isinstance(relative, RelativePath) else "straight_line"
        points = absolute(self.world.map, relative.points, reference, self.transform, way)
        return self.resolved(relative, points)

    def resolved(self, relative: RelativeT, points: tuple[Pose, ...]) -> CourseT:
        """The path or trajectory with its points in world coordinates."""
        raise NotImplementedError


class _OnPath(_OnCourse[Path, RelativePath]):
    accepts: ClassVar[tuple[type, ...]] = SPEED_FREE

    def states_itself(self) -> tuple[Modifier, ...]:
        """The actor starts at the beginning of an absolute path."""
        if self.absolute is None:
            return ()
        return (Along(self.absolute, start_offset=self._offsets[0]),)

    def commands(self) -> dict[str, Command]:
        """The path, from the present position."""
        return {
            LATERAL: path_command(
                self.world.map, self.here, self.course(), self.offsets, exact=self.may_jump
            )
        }

    def resolved(self, relative: RelativePath, points: tuple[Pose, ...]) -> Path:
        """The path through the points."""
        return Path(points, relative.interpolation)


class _OnTrajectory(_OnCourse[Trajectory, RelativeTrajectory]):
    accepts: ClassVar[tuple[type, ...]] = (PhysicalMovement,)

    def states_itself(self) -> tuple[Modifier, ...]:
        """The actor starts at the beginning of an absolute trajectory, with its speed there."""
        if self.absolute is None:
            return ()
        return (AlongTrajectory(self.absolute, start_offset=self._offsets[0]),)

    def commands(self) -> dict[str, Command]:
        """The trajectory, from the present time."""
        return trajectory_commands(
            self.world.map, self.here, self.course(), self.offsets, exact=self.may_jump
        )

    def resolved(self, relative: RelativeTrajectory, points: tuple[Pose, ...]) -> Trajectory:
        """The trajectory through the points."""
        return Trajectory(points, relative.time_stamps, relative.interpolation)


@action("movable_object", "follow_path", slots=(LATERAL,), places=True)
class FollowPath(_OnPath):
    """Follow a path as the limits of the actor allow.

    Args:
        actor: The actor.
        *modifiers: Modifiers of the speed.
        absolute: The path.
        relative: Or a path relative to the pose of a reference at the start.
        reference: Default: the actor itself.
        transform: Frame of the relative points.
        start_offset: Metres of the path to omit at its start.
        end_offset: Metres to omit at its end.
        **options: Duration and label.
    """

    replays = False


@action("movable_object", "replay_path", slots=(LATERAL,), places=True)
class ReplayPath(_OnPath):
    """Follow a path exactly, whatever the limits; arguments as of `follow_path`."""

    replays = True


@action("movable_object", "follow_trajectory", slots=(LONGITUDINAL, LATERAL), places=True)
class FollowTrajectory(_OnTrajectory):
    """Follow a trajectory as the limits of the actor allow; late arrival is not a failure.

    Args:
        actor: The actor.
        *modifiers: Only `physical_movement`.
        absolute: The trajectory; its times count from the start of the action.
        relative: Or a trajectory relative to the pose of a reference at the start.
        reference: Default: the actor itself.
        transform: Frame of the relative points.
        start_offset: Metres to omit at the start: the action begins at their end, instantly.
        end_offset: Metres to omit at its end.
        **options: Duration and label.
    """

    replays = False


@action("movable_object", "replay_trajectory", slots=(LONGITUDINAL, LATERAL), places=True)
class ReplayTrajectory(_OnTrajectory):
    """Follow a trajectory exactly in position and time; arguments as of `follow_trajectory`."""

    replays = True
