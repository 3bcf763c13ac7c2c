"""Scenario `sudden_ice`.

C18 Road conditions: what a driver wants and what the road holds. Two cars brake with 6 m/s^2; after
a second it rains below zero. From there on they lose only what ice transmits, and stand
v^2 / (2 mu g) further on. A person on foot is not held up by any of it.

Made by osc2tx from capabilities/C18_sudden_ice.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Environment,
    Map,
    Parallel,
    Person,
    Point,
    Scenario,
    Serial,
    Vehicle,
    Wait,
    elapsed,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import acceleration, lane, position, speed
from osc2tx_runtime.units import celsius, m, mmph, mps, mpss, s

require_api(1)


class SuddenIce(Scenario):
    name = "sudden_ice"
    source = "capabilities/C18_sudden_ice.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.env = self.cast("env", Environment())
        self.fast = self.cast("fast", Vehicle())
        self.slow = self.cast("slow", Vehicle())
        self.walker = self.cast("walker", Person())
        self.verge = self.argument("verge", Point(x=50 * m, y=4 * m, z=0 * m))

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.fast, lane(1), position(50 * m), speed(20 * mps))
        self.place(self.slow, lane(2), position(50 * m), speed(12 * mps))
        self.place(
            self.walker, position(at_point=self.verge, project_on_route=False), speed(1.4 * mps)
        )

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self._fast_drive_serial(),
            self._slow_drive_serial(),
            self.walker.walk(speed(1.4 * mps)),
            self._env_air_then_rain(),
            duration=25 * s,
        )

    def _fast_drive_serial(self) -> Behaviour:
        return Serial(
            "fast: serial",
            self.fast.drive(speed(20 * mps), duration=1 * s),
            self.fast.drive(acceleration(-6 * mpss)),
        )

    def _slow_drive_serial(self) -> Behaviour:
        return Serial(
            "slow: serial",
            self.slow.drive(speed(12 * mps), duration=1 * s),
            self.slow.drive(acceleration(-6 * mpss)),
        )

    def _env_air_then_rain(self) -> Behaviour:
        return Serial(
            "env: serial",
            self.env.air(temperature=celsius(-5)),
            Wait(elapsed(2 * s)),
            self.env.rain(intensity=2 * mmph),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return SuddenIce().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(SuddenIce))
