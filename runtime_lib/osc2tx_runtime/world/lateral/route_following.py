"""Route following over the lane graph: branches at forks, the end of the road."""

from __future__ import annotations

from osc2tx_runtime.opendrive import LanePosition, RoadMap, Route
from osc2tx_runtime.world.commands import FollowRoute
from osc2tx_runtime.world.protocol import PENDING, REACHED, Progress


class Way:
    """A route that an actor goes along.

    Args:
        command: Where to.
        road_map: The map.
        before: What decided at forks before.

    Attributes:
        route: What decides at forks now.
        before: Likewise, once the actor goes along it no more.
        ends: As of the command.
    """

    def __init__(self, command: FollowRoute, road_map: RoadMap, before: Route | None) -> None:
        self.route = road_map.route_to(command.goal)
        self.before = before
        self.ends = command.ends
        self._progress = PENDING

    def look(self, place: LanePosition, along: float) -> None:
        """Updates the distance to the end, before a step of a length (m).

        An actor that has passed the end has reached it for good.
        """
        if self._progress.done:
            return
        left = self.route.distance(place)
        if left is None:
            self._progress = Progress(
                False,
                f"no lane leads from lane {place.lane} of road {place.road} to the end of its"
                " route",
            )
        elif left <= along + 1e-6:
            self._progress = REACHED

    def progress(self) -> Progress:
        """Done at the end of the route; failed when it cannot be reached any more."""
        return self._progress
