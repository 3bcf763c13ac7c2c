"""Scenario `serial_execution`.

C30 Serial execution: each step starts in the instant in which the step before it ends.

Made by osc2tx from capabilities/C30_serial.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    Scenario,
    Serial,
    Vehicle,
    Wait,
    elapsed,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import m, mps, mpss, s

require_api(1)


class SerialExecution(Scenario):
    name = "serial_execution"
    source = "capabilities/C30_serial.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(1), position(50 * m), speed(12 * mps))

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.ego.drive("drive_on", speed(12 * mps), duration=2 * s),
            self.ego.change_lane("swerve", side="left", duration=4 * s),
            self.ego.change_speed(
                "faster", target=18 * mps, rate_profile="constant", rate_peak=2 * mpss
            ),
            Wait("pause", elapsed(0.5 * s)),
            self.ego.change_lane("back", side="right", duration=4 * s),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return SerialExecution().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(SerialExecution))
