"""Scenario `shapes`.

Made by osc2tx from input.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from dataclasses import dataclass

from osc2tx_runtime import (
    AnyLateralShape,
    AnyShape,
    AnySpeedShape,
    Behaviour,
    CommonPositionShape,
    CommonSpeedShape,
    Map,
    Parallel,
    Person,
    Scenario,
    Serial,
    Vehicle,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, lateral, position, speed, yaw
from osc2tx_runtime.units import (
    Angle,
    AngularRate,
    Length,
    Speed,
    Time,
    degps,
    m,
    mps,
    mpsps,
    ms,
    s,
)

require_api(1)


@dataclass(frozen=True, kw_only=True, eq=False)
class Ramp(AnySpeedShape):
    """Struct `ramp`.

    Evenly from one value to another.
    """

    first: Speed
    last: Speed
    length: Time

    def duration(self) -> Time:
        return self.length

    def share(self, time: Time) -> float:
        return time / self.length

    def compute(self, time: Time) -> Speed:
        return self.first + (self.last - self.first) * self.share(time)


@dataclass(frozen=True, kw_only=True, eq=False)
class Sway(AnyLateralShape):
    """Struct `sway`."""

    rate: Speed

    def compute(self, time: Time) -> Length:
        return self.rate * time


@dataclass(frozen=True, kw_only=True, eq=False)
class Turn(AnyShape):
    """Struct `turn`."""

    rate: AngularRate

    def duration(self) -> Time:
        return 2 * s

    def compute(self, time: Time) -> Angle:
        return self.rate * time


@dataclass(frozen=True, kw_only=True, eq=False)
class Noted(CommonPositionShape):
    """Struct `noted`.

    Says nothing of its own: a common shape with a note.
    """

    note: str


class Shapes(Scenario):
    name = "shapes"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())
        self.lead = self.cast("lead", Vehicle())
        self.walker = self.cast("walker", Person())

        self.up = self.argument("up", Ramp(first=10 * mps, last=14 * mps, length=4 * s))
        self.out = self.argument("out", Sway(rate=0.2 * mps))
        self.round = self.argument("round", Turn(rate=10 * degps))
        self.near = self.argument("near", Noted(rate_profile="smooth", note="gently"))
        self.plain = self.argument(
            "plain", CommonSpeedShape(rate_profile="constant", rate_peak=2 * mpsps, target=4 * mps)
        )

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(2), position(60 * m), speed(self.up.compute(0 * s)))
        self.place(
            self.lead,
            lane(same_as=self.ego),
            position(40 * m, ahead_of=self.ego),
            speed(self.up.compute(2 * s)),
        )
        self.place(self.walker, speed(self.plain.compute(500 * ms)), throughout=True)

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self._ego_drive_serial(),
            self.lead.drive(speed(self.up.compute(2 * s)), duration=20 * s),
            self.walker.walk(
                yaw(shape=self.round), speed(self.plain.compute(500 * ms)), duration=3 * s
            ),
            overlap="any",
        )

    def _ego_drive_serial(self) -> Behaviour:
        return Serial(
            "ego: serial",
            # What holds throughout starts with its first value.
            self.ego.drive(speed(shape=self.up), duration=self.up.duration()),
            self.ego.drive(lateral(shape=self.out), duration=self.plain.duration() + 1 * s),
            self.ego.drive(
                position(20 * m, behind=self.lead, shape=self.near, at="end"), duration=8 * s
            ),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Shapes().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Shapes))
