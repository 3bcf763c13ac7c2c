"""Scenarios `with_limits`, `calls`.

Made by osc2tx from input.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Call,
    Emit,
    Event,
    Map,
    On,
    Parallel,
    Scenario,
    Serial,
    Until,
    Vehicle,
    Wait,
    elapsed,
    main,
    require_api,
    undefined,
)
from osc2tx_runtime.modifiers import speed
from osc2tx_runtime.units import Speed, kph, s

require_api(1)


class WithLimits(Scenario):
    name = "with_limits"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.ego = self.cast("ego", Vehicle())

    def limit(self) -> Speed:
        return undefined("limit")

    def half(self, v: Speed) -> Speed:
        return v / 2.0


class Calls(WithLimits):
    name = "calls"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values, besides those of `WithLimits`."""
        # Code of the user: runs only with --allow-external
        self.note = self.external("own_code.note")
        self.doubled = self.external("own_code.twice", float)
        super().declare()
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.reached = self.parameter("reached", False)
        self.passed = Event()

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        super().placement()
        self.place(self.ego, speed(self.half(self.limit())), throughout=True)

    # What the base leaves open
    def limit(self) -> Speed:
        return 30 * kph

    # A method of a type: its object comes first.
    def vehicle_is_faster_than(self, vehicle: Vehicle, limit: Speed) -> bool:
        return vehicle.speed > limit

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self._ego_drive_then_now(),
            On(
                self.passed,
                Call(lambda: self.note(self.ego.speed, "passed")),
            ),
        )

    def _ego_drive_then_now(self) -> Behaviour:
        return Serial(
            "do serial",
            Until(
                self.ego.drive(speed(self.half(self.limit()))),
                elapsed(1 * s),
            ),
            Emit(self.passed),
            Call("now", lambda: self.note(self.limit(), "there")),
            Wait(
                lambda: self.vehicle_is_faster_than(self.ego, 1 * kph) and self.doubled(2.0) == 4.0
            ),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Calls().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Calls))
