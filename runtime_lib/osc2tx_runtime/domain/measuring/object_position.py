"""State of an object, and its distances to others along and across the road."""

from __future__ import annotations

from typing import TYPE_CHECKING

from osc2tx_runtime.domain.points_and_poses import Point
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.world.measuring.distances import along_lanes, lateral_on_road
from osc2tx_runtime.world.measuring.measured import Measured
from osc2tx_runtime.world.state import ActorState

if TYPE_CHECKING:
    from osc2tx_runtime.language.context import ExecutionContext
    from osc2tx_runtime.opendrive import RoadMap


class MeasuredObject:
    """An object with a state in the world, and its distances along and across the road."""

    id: str

    @property
    def context(self) -> ExecutionContext:
        """The run."""
        raise NotImplementedError

    @property
    def state(self) -> ActorState:
        """Snapshot of the present step."""
        return self.context.world.state(self.id)

    def _distance_along(self, reference: MeasuredObject) -> float:
        """Route distance (m) to the reference, positive if it is ahead."""
        world = self.context.world
        return self._way(world.map, world.state(self.id), reference, world.state(reference.id))

    def _way(
        self, road_map: RoadMap, me: ActorState, reference: MeasuredObject, there: ActorState
    ) -> float:
        """Route distance (m) from one state to that of the reference."""
        along = along_lanes(road_map, me, there)
        if along is None:
            raise self._no_way(reference)
        return along

    def _distance_across(self, reference: MeasuredObject) -> float:
        """Distance (m) of the reference to the left."""
        lateral = lateral_on_road(self.context.world.map, self.state, reference.state)
        if lateral is None:
            raise self._no_way(reference)
        return lateral

    def _no_way(self, reference: MeasuredObject) -> ScenarioError:
        return ScenarioError(
            f"no lane leads from {self.id} to {reference.id} or back, so they have no distance"
            " along the road"
        )


class RoutePosition:
    """Position of an object, with its relation to others along the road."""

    __slots__ = ("_object",)

    def __init__(self, of: MeasuredObject) -> None:
        self._object = of

    def ahead_of(self, reference: MeasuredObject) -> float:
        """Distance (m) ahead of another object along the road; negative if behind."""
        return Measured(-self._object._distance_along(reference))

    def behind(self, reference: MeasuredObject) -> float:
        """Distance (m) behind another object along the road; negative if ahead."""
        return Measured(self._object._distance_along(reference))

    @property
    def x(self) -> float:
        """World x (m)."""
        return Measured(self._object.state.x)

    @property
    def y(self) -> float:
        """World y (m)."""
        return Measured(self._object.state.y)

    @property
    def z(self) -> float:
        """World z (m)."""
        return Measured(self._object.state.z)

    def norm(self) -> float:
        """Distance from the world's origin (m)."""
        return Measured(Point(self.x, self.y, self.z).norm())
