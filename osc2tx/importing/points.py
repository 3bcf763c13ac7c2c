"""Points, poses and routes as texts of the language, and their declarations."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import field

from osc2tx.importing.dimensions import LENGTH, literal, short
from osc2tx.importing.ground import wrapped
from osc2tx.importing.names import Names
from osc2tx.importing.program import Declared
from osc2tx.importing.statements import Call, call
from osc2tx_runtime.opendrive import LanePosition, RoadMap
from osc2tx_shared.classes import dataclass


@dataclass
class Spot:
    """A place in the language.

    Attributes:
        odr_point: A point of the map; `""`: it is none.
        position: The name of a point in the world; `""`: it is none.
        modifiers: Modifiers that say it, without their `at`.
        yaw: A modifier for the heading, where it is not that of the lane.
        turned: The name of an orientation against the lane, if that is the heading.
    """

    odr_point: str = ""
    position: str = ""
    modifiers: list[str] = field(default_factory=list)
    yaw: str = ""
    turned: str = ""

    def assigned_to(self, actor: str) -> Call:
        """Return the invocation that puts an actor there, with the modifiers."""
        if self.odr_point:
            return call(actor, "assign_position", odr_point=self.odr_point)
        told = {"position": self.position} if self.position else {}
        return call(actor, "assign_position", **told)


def odr_point(road: str, lane: str, s: str, t: str) -> str:
    """Return a point of the map, in a lane or, without one, at a distance from the road."""
    return f'road.create_odr_point("{road}", "{lane}", {s}, {t})'


def point_of(place: LanePosition, road_map: RoadMap) -> str:
    """Return the point of the map at a place in a lane."""
    t = place.offset * road_map.travel_direction(place.road, place.lane)
    at = literal(place.s, LENGTH), literal(t, LENGTH)
    return odr_point(place.road, str(place.lane), *at)


def lane_beside(reference: str, lanes: int) -> str:
    """Return the modifier for a lane by that of another actor, counted to the left."""
    if lanes == 0:
        return f"lane(same_as: {reference})"
    count = "" if abs(lanes) == 1 else f"{abs(lanes)}, "
    return f"lane({count}side_of: {reference}, side: {'left' if lanes > 0 else 'right'})"


def heading_of(h: float) -> str:
    """Return the modifier for a heading (rad) in the world."""
    return f"orientation(yaw: {degrees(h)}, measure_by: absolute)"


def degrees(h: float) -> str:
    """Return a heading (rad) between half turns, without the rounding of numbers in radians."""
    found = round(math.degrees(wrapped(h)), 6)
    return f"{short(180.0 if found == -180.0 else found)}deg"


class Points:
    """Points of the world, poses and routes, which are declared.

    Attributes:
        declared: Their declarations.
    """

    def __init__(self, names: Names) -> None:
        self._names = names
        self.declared: list[Declared] = []
        self._declared: dict[tuple[str, str, str], str] = {}

    def point(self, x: float, y: float, name: str) -> str:
        """Return the name of a point in the world."""
        told = " and ".join(f"it.{each}" for each in _coordinates(x, y))
        return self._once(f"{name}_point", "position_3d", told)

    def orientation(self, h: float, name: str) -> str:
        """Return the name of an orientation with a heading (rad) in the world."""
        told = f"it.yaw == {degrees(h)} and it.pitch == 0deg and it.roll == 0deg"
        return self._once(f"{name}_orientation", "orientation_3d", told)

    def goal(self, x: float, y: float, z: float, name: str) -> str:
        """Return the name of a point in the world whose distance is measured."""
        at = ", ".join(_metres(each) for each in (x, y, z))
        return self._once(f"{name}_goal", "xyz_point", value=f"road.create_xyz_point({at})")

    def pose(self, x: float, y: float, name: str) -> str:
        """Return the name of a pose in the world, of a corner of a path."""
        told = " and ".join(f"it.position.{each}" for each in _coordinates(x, y))
        return self._declare(f"{name}_pose", "pose_3d", told)

    def relative(
        self, kind: str, offsets: Sequence[tuple[float, float]], stamps: Sequence[str], name: str
    ) -> str:
        """Return the name of a path or trajectory from where an actor is.

        Args:
            kind: `path` or `trajectory`.
            offsets: Its corners ahead and to the left (m).
            stamps: Times of the corners of a trajectory.
            name: The actor.
        """
        corners = [self.pose(*each, name) for each in offsets]
        return self._relative(f"relative_{kind}_pose_3d", corners, stamps, f"{name}_{kind}")

    def relative_on_road(
        self, kind: str, corners: Sequence[str], stamps: Sequence[str], name: str
    ) -> str:
        """Return the name of a path or trajectory along the road; s counts from the actor."""
        return self._relative(f"relative_{kind}_odr", corners, stamps, f"{name}_{kind}")

    def _relative(
        self, type_name: str, corners: Sequence[str], stamps: Sequence[str], base: str
    ) -> str:
        told = [f"it.points == [{', '.join(corners)}]", "it.interpolation == straight_line"]
        if stamps:
            told.append(f"it.time_stamps == [{', '.join(stamps)}]")
        return self._declare(base, type_name, *told)

    def route(self, stops: Sequence[LanePosition], name: str) -> str:
        """Return the name of a route for an actor."""
        places = ((each.road, str(each.lane), literal(each.s, LENGTH)) for each in stops)
        points = ", ".join(odr_point(*each, "0m") for each in places)
        return self._declare(f"{name}_way", "route", value=f"road.create_route([{points}])")

    def _declare(self, base: str, type_name: str, *told: str, value: str = "") -> str:
        """Return the name of a new declaration."""
        made = self._names.new("", kind="point", base=base)
        self.declared.append(Declared(made, type_name, list(told), value))
        return made

    def _once(self, base: str, type_name: str, told: str = "", value: str = "") -> str:
        """Return the name of a declaration, which actors at the same place share."""
        key = type_name, told, value
        if key not in self._declared:
            constraints = (told,) if told else ()
            self._declared[key] = self._declare(base, type_name, *constraints, value=value)
        return self._declared[key]


def _metres(value: float) -> str:
    return literal(round(value, 6), LENGTH)


def _coordinates(x: float, y: float) -> list[str]:
    """Return the constraints on the coordinates of a point on the ground."""
    return [f"x == {_metres(x)}", f"y == {_metres(y)}", "z == 0m"]
