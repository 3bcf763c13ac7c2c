"""The mesh of a level below the lanes: OpenDRIVE and mesh may be of different heights."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from osc2tx_runtime.errors import SimulatorError
from osc2tx_runtime.opendrive import Pose, RoadMap
from osc2tx_runtime.world.plant.scene import Setpoint

from .client_process import ClientProcess

FROM = 2.0
"""Metres above a lane from where the ground is looked for."""

FLOATS = 0.1
"""Metres between lane and ground that one can see."""


def heights_of(client: ClientProcess, poses: Sequence[Pose]) -> Sequence[float | None]:
    """Return how far (m) the ground is above each pose; None where there is none."""
    found = client.ask("ground", [(pose.x, -pose.y, pose.z + FROM) for pose in poses])
    pairs = zip(found, poses, strict=True)
    return [None if height is None else height - pose.z for height, pose in pairs]


def floating(
    client: ClientProcess, setpoints: Mapping[str, Setpoint], road_map: RoadMap
) -> Iterator[str]:
    """Yield a line for each actor that the mesh has float or sink where it starts.

    Args:
        client: A connected one.
        setpoints: Of the actors that are where the scenario says, whatever is below them.
        road_map: The map of the scenario.
    """
    places = {
        actor: setpoint.state.lane_position
        for actor, setpoint in setpoints.items()
        if setpoint.state.lane_position is not None
    }
    try:
        heights = heights_of(client, [road_map.pose(place) for place in places.values()])
    except SimulatorError as error:  # no reason to end a run
        yield f"whether actors float is unknown: {error.message}"
        return
    for actor, height in zip(places, heights, strict=True):
        if height is not None and abs(height) > FLOATS:
            does, where = ("sinks", "above") if height > 0.0 else ("floats", "below")
            yield (
                f"{actor} {does}: the ground of CARLA is {abs(height):.2f} m {where} the lane where"
                " it starts"
            )
