"""Scenario `speed_control`.

C06 Speed control: the same change of speed by three rate profiles: constant acceleration, smooth
course, and as fast as the vehicle can.

Made by osc2tx from capabilities/C06_speed_control.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    Parallel,
    Scenario,
    Vehicle,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import m, mps, mpss

require_api(1)


class SpeedControl(Scenario):
    name = "speed_control"
    source = "capabilities/C06_speed_control.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.even = self.cast("even", Vehicle())
        self.gentle = self.cast("gentle", Vehicle())
        self.hasty = self.cast("hasty", Vehicle())

        self.v_start = self.parameter("v_start", 10 * mps, unit="mps")
        self.v_target = self.parameter("v_target", 20 * mps, unit="mps")

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.even, lane(1), position(50 * m), speed(self.v_start))
        self.place(self.gentle, lane(2), position(50 * m), speed(self.v_start))
        self.place(self.hasty, lane(3), position(50 * m), speed(self.v_start))

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.even.change_speed(
                target=self.v_target, rate_profile="constant", rate_peak=2.5 * mpss
            ),
            self.gentle.change_speed(
                target=self.v_target, rate_profile="smooth", rate_peak=2.5 * mpss
            ),
            self.hasty.change_speed(target=self.v_target, rate_profile="asap"),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return SpeedControl().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(SpeedControl))
