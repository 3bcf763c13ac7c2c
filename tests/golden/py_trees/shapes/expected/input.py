"""Scenario `shapes`.

Made by osc2tx from input.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam; `one_of` is a race.
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
    OwnShape,
    Parallel,
    Person,
    Scenario,
    Serial,
    Vehicle,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, lateral, position, speed, yaw
from osc2tx_runtime.units import degps, m, mps, mpsps, ms, s

require_api(1)


@dataclass(frozen=True, kw_only=True, eq=False)
class Ramp(AnySpeedShape):
    """Struct `ramp`.

    Evenly from one value to another.
    """

    first: float
    last: float
    length: float


@dataclass(frozen=True, kw_only=True, eq=False)
class Sway(AnyLateralShape):
    """Struct `sway`."""

    rate: float


@dataclass(frozen=True, kw_only=True, eq=False)
class Turn(AnyShape):
    """Struct `turn`."""

    rate: float


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
        self.road = Map(map_file="highway.xodr")
        self.ego = Vehicle()
        self.lead = Vehicle()
        self.walker = Person()
        self.up = Ramp(first=10 * mps, last=14 * mps, length=4 * s)
        self.out = Sway(rate=0.2 * mps)
        self.round = Turn(rate=10 * degps)
        self.near = Noted(rate_profile="smooth", note="gently")
        self.plain = CommonSpeedShape(rate_profile="constant", rate_peak=2 * mpsps, target=4 * mps)

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(2), position(60 * m), speed(self.ramp_compute(self.up, 0 * s)))
        self.place(
            self.lead,
            lane(same_as=self.ego),
            position(40 * m, ahead_of=self.ego),
            speed(self.ramp_compute(self.up, 2 * s)),
        )
        self.place(self.walker, speed(self.plain.compute(500 * ms)))

    def ramp_duration(self, ramp: Ramp) -> float:
        return ramp.length

    def ramp_share(self, ramp: Ramp, time: float) -> float:
        return time / ramp.length

    def ramp_compute(self, ramp: Ramp, time: float) -> float:
        return ramp.first + (ramp.last - ramp.first) * self.ramp_share(ramp, time)

    def sway_compute(self, sway: Sway, time: float) -> float:
        return sway.rate * time

    def turn_duration(self, turn: Turn) -> float:
        return 2 * s

    def turn_compute(self, turn: Turn, time: float) -> float:
        return turn.rate * time

    def behavior(self) -> Behaviour:
        return Parallel(
            "shapes",
            self.ego_serial(),
            self.lead.drive(speed(self.ramp_compute(self.up, 2 * s)), duration=20 * s),
            self.walker.walk(
                yaw(shape=OwnShape(self.round, self.turn_compute, self.turn_duration)),
                speed(self.plain.compute(500 * ms)),
                duration=3 * s,
            ),
            overlap="any",
        )

    def ego_serial(self) -> Behaviour:
        return Serial(
            "ego: serial",
            # What holds throughout starts with its first value.
            self.ego.drive(
                speed(shape=OwnShape(self.up, self.ramp_compute, self.ramp_duration)),
                duration=self.ramp_duration(self.up),
            ),
            self.ego.drive(
                lateral(shape=OwnShape(self.out, self.sway_compute)),
                duration=self.plain.duration() + 1 * s,
            ),
            self.ego.drive(
                position(20 * m, behind=self.lead, shape=self.near, at="end"), duration=8 * s
            ),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Shapes().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Shapes))
