"""Scenario `lateral_speeds`.

C22 Lateral speeds: across the lane so fast at the end, or at the start only; and a way across of
its own.

Made by osc2tx from capabilities/C22_lateral_speeds.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from dataclasses import dataclass

from osc2tx_runtime import (
    AnyLateralShape,
    Behaviour,
    Map,
    Parallel,
    Scenario,
    Serial,
    Vehicle,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, lateral, position, speed
from osc2tx_runtime.units import Length, Time, m, mps, s

require_api(1)


@dataclass(frozen=True, kw_only=True, eq=False)
class Bulge(AnyLateralShape):
    """Struct `bulge`.

    Out by `reach` and back, on a parabola.
    """

    reach: Length
    length: Time

    def duration(self) -> Time:
        return self.length

    def bow(self, share: float) -> float:
        return 4.0 * share * (1.0 - share)

    def compute(self, time: Time) -> Length:
        return self.reach * self.bow(time / self.length)


class LateralSpeeds(Scenario):
    name = "lateral_speeds"
    source = "capabilities/C22_lateral_speeds.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.drifting = self.cast("drifting", Vehicle())
        self.bulging = self.cast("bulging", Vehicle())
        self.leaning = self.cast("leaning", Vehicle())

        self.out = self.argument("out", Bulge(reach=0.8 * m, length=4 * s))

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.drifting, lane(1), position(50 * m), speed(15 * mps))
        self.place(
            self.bulging,
            lane(2),
            position(120 * m),
            speed(15 * mps),
            lateral(self.out.compute(0 * s)),
        )
        self.place(
            self.leaning,
            lane(3),
            position(50 * m),
            speed(15 * mps),
            speed(0.5 * mps, direction="lateral"),
        )

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self._drifting_drive_serial(),
            self.bulging.drive(lateral(shape=self.out), duration=4 * s),
            self.leaning.drive(duration=4 * s),
        )

    def _drifting_drive_serial(self) -> Behaviour:
        return Serial(
            "drifting: serial",
            self.drifting.drive(speed(0.6 * mps, direction="lateral", at="end"), duration=2 * s),
            self.drifting.drive(speed(0.6 * mps, direction="lateral"), duration=2 * s),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return LateralSpeeds().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(LateralSpeeds))
