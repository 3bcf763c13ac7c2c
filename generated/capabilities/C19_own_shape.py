"""Scenario `own_shape`.

C19 Own shapes: a speed that swells and falls back, computed by the scenario itself, and an
acceleration that fades; the quantities of the shapes can be read as well.

Made by osc2tx from capabilities/C19_own_shape.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from dataclasses import dataclass

from osc2tx_runtime import (
    AnyAccelerationShape,
    AnySpeedShape,
    Behaviour,
    CommonSpeedShape,
    Event,
    Map,
    Parallel,
    Scenario,
    Vehicle,
    Wait,
    main,
    require_api,
    rise,
)
from osc2tx_runtime.modifiers import acceleration, lane, position, speed
from osc2tx_runtime.units import Acceleration, Speed, Time, m, mps, mpss, s

require_api(1)


@dataclass(frozen=True, kw_only=True, eq=False)
class Swell(AnySpeedShape):
    """Struct `swell`.

    Up by `height` and down again, on a parabola over `length`.
    """

    base: Speed
    height: Speed
    length: Time

    def duration(self) -> Time:
        return self.length

    def bow(self, share: float) -> float:
        return 4.0 * share * (1.0 - share)

    def compute(self, time: Time) -> Speed:
        return self.base + self.height * self.bow(time / self.length)


@dataclass(frozen=True, kw_only=True, eq=False)
class Fading(AnyAccelerationShape):
    """Struct `fading`.

    Falls evenly to zero.
    """

    first: Acceleration
    length: Time

    def duration(self) -> Time:
        return self.length

    def compute(self, time: Time) -> Acceleration:
        return self.first * (1.0 - time / self.length)


class OwnShapeScenario(Scenario):
    name = "own_shape"
    source = "capabilities/C19_own_shape.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.swelling = self.cast("swelling", Vehicle())
        self.starting = self.cast("starting", Vehicle())

        self.wave = self.argument("wave", Swell(base=10 * mps, height=4 * mps, length=8 * s))
        self.push = self.argument("push", Fading(first=3 * mpss, length=6 * s))
        self.ramp = self.argument(
            "ramp", CommonSpeedShape(rate_profile="constant", rate_peak=2 * mpss, target=6 * mps)
        )

        self.half_way = Event(
            rise(lambda: self.swelling.speed >= self.wave.compute(self.wave.duration() / 4.0))
        )

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.swelling, lane(1), position(50 * m), speed(self.wave.compute(0 * s)))
        self.place(self.starting, lane(2), position(50 * m), speed(self.ramp.compute(1 * s)))

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.swelling.drive(speed(shape=self.wave), duration=self.wave.duration()),
            self.starting.drive(
                acceleration(shape=self.push), duration=self.wave.duration() + self.ramp.duration()
            ),
            Wait(self.half_way),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return OwnShapeScenario().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(OwnShapeScenario))
