"""Scenario `towing`.

C05 Towing: a trailer that is coupled from the start follows its car around the bend of the road.

Made by osc2tx from capabilities/C05_towing.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    Scenario,
    Serial,
    Trailer,
    Vehicle,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, position, speed, tow_trailer
from osc2tx_runtime.units import m, mps, s

require_api(1)


class Towing(Scenario):
    name = "towing"
    source = "capabilities/C05_towing.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="curve.xodr"))
        self.car = self.cast("car", Vehicle())
        self.caravan = self.cast("caravan", Trailer())

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(
            self.car, tow_trailer(trailer=self.caravan), lane(1), position(60 * m), speed(15 * mps)
        )

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.car.drive(speed(15 * mps), duration=16 * s),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Towing().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Towing))
