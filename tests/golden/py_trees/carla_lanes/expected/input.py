"""Scenario `carla_lanes`.

Made by osc2tx from input.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect carla.
"""

from osc2tx_runtime import (
    Behaviour,
    Event,
    Map,
    Scenario,
    Serial,
    StationaryObject,
    Until,
    Vehicle,
    Wait,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import kph, m, rad

require_api(1)


class CarlaLanes(Scenario):
    name = "carla_lanes"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.hero = self.cast("hero", Vehicle(name="ego_vehicle"))
        self.cone = self.cast("cone", StationaryObject())

        # Events that the scenario uses without declaring them
        self.go = Event()

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.hero, lane(2, from_="left"), speed(0 * kph))
        self.place(self.cone, position(x=300.0, y=5.25, z=0.0, h=1.57 * rad, frame="carla"))

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            Wait(self.go),
            Until(
                self.hero.drive(speed(30 * kph, rate_profile="smooth")),
                lambda: self.hero.position.behind(self.cone) < 30 * m,
            ),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return CarlaLanes().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(CarlaLanes))
