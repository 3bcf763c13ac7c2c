"""The mesh of a level below the lanes: OpenDRIVE and mesh may differ in height."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from osc2tx_runtime.errors import SimulatorError
from osc2tx_runtime.opendrive import Pose, RoadMap
from osc2tx_runtime.world.plant.scene import Setpoint

from .client_process import ClientProcess

FROM = 2.0
"""Height (m) above a lane at which the search for ground begins."""

FLOATS = 0.1
"""Visible distance (m) between lane and ground."""


def heights_of(client: ClientProcess, poses: Sequence[Pose]) -> Sequence[float | None]:
    """Return the height (m) of the ground above each pose; None without ground."""
    found = client.ask("ground", [(pose.x, -pose.y, pose.z + FROM) for pose in poses])
    pairs = zip(found, poses, strict=True)
    return [None if height is None else height - pose.z for height, pose in pairs]


def floating(
    client: ClientProcess, setpoints: Mapping[str, Setpoint], road_map: RoadMap
) -> Iterator[str]:
    """Yield a line for each actor that floats above or sinks into the mesh at its start.

    Args:
        client: A connected session.
        setpoints: Setpoints of the actors at their stated heights.
        road_map: The map of the scenario.
    """
    places = {
        actor: setpoint.state.lane_position
        for actor, setpoint in setpoints.items()
        if setpoint.state.lane_position is not None
    }
    try:
        heights = heights_of(client, [road_map.pose(place) for place in places.values()])
    except SimulatorError as error:  # not a reason to end a run
        yield f"whether actors float is unknown: {error.message}"
        return
    for actor, height in zip(places, heights, strict=True):
        if height is not None and abs(height) > FLOATS:
            does, where = ("sinks", "above") if height > 0.0 else ("floats", "below")
            yield (
                f"{actor} {does}: the ground of CARLA is {abs(height):.2f} m {where} the lane where"
                " it starts"
            )
