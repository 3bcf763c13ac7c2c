"""Modifiers of routes and conduct (DSL 8.9.11, 8.9.12, 8.9.17, 8.9.18)."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from osc2tx_runtime.domain.modifiers.base import (
    Late,
    Modifier,
    MovementModifier,
    Value,
    now,
)
from osc2tx_runtime.domain.modifiers.registry import modifier
from osc2tx_runtime.domain.shapes import AnyPositionShape, OwnShape
from osc2tx_runtime.enums import MovementOptions
from osc2tx_runtime.language.actions.modifier import COURSE, LANE, SIDE
from osc2tx_runtime.language.actions.registry import LATERAL, LONGITUDINAL
from osc2tx_shared.classes import dataclass
from osc2tx_shared.rules import Sort, at_least

if TYPE_CHECKING:
    from osc2tx_runtime.domain.map.roads_and_lanes import RoadPath, Route
    from osc2tx_runtime.domain.objects.parts import Towable
    from osc2tx_runtime.domain.paths.path_values import Path, Trajectory

__all__ = [
    "Along",
    "AlongTrajectory",
    "AvoidCollisions",
    "OnPath",
    "PhysicalMovement",
    "TowTrailer",
]


@modifier("physical_movement")
@dataclass(frozen=True, slots=True)
class PhysicalMovement(Modifier):
    """Whether a quantity may jump to its value."""

    option: MovementOptions = "must_be_physical"


@modifier(
    "along",
    slots=(LATERAL,),
    excludes=("along_trajectory", "orientation", "yaw"),
    sorts=(
        Sort("course along a path", given=("route",), value="path", excludes=(LANE, SIDE)),
        Sort(
            "course along a route",
            given=("shape",),
            excludes=(COURSE, "speed", "keep_speed", "acceleration", "distance"),
        ),
    ),
    placement=True,
    places=True,
    bounds=True,
)
@dataclass(frozen=True, slots=True)
class Along(MovementModifier):
    """A path, or a route of the map followed in its lanes from the present position.

    Beside a route, `lane` and `lateral` may choose the lane; they contradict a path.

    Attributes:
        route: The path or route.
        start_offset: Metres to omit at its start.
        end_offset: Metres to omit at its end.
        shape: Profile of the distance along it, from its start.
    """

    shaped_by = AnyPositionShape
    rules = (at_least(0, "start_offset", "end_offset"),)
    route: Path | Route | Callable[[], Path | Route]
    start_offset: Value = 0.0
    end_offset: Value = 0.0
    shape: AnyPositionShape | OwnShape[AnyPositionShape] | None = None

    @property
    def way(self) -> Path | Route:
        """The path or route now."""
        late: Any = self.route  # of a union `now` cannot tell which part it returns
        found: Path | Route = now(late)
        return found


@modifier(
    "along_trajectory",
    slots=(LONGITUDINAL, LATERAL),
    topics=(COURSE, LANE, SIDE),
    no_start="does not take effect at the start; use position(at: start)",
    placement=True,
    places=True,
    paces=True,
    bounds=True,
)
@dataclass(frozen=True, slots=True)
class AlongTrajectory(MovementModifier):
    """A trajectory to move along; offsets as for `along`."""

    rules = (at_least(0, "start_offset", "end_offset"),)
    trajectory: Trajectory | Callable[[], Trajectory]
    start_offset: Value = 0.0
    end_offset: Value = 0.0


@modifier(
    "on_path",
    placement=True,
    needs=("map",),
    undeclared="what `drive(path)` and `walk(path)` of dialect `carla` become",
)
@dataclass(frozen=True, slots=True)
class OnPath(Modifier):
    """Starts on a piece of road, at the first free position unless another modifier states it.

    Attributes:
        path: The piece of road.
    """

    path: RoadPath


@modifier("avoid_collisions", slots=(LONGITUDINAL,))
@dataclass(frozen=True, slots=True)
class AvoidCollisions(Modifier):
    """Whether to slow down for obstacles ahead in the lane.

    In the standard all actors avoid collisions. Here they do so only if a scenario requires it,
    because most scenarios describe near misses and crashes.
    """

    avoid: Late[bool] = True


@modifier("tow_trailer", placement=True, needs=("towing",))
@dataclass(frozen=True, slots=True)
class TowTrailer(Modifier):
    """A trailer that is coupled from the start."""

    trailer: Towable
