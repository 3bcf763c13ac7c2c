"""Scenario `acceleration_profile`.

C20 Acceleration profile: the jerk with which a drive takes up its acceleration.

Made by osc2tx from capabilities/C20_acceleration_shape.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    CommonAccelerationShape,
    Map,
    Scenario,
    Serial,
    Vehicle,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import acceleration, lane, position, speed
from osc2tx_runtime.units import m, mps, mpspsps, mpss, s

require_api(1)


class AccelerationProfile(Scenario):
    name = "acceleration_profile"
    source = "capabilities/C20_acceleration_shape.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())

        self.build_up = self.argument(
            "build_up", CommonAccelerationShape(rate_profile="constant", rate_peak=0.5 * mpspsps)
        )

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(2), position(50 * m), speed(10 * mps))

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.ego.drive(speed(10 * mps), duration=1 * s),
            self.ego.drive("gain", acceleration(1.5 * mpss, shape=self.build_up), duration=6 * s),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return AccelerationProfile().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(AccelerationProfile))
