"""Projection of geodetic points to the map (DSL 8.12.28)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from osc2tx_runtime.domain.points_and_poses import GeodeticPoint
from osc2tx_runtime.errors import PlacementError
from osc2tx_runtime.opendrive import GeoReferenceError, Pose, RoadMap
from osc2tx_runtime.world.motion.moving_body import ANY_LANE

if TYPE_CHECKING:
    from osc2tx_runtime.language.scenario_parts import ScenarioParts


def place_of_geodetic(road_map: RoadMap, point: GeodeticPoint) -> Pose:
    """Position of a point on the globe, at its height above the nearest road.

    Raises:
        PlacementError: The map has no georeference.
    """
    try:
        x, y = road_map.geo_reference.project(point.latitude, point.longitude)
    except GeoReferenceError as error:
        raise PlacementError(f"map {road_map.name} cannot locate the point: {error}") from error
    on = road_map.locate(x, y, lane_types=ANY_LANE)
    height = 0.0 if on is None else road_map.pose(on).z
    return Pose(x, y, height + point.altitude, 0.0)


def check_globe(scenario: ScenarioParts, road_map: RoadMap) -> None:
    """Checks that the geodetic points of a scenario can be projected to its map.

    Raises:
        PlacementError: A point cannot be projected.
    """
    for name, value in vars(scenario).items():
        if isinstance(value, GeodeticPoint):
            try:
                place_of_geodetic(road_map, value)
            except PlacementError as error:
                raise PlacementError(f"{name}: {error.message}", scenario.source) from error
