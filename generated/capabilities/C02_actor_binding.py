"""Scenarios `vehicle.gain_speed`, `actor_binding`.

C02 Actor binding: one behavior, written for any vehicle, is performed by the actor that it is
invoked on. The third car is never addressed and keeps its state.

Made by osc2tx from capabilities/C02_actor_binding.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    Parallel,
    Scenario,
    Serial,
    Vehicle,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import m, mps, mpss, s

require_api(1)


class GainSpeed(Scenario):
    """Reaches a speed with a comfortable acceleration."""

    name = "vehicle.gain_speed"
    source = "capabilities/C02_actor_binding.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.actor = self.cast("actor", Vehicle())
        self.target = self.parameter("target", 15 * mps, unit="mps")

    def behavior(self) -> Behaviour:
        return Serial(
            self.short_name,
            self.actor.change_speed(
                target=self.target, rate_profile="constant", rate_peak=2 * mpss
            ),
        )


class ActorBinding(Scenario):
    name = "actor_binding"
    source = "capabilities/C02_actor_binding.osc"
    is_main = True

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.first = self.cast("first", Vehicle())
        self.second = self.cast("second", Vehicle())
        self.third = self.cast("third", Vehicle())

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.first, lane(1), position(50 * m), speed(10 * mps))
        self.place(self.second, lane(2), position(50 * m), speed(10 * mps))
        self.place(self.third, lane(3), position(50 * m), speed(10 * mps))

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.settle(),
            self.gain(),
        )

    def settle(self) -> Behaviour:
        return Parallel(
            "settle",
            self.first.drive(duration=1 * s),
            self.second.drive(duration=1 * s),
            self.third.drive(duration=1 * s),
        )

    def gain(self) -> Behaviour:
        return Parallel(
            "gain",
            self.invoke("first_gains", GainSpeed, actor=self.first, target=16 * mps),
            self.invoke("second_gains", GainSpeed, actor=self.second, target=20 * mps),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return ActorBinding().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(GainSpeed, ActorBinding))
