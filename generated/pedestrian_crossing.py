"""Scenario `pedestrian_crossing`.

A pedestrian crosses the road in front of the ego vehicle, which brakes, waits and drives on.

Made by osc2tx from pedestrian_crossing.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Emit,
    Event,
    Map,
    Parallel,
    Person,
    Point,
    Scenario,
    Serial,
    Until,
    Vehicle,
    Wait,
    main,
    require_api,
    rise,
)
from osc2tx_runtime.modifiers import lane, position, speed, yaw
from osc2tx_runtime.units import deg, kph, m, mps, s

require_api(1)


class PedestrianCrossing(Scenario):
    name = "pedestrian_crossing"
    source = "pedestrian_crossing.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="crossing.xodr"))
        self.ego = self.cast("ego", Vehicle())
        self.walker = self.cast("walker", Person())

        # On the right sidewalk, in the middle of the road
        self.curb = self.argument("curb", Point(x=250 * m, y=-5 * m, z=0 * m))

        self.v_ego = self.parameter("v_ego", 40 * kph, unit="kph")
        self.v_walk = self.parameter("v_walk", 1.4 * mps, unit="mps")

        self.crossing_started = Event()
        self.road_is_free = Event()

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.walker, position(at_point=self.curb, project_on_route=False), yaw(90 * deg))
        self.place(self.ego, lane(1), position(120 * m), speed(self.v_ego))

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.walker_part(),
            self.ego_part(),
        )

    def walker_part(self) -> Behaviour:
        return Serial(
            "walker_part",
            Until(
                self.walker.remain_stationary("wait_at_curb"),
                rise(
                    lambda: self.walker.object_distance(reference=self.ego, direction="euclidean")
                    < 45 * m
                ),
            ),
            Emit(self.crossing_started),
            self.walker.walk("cross", speed(self.v_walk), duration=8 * s),
            Emit(self.road_is_free),
            self.walker.remain_stationary(),
        )

    def ego_part(self) -> Behaviour:
        return Serial(
            "ego_part",
            Until(
                self.ego.drive("approach", speed(self.v_ego)),
                self.crossing_started,
            ),
            self.ego.change_speed("brake", target=0 * kph, rate_profile="smooth"),
            Wait(self.road_is_free),
            self.ego.change_speed(target=self.v_ego, rate_profile="smooth"),
            self.ego.drive("leave", speed(self.v_ego), duration=5 * s),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return PedestrianCrossing().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(PedestrianCrossing))
