"""Modifiers of routes to follow and of conduct (DSL 8.9.11, 8.9.12, 8.9.17, 8.9.18)."""

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
from osc2tx_shared.rules import Sort

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
    """A path to move along, or a route of the map; then in its lanes, from wherever one is.

    Which of the lanes, `lane` and `lateral` may say beside a route; a path leaves no room for them.

    Attributes:
        route: The path or route.
        start_offset: Metres of it that are left out at its start.
        end_offset: Metres that are left out at its end.
        shape: Course of the metres along it, from its start.
    """

    shaped_by = AnyPositionShape
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
    """Starts on a piece of road, wherever there is room if nothing else says where.

    Attributes:
        path: The piece of road.
    """

    path: RoadPath


@modifier("avoid_collisions", slots=(LONGITUDINAL,))
@dataclass(frozen=True, slots=True)
class AvoidCollisions(Modifier):
    """Whether to slow down for obstacles ahead in the lane.

    The standard lets all actors avoid collisions; here they do so only where a scenario asks for
    it, because scenarios of near misses and crashes are what most people write.
    """

    avoid: Late[bool] = True


@modifier("tow_trailer", placement=True, needs=("towing",))
@dataclass(frozen=True, slots=True)
class TowTrailer(Modifier):
    """A trailer that is coupled from the start."""

    trailer: Towable
