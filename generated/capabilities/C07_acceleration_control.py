"""Scenario `acceleration_control`.

C07 Acceleration control: reach an acceleration with a constant jerk, hold it, then have another
one at once.

Made by osc2tx from capabilities/C07_acceleration_control.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    Scenario,
    Serial,
    Vehicle,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import m, mps, mpspsps, mpss, s

require_api(1)


class AccelerationControl(Scenario):
    name = "acceleration_control"
    source = "capabilities/C07_acceleration_control.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(2), position(50 * m), speed(10 * mps))

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.ego.change_acceleration(
                "build_up", target=1.5 * mpss, rate_profile="constant", rate_peak=1 * mpspsps
            ),
            self.ego.keep_acceleration("hold", duration=2 * s),
            self.ego.assign_acceleration(acceleration=-2 * mpss),
            self.ego.keep_acceleration("brake", duration=3 * s),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return AccelerationControl().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(AccelerationControl))
