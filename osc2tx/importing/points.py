"""Points, poses and routes as texts of the language, and their declarations."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import field

from osc2tx.importing.dimensions import LENGTH, literal, short
from osc2tx.importing.names import Names
from osc2tx.importing.program import Declared
from osc2tx.importing.starting import wrapped
from osc2tx.importing.statements import Call, call
from osc2tx_runtime.opendrive import LanePosition
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
        self._declared: dict[tuple[str | float, ...], str] = {}

    def point(self, x: float, y: float, name: str) -> str:
        """Return the name of a point in the world."""
        place = [round(value, 6) for value in (x, y, 0.0)]
        key: tuple[str | float, ...] = ("point", *place)
        if key not in self._declared:
            made = self._names.new("", kind="point", base=f"{name}_point")
            told = [
                f"it.{axis} == {literal(v, LENGTH)}" for axis, v in zip("xyz", place, strict=True)
            ]
            self.declared.append(Declared(made, "position_3d", [" and ".join(told)]))
            self._declared[key] = made
        return self._declared[key]

    def orientation(self, h: float, name: str) -> str:
        """Return the name of an orientation with a heading (rad) in the world."""
        key = ("orientation", round(math.degrees(h), 6), 0.0)
        if key not in self._declared:
            made = self._names.new("", kind="point", base=f"{name}_orientation")
            told = f"it.yaw == {degrees(h)} and it.pitch == 0deg and it.roll == 0deg"
            self.declared.append(Declared(made, "orientation_3d", [told]))
            self._declared[key] = made
        return self._declared[key]

    def goal(self, x: float, y: float, z: float, name: str) -> str:
        """Return the name of a point in the world whose distance is measured."""
        place = [round(value, 6) for value in (x, y, z)]
        key: tuple[str | float, ...] = ("goal", *place)
        if key not in self._declared:
            made = self._names.new("", kind="point", base=f"{name}_goal")
            at = ", ".join(literal(value, LENGTH) for value in place)
            self.declared.append(Declared(made, "xyz_point", value=f"road.create_xyz_point({at})"))
            self._declared[key] = made
        return self._declared[key]

    def pose(self, x: float, y: float, name: str) -> str:
        """Return the name of a pose in the world, of a corner of a path."""
        made = self._names.new("", kind="point", base=f"{name}_pose")
        told = [
            f"it.position.{axis} == {literal(round(v, 6), LENGTH)}"
            for axis, v in zip("xyz", (x, y, 0.0), strict=True)
        ]
        self.declared.append(Declared(made, "pose_3d", [" and ".join(told)]))
        return made

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
        """Return the name of a path or trajectory along the road from where an actor is.

        Args:
            kind: `path` or `trajectory`.
            corners: Its points; their s counts from the actor.
            stamps: Times of the corners of a trajectory.
            name: The actor.
        """
        return self._relative(f"relative_{kind}_odr", corners, stamps, f"{name}_{kind}")

    def _relative(
        self, type_name: str, corners: Sequence[str], stamps: Sequence[str], base: str
    ) -> str:
        made = self._names.new("", kind="point", base=base)
        told = [f"it.points == [{', '.join(corners)}]", "it.interpolation == straight_line"]
        if stamps:
            told.append(f"it.time_stamps == [{', '.join(stamps)}]")
        self.declared.append(Declared(made, type_name, told))
        return made

    def route(self, stops: Sequence[LanePosition], name: str) -> str:
        """Return the name of a route for an actor."""
        made = self._names.new("", kind="route", base=f"{name}_way")
        points = ", ".join(
            odr_point(each.road, str(each.lane), literal(each.s, LENGTH), "0m") for each in stops
        )
        self.declared.append(Declared(made, "route", value=f"road.create_route([{points}])"))
        return made
