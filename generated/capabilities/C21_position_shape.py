"""Scenario `position_shape`.

C21 Position shapes: where a car is at any time. One stops smoothly after 60 m, one closes a gap
to another car, one has a course of its own.

Made by osc2tx from capabilities/C21_position_shape.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from dataclasses import dataclass

from osc2tx_runtime import (
    AnyPositionShape,
    Behaviour,
    CommonPositionShape,
    Map,
    Parallel,
    Scenario,
    Vehicle,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import distance, lane, position, speed
from osc2tx_runtime.units import Length, Speed, Time, m, mps, s

require_api(1)


@dataclass(frozen=True, kw_only=True, eq=False)
class Gaining(AnyPositionShape):
    """Struct `gaining`.

    Goes on at `pace`, and faster and faster: `more` further after `period`.
    """

    pace: Speed
    more: Length
    period: Time

    def square(self, share: float) -> float:
        return share * share

    def compute(self, time: Time) -> Length:
        return self.pace * time + self.more * self.square(time / self.period)


class PositionShape(Scenario):
    name = "position_shape"
    source = "capabilities/C21_position_shape.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.stopping = self.cast("stopping", Vehicle())
        self.lead = self.cast("lead", Vehicle())
        self.closing = self.cast("closing", Vehicle())
        self.own = self.cast("own", Vehicle())

        self.smoothly = self.argument("smoothly", CommonPositionShape(rate_profile="smooth"))
        self.faster = self.argument("faster", Gaining(pace=10 * mps, more=4 * m, period=4 * s))

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.stopping, lane(1), position(20 * m), speed(12 * mps))
        self.place(self.lead, lane(2), position(80 * m), speed(12 * mps))
        self.place(self.closing, lane(2), position(40 * m, behind=self.lead), speed(10 * mps))
        self.place(self.own, lane(3), speed(10 * mps), position(self.faster.compute(0 * s)))

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.stopping.drive(distance(60 * m, shape=self.smoothly)),
            self.lead.drive(),
            self.closing.drive(position(25 * m, behind=self.lead, shape=self.smoothly, at="end")),
            self.own.drive(position(shape=self.faster)),
            duration=8 * s,
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return PositionShape().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(PositionShape))
