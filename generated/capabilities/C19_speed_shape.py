"""Scenario `velocity_profile`.

C19 Velocity profile: the same speed by shapes of the acceleration: even, and smooth with a peak.

Made by osc2tx from capabilities/C19_speed_shape.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    CommonSpeedShape,
    Map,
    Parallel,
    Scenario,
    Vehicle,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import m, mps, mpss, s

require_api(1)


class VelocityProfile(Scenario):
    name = "velocity_profile"
    source = "capabilities/C19_speed_shape.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.even = self.cast("even", Vehicle())
        self.gentle = self.cast("gentle", Vehicle())

        self.even_shape = self.argument(
            "even_shape", CommonSpeedShape(rate_profile="constant", rate_peak=1.6 * mpss)
        )
        self.gentle_shape = self.argument(
            "gentle_shape", CommonSpeedShape(rate_profile="smooth", rate_peak=2 * mpss)
        )

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.even, lane(1), position(50 * m), speed(10 * mps))
        self.place(self.gentle, lane(2), position(50 * m), speed(10 * mps))

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.even.drive(speed(18 * mps, shape=self.even_shape)),
            self.gentle.drive(speed(16 * mps, shape=self.gentle_shape)),
            duration=7 * s,
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return VelocityProfile().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(VelocityProfile))
