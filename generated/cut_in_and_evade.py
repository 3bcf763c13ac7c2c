"""Scenario `cut_in_and_evade`.

A truck passes the hero, cuts in and brakes. The hero evades to the right. Both then stop
before an obstacle, side by side. The story of the case study, in plain OpenSCENARIO DSL 2.1.

Made by osc2tx from cut_in_and_evade.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Emit,
    Environment,
    Event,
    Map,
    Parallel,
    Pose,
    Scenario,
    Serial,
    StationaryObject,
    Until,
    Vehicle,
    Wait,
    elapsed,
    fall,
    main,
    require_api,
    rise,
)
from osc2tx_runtime.modifiers import lane, location, position, speed
from osc2tx_runtime.units import deg, kph, m, s

require_api(1)


class CutInAndEvade(Scenario):
    name = "cut_in_and_evade"
    source = "cut_in_and_evade.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        # Cast
        self.highway = self.cast("highway", Map(map_file="highway.xodr"))
        self.env = self.cast("env", Environment())
        self.hero = self.cast("hero", Vehicle(vehicle_category="car"))
        self.npc = self.cast("npc", Vehicle(vehicle_category="truck"))
        self.obstacle = self.cast("obstacle", StationaryObject())

        # The obstacle stands in the third lane from the right.
        self.obstacle_pose = self.argument(
            "obstacle_pose", Pose(x=900 * m, y=-5.25 * m, z=0 * m, yaw=0 * deg)
        )

        # Speeds and distances
        self.v_hero = self.parameter("v_hero", 60 * kph, unit="kph")
        self.v_npc_fast = self.parameter("v_npc_fast", self.v_hero + 20 * kph, unit="kph")
        self.v_npc_slow = self.parameter("v_npc_slow", self.v_hero - 15 * kph, unit="kph")
        self.v_npc_catchup = self.parameter("v_npc_catchup", 80 * kph, unit="kph")
        self.lag = self.parameter("lag", 5 * m, unit="m")
        self.safety_gap = self.parameter("safety_gap", 3 * self.lag + 5 * m, unit="m")

        self.crash_avoided = Event()
        self.obstacle_detected = Event()

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.obstacle, location(pose=self.obstacle_pose))
        self.place(self.hero, lane(3), position(100 * m), speed(self.v_hero))
        self.place(
            self.npc,
            lane(side_of=self.hero, side="right"),
            position(self.lag, behind=self.hero),
            speed(self.v_npc_fast),
        )

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            # Twilight
            self.env.assign_celestial_position(
                light_source=self.env.sun, azimuth=270 * deg, elevation=12 * deg
            ),
            self._hero_part_and_npc_part(),
        )

    def _hero_part_and_npc_part(self) -> Behaviour:
        return Parallel(
            "parallel",
            self.hero_part(),
            self.npc_part(),
        )

    def hero_part(self) -> Behaviour:
        """Hero."""
        return Serial(
            "hero_part",
            Until(
                self.hero.drive("cruise", speed(self.v_hero)),
                # the truck is in front and the gap closes
                fall(
                    lambda: self.hero.road_distance(reference=self.npc, direction="longitudinal")
                    > self.safety_gap
                ),
            ),
            self.hero.change_lane("evade", num_of_lanes=1, side="right"),
            Emit(self.crash_avoided),
            Until(
                self.hero.drive("pass_by", speed(self.v_hero)),
                self.obstacle_detected,
            ),
            # Pull alongside and stop
            self.hero.change_speed(target=25 * kph, rate_profile="smooth"),
            Until(
                self.hero.drive("alongside", speed(25 * kph)),
                rise(
                    lambda: self.npc.road_distance(reference=self.hero, direction="longitudinal")
                    >= -1 * m
                ),
            ),
            self.hero.change_speed(target=0 * kph, rate_profile="asap"),
            Wait(lambda: self.hero.speed < 0.1 * kph),
            Wait(elapsed(5 * s)),
        )

    def npc_part(self) -> Behaviour:
        """Truck."""
        return Serial(
            "npc_part",
            Until(
                self.npc.drive("overtake", speed(self.v_npc_fast)),
                rise(
                    lambda: self.hero.road_distance(reference=self.npc, direction="longitudinal")
                    >= 4 * self.lag
                ),
            ),
            self.npc.change_lane("cut_in", num_of_lanes=1, side="left"),
            # Brake check, until the hero has evaded
            self.npc.change_speed(target=self.v_npc_slow),
            Until(
                self.npc.drive("brake_check", speed(self.v_npc_slow)),
                self.crash_avoided,
            ),
            self.npc.change_speed(target=self.v_npc_catchup),
            Until(
                self.npc.drive("recover", speed(self.v_npc_catchup)),
                rise(
                    lambda: self.npc.object_distance(reference=self.obstacle, direction="euclidean")
                    < 90 * m
                ),
            ),
            Emit(self.obstacle_detected),
            self.npc.change_speed(target=0 * kph, rate_profile="asap"),
            Wait(elapsed(20 * s)),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return CutInAndEvade().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(CutInAndEvade))
