"""Scenario `conditions`.

Made by osc2tx from input.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Emit,
    Event,
    Map,
    Parallel,
    Scenario,
    Serial,
    Until,
    Vehicle,
    Wait,
    elapsed,
    every,
    fall,
    main,
    require_api,
    rise,
    within,
)
from osc2tx_runtime.modifiers import speed
from osc2tx_runtime.units import kph, m, s

require_api(1)


class Conditions(Scenario):
    name = "conditions"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())
        self.other = self.cast("other", Vehicle())
        self.near = self.parameter("near", 20 * m, unit="m")
        self.close = Event(
            rise(
                lambda: self.ego.object_distance(reference=self.other, direction="euclidean")
                < self.near
            )
        )
        self.help_needed = Event()
        self.wait_time = self.parameter("wait time", within(20 * s, 25 * s), unit="s")
        self.late = Event(elapsed(self.wait_time))
        self.wait_time_2 = self.parameter("wait time 2", within(1 * s, 2 * s), unit="s")

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self._ego_first_serial(),
            self._other_second_serial(),
        )

    def _ego_first_serial(self) -> Behaviour:
        return Serial(
            "ego: serial",
            Wait(self.close),
            Wait(self.help_needed, condition=lambda: self.ego.speed > 10 * kph),
            Wait(fall(lambda: self.ego.speed > 30 * kph and self.other.speed != 0 * kph)),
            Wait(elapsed(self.wait_time_2)),
            Wait(every(2 * s, offset=1 * s)),
            Wait(lambda: self.ego.speed < self.other.speed),
            self.ego.keep_speed("first", duration=3 * s),
            Wait(self.ended("second")),
        )

    def _other_second_serial(self) -> Behaviour:
        return Serial(
            "other: serial",
            Wait(self.started("first")),
            Emit(self.help_needed),
            Until(
                self.other.drive("second", speed(20 * kph), duration=(1 * s, 4 * s)),
                # whatever comes first
                self.help_needed,
                self.late,
                lambda: 10 * kph <= self.ego.speed <= 20 * kph,
            ),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Conditions().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Conditions))
