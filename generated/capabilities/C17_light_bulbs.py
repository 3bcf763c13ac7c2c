"""Scenario `light_bulbs`.

C17 Light bulbs: what single bulbs do starts something else; a stop line that is not where the map
has it, and what is known of the light.

Made by osc2tx from capabilities/C17_light_bulbs.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Event,
    Map,
    Parallel,
    Scenario,
    Serial,
    TrafficLight,
    TrafficLightController,
    TrafficLightCycle,
    TrafficLightGroup,
    TrafficLightPhase,
    TrafficLightStopLine,
    Until,
    Vehicle,
    main,
    require_api,
    rise,
)
from osc2tx_runtime.modifiers import avoid_collisions, lane, position, speed
from osc2tx_runtime.units import m, mps, s

require_api(1)


class LightBulbs(Scenario):
    name = "light_bulbs"
    source = "capabilities/C17_light_bulbs.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        # red for 12 s, then green
        self.closed = self.argument(
            "closed",
            TrafficLightPhase(
                group=TrafficLightGroup(map_id="1"),
                bulbs_state=["is_on", "is_off", "is_off"],
                duration=12 * s,
            ),
        )
        self.free = self.argument(
            "free",
            TrafficLightPhase(
                group=TrafficLightGroup(map_id="1"),
                bulbs_state=["is_off", "is_off", "is_on"],
                duration=20 * s,
            ),
        )
        self.cycle = self.argument("cycle", TrafficLightCycle(phases=[self.closed, self.free]))
        self.road = self.cast(
            "road", Map(map_file="urban_crossing.xodr", traffic_light_control=[self.cycle])
        )
        self.ego = self.cast("ego", Vehicle())
        self.lights = self.cast("lights", TrafficLightController())
        self.east = self.argument("east", TrafficLight(map_id="101"))

        # 49 m before the lights
        self.line = self.argument(
            "line",
            TrafficLightStopLine(
                traffic_light_group=self.east.group,
                offset=100 * m,
                primary_stop_line_marking="solid",
            ),
        )

        self.red_shines = Event(rise(lambda: self.east.bulbs[0].state == "is_on"))
        self.green_shines = Event(
            rise(lambda: self.east.state_equal(["is_off", "is_off", "is_on"]))
        )
        self.at = self.sample(lambda: self.east.pose.position.x, self.red_shines, 0 * m)
        self.above = self.sample(lambda: self.east.pose.position.z, self.red_shines, 0 * m)
        self.height = self.sample(lambda: self.east.height, self.red_shines, 0 * m)
        self.width = self.sample(lambda: self.east.width, self.red_shines, 0 * m)
        self.bulbs = self.sample(lambda: len(self.east.group.bulbs), self.red_shines, 0)
        self.phases = self.sample(lambda: len(self.east.group.cycle.phases), self.red_shines, 0)
        self.line_at = self.sample(lambda: self.line.offset, self.red_shines, 0 * m)
        self.last_lane = self.sample(lambda: self.line.leftmost_lane, self.red_shines, 0)
        self.section = self.sample(lambda: self.line.route.length, self.red_shines, 0 * m)
        self.is_drawn = self.sample(
            lambda: self.line.secondary_stop_line_marking == "solid", self.red_shines, False
        )

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(1), position(20 * m), speed(10 * mps))

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.lights.play_cycles(cycles=self.road.traffic_light_control),
            self._ego_drive_serial(),
        )

    def _ego_drive_serial(self) -> Behaviour:
        return Serial(
            "ego: serial",
            Until(
                self.ego.drive(speed(10 * mps), avoid_collisions(True)),
                self.green_shines,
            ),
            self.ego.drive(speed(10 * mps, at="end"), avoid_collisions(True), duration=6 * s),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return LightBulbs().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(LightBulbs))
