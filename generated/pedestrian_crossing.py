"""Scenario `pedestrian_crossing`.

A pedestrian crosses the road in front of the ego vehicle, which brakes, waits and drives on.

Made by osc2tx from pedestrian_crossing.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam; `one_of` is a race.
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
    """Scenario `pedestrian_crossing` (pedestrian_crossing.osc:6)."""

    name = "pedestrian_crossing"
    source = "pedestrian_crossing.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = Map(map_file="crossing.xodr")
        self.ego = Vehicle()
        self.walker = Person()

        # On the right sidewalk, in the middle of the road
        self.curb = Point(x=250 * m, y=-5 * m, z=0 * m)
        self.v_ego = self.parameter("v_ego", 40 * kph)
        self.v_walk = self.parameter("v_walk", 1.4 * mps)
        self.crossing_started = Event()
        self.road_is_free = Event()

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.walker, position(at_point=self.curb, project_on_route=False), yaw(90 * deg))
        self.place(self.ego, lane(1), position(120 * m), speed(self.v_ego))

    def behavior(self) -> Behaviour:  # pedestrian_crossing.osc:24
        return Parallel(
            "pedestrian_crossing",
            self.walker_part(),
            self.ego_part(),
        )

    def walker_part(self) -> Behaviour:  # pedestrian_crossing.osc:25
        return Serial(
            "walker_part",
            Until(
                self.walker.remain_stationary(),
                rise(
                    lambda: self.walker.object_distance(reference=self.ego, direction="euclidean")
                    < 45 * m
                ),
                label="wait_at_curb",
            ),
            Emit(self.crossing_started),
            self.walker.walk(speed(self.v_walk), duration=8 * s, label="cross"),
            Emit(self.road_is_free),
            self.walker.remain_stationary(),
        )

    def ego_part(self) -> Behaviour:  # pedestrian_crossing.osc:36
        return Serial(
            "ego_part",
            Until(
                self.ego.drive(speed(self.v_ego)),
                self.crossing_started,
                label="approach",
            ),
            self.ego.change_speed(target=0 * kph, rate_profile="smooth", label="brake"),
            Wait(self.road_is_free),
            self.ego.change_speed(target=self.v_ego, rate_profile="smooth"),
            self.ego.drive(speed(self.v_ego), duration=5 * s, label="leave"),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return PedestrianCrossing().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(PedestrianCrossing))
