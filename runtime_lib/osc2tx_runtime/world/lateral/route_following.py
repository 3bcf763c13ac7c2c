"""Route following over the lane graph: branches at forks, the end of the road."""

from __future__ import annotations

from osc2tx_runtime.opendrive import LanePosition, RoadMap, Route
from osc2tx_runtime.world.commands import FollowRoute
from osc2tx_runtime.world.protocol import PENDING, REACHED, Progress


class Way:
    """A route that an actor follows.

    Args:
        command: The command.
        road_map: The map.
        before: The previous route.

    Attributes:
        route: The present route, which decides at forks.
        before: The previous route, for the time after it.
        ends: As of the command.
    """

    def __init__(self, command: FollowRoute, road_map: RoadMap, before: Route | None) -> None:
        self.route = road_map.route_to(command.goal)
        self.before = before
        self.ends = command.ends
        self._progress = PENDING

    def look(self, place: LanePosition, along: float) -> None:
        """Updates the distance to the end, before a step of a length (m).

        After the end is passed it remains reached.
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
        """Done at the end of the route; failed when the end can no longer be reached."""
        return self._progress
