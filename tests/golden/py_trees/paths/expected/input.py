"""Scenario `paths`.

Made by osc2tx from input.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Emit,
    Event,
    Map,
    OdrPoint,
    Parallel,
    Path,
    Point,
    Pose,
    RelativePathSt,
    RoutePoint,
    Scenario,
    Serial,
    Trailer,
    Vehicle,
    Wait,
    XyzPoint,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import along, along_trajectory, lane, position, speed, tow_trailer
from osc2tx_runtime.units import m, mps, s

require_api(1)


class Paths(Scenario):
    """Ways to go along, and a trailer."""

    name = "paths"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())
        self.other = self.cast("other", Vehicle())
        self.cart = self.cast("cart", Trailer())

        self.begin = self.argument("begin", Pose(x=110 * m, y=-8.75 * m))
        self.aside = self.argument("aside", Pose(x=150 * m, y=-7 * m))

        # Three ways to say the same
        self.spelled_out = self.argument(
            "spelled_out", Path(points=[self.begin, self.aside], interpolation="straight_line")
        )
        self.made = self.argument(
            "made", self.road.create_path([self.begin, self.aside], "straight_line")
        )
        self.kept = self.argument("kept", self.made)

        # On the road network
        self.first = self.argument("first", OdrPoint(road_id="1", lane_id="-3", s=180 * m))
        self.second = self.argument("second", self.road.create_odr_point("1", "-2", 260 * m, 0 * m))
        self.on_lanes = self.argument(
            "on_lanes", self.road.create_path_odr_points([self.first, self.second], "smooth", True)
        )

        # From where somebody is
        self.step = self.argument("step", RoutePoint(s=5 * m, t=0 * m))
        self.leap = self.argument("leap", RoutePoint(s=40 * m, t=1 * m))
        self.onward = self.argument(
            "onward", RelativePathSt(points=[self.step, self.leap], interpolation="smooth")
        )
        self.in_time = self.argument(
            "in_time",
            self.road.create_trajectory([self.begin, self.aside], [0 * s, 4 * s], "straight_line"),
        )
        self.ahead = self.argument("ahead", Pose(x=330 * m, y=-8.75 * m))
        self.beyond = self.argument("beyond", Pose(x=390 * m, y=-8.75 * m))
        self.corner = self.argument("corner", XyzPoint(position=Point(x=400 * m, y=-8.75 * m)))

        self.near_the_corner = Event()

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(
            self.ego, tow_trailer(trailer=self.cart), lane(1), position(100 * m), speed(10 * mps)
        )
        self.place(self.other, along_trajectory(trajectory=self.in_time))

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self._ego_follow_path_then_disconnect_trailer(),
            self._other_replay_trajectory_serial(),
        )

    def _ego_follow_path_then_disconnect_trailer(self) -> Behaviour:
        return Serial(
            "ego: serial",
            self.ego.follow_path(absolute=self.spelled_out),
            self.ego.follow_path(absolute=self.on_lanes),
            self.ego.follow_path(relative=self.onward, transform="lane_relative"),
            self.ego.disconnect_trailer(),
            self.ego.drive(
                along(self.road.create_path([self.ahead, self.beyond], "straight_line"))
            ),
        )

    def _other_replay_trajectory_serial(self) -> Behaviour:
        return Serial(
            "other: serial",
            self.other.replay_trajectory(absolute=self.in_time),
            Wait(lambda: self.other.distance_to_xyz_point(self.corner, "longitudinal") < 250 * m),
            Emit(self.near_the_corner),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Paths().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Paths))
