"""Scenario `driving_with_a_trailer`.

C05 Drive with a trailer: a truck is coupled to a trailer behind it, pulls it along and lets it go.

Made by osc2tx from capabilities/C05_trailer.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    Parallel,
    Scenario,
    Serial,
    Trailer,
    Until,
    Vehicle,
    elapsed,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import m, mps, s

require_api(1)


class DrivingWithATrailer(Scenario):
    name = "driving_with_a_trailer"
    source = "capabilities/C05_trailer.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.truck = self.cast("truck", Vehicle(vehicle_category="truck"))
        self.load = self.cast("load", Trailer())

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.load, lane(2), position(50 * m), speed(0 * mps))
        self.place(self.truck, lane(2), position(7 * m, ahead_of=self.load), speed(0 * mps))

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            Until(
                self.load.remain_stationary(),
                elapsed(1 * s),
            ),
            self._truck_drive_then_couple(),
        )

    def _truck_drive_then_couple(self) -> Behaviour:
        return Serial(
            "truck: serial",
            self.truck.drive(speed(0 * mps), duration=1 * s),
            self.truck.connect_trailer("couple", trailer=self.load),
            self.truck.change_speed("pull", target=10 * mps, rate_profile="smooth"),
            self.truck.drive(duration=3 * s),
            self.truck.disconnect_trailer("uncouple"),
            self.truck.drive(duration=3 * s),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return DrivingWithATrailer().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(DrivingWithATrailer))
