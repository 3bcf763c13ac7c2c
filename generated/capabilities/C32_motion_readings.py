"""Scenario `motion_readings`.

C32 Triggers by the motion of a car: how fast it turns, what throws it aside, how steep its way is.

Made by osc2tx from capabilities/C32_motion_readings.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Event,
    Map,
    Scenario,
    Serial,
    Until,
    Vehicle,
    fall,
    main,
    require_api,
    rise,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import deg, m, mps, mpsps, radps

require_api(1)


class MotionReadings(Scenario):
    name = "motion_readings"
    source = "capabilities/C32_motion_readings.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="curve.xodr"))
        self.ego = self.cast("ego", Vehicle())

        self.bend = Event(rise(lambda: self.ego.velocity.angular.yaw > 0.1 * radps))
        self.out_of_it = Event(fall(lambda: self.ego.acceleration.translational.y > 1 * mpsps))
        self.braking = Event(rise(lambda: self.ego.acceleration.translational.norm() > 2.5 * mpsps))
        self.yaw_rate = self.sample(lambda: self.ego.velocity.angular.yaw, self.bend, 0 * radps)
        self.aside = self.sample(
            lambda: self.ego.acceleration.translational.y, self.bend, 0 * mpsps
        )
        self.drift = self.sample(lambda: self.ego.velocity.translational.y, self.bend, 0 * mps)
        self.slope = self.sample(
            lambda: self.ego.velocity.translational.norm(), self.out_of_it, 0 * mps
        )
        self.pitch = self.sample(lambda: self.ego.pose.orientation.pitch, self.out_of_it, 0 * deg)
        self.ahead = self.sample(
            lambda: self.ego.acceleration.translational.x, self.braking, 0 * mpsps
        )

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(1), position(50 * m), speed(15 * mps))

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            Until(
                self.ego.drive(speed(15 * mps)),
                self.out_of_it,
            ),
            self.ego.change_speed(target=5 * mps, rate_profile="constant", rate_peak=3 * mpsps),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return MotionReadings().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(MotionReadings))
