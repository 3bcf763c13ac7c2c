"""Scenario `rising_edge`.

C37 rise: true in the instant in which the condition turns from false to true; a condition that
is true already does not count.

Made by osc2tx from capabilities/C37_rise.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Event,
    Map,
    Parallel,
    Scenario,
    Serial,
    Vehicle,
    Wait,
    elapsed,
    main,
    require_api,
    rise,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import m, mps, mpss, s

require_api(1)


class RisingEdge(Scenario):
    name = "rising_edge"
    source = "capabilities/C37_rise.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())

        self.fast = Event(rise(lambda: self.ego.speed > 12.05 * mps))
        self.fast_again = Event(rise(lambda: self.ego.speed > 12.05 * mps))

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(2), position(50 * m), speed(10 * mps))

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self._ego_change_speed_serial(),
            self._wait_serial(),
        )

    def _ego_change_speed_serial(self) -> Behaviour:
        return Serial(
            "ego: serial",
            self.ego.change_speed(target=14 * mps, rate_profile="constant", rate_peak=2 * mpss),
            self.ego.change_speed(target=10 * mps, rate_profile="constant", rate_peak=2 * mpss),
            self.ego.change_speed(target=14 * mps, rate_profile="constant", rate_peak=2 * mpss),
        )

    def _wait_serial(self) -> Behaviour:
        return Serial(
            "serial",
            Wait(self.fast),
            # Too fast still, so this does not count; the next edge comes after it was slower
            Wait(elapsed(0.5 * s)),
            Wait(self.fast_again),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return RisingEdge().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(RisingEdge))
