"""Scenario `fog`.

C16 Weather control: fog hides what is ahead. Two careful drivers come to a broken-down car, one in
clear air and one, later, in fog; the second one sees it only 50 m away and brakes harder.

Made by osc2tx from capabilities/C16_fog.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Environment,
    Map,
    Parallel,
    Scenario,
    Serial,
    Vehicle,
    Wait,
    elapsed,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import avoid_collisions, lane, position, speed
from osc2tx_runtime.units import m, mps, s

require_api(1)


class FogScenario(Scenario):
    name = "fog"
    source = "capabilities/C16_fog.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.env = self.cast("env", Environment())
        self.early = self.cast("early", Vehicle())
        self.late = self.cast("late", Vehicle())
        self.standing = self.cast("standing", Vehicle())
        self.broken = self.cast("broken", Vehicle())

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.standing, lane(1), position(300 * m))
        self.place(self.broken, lane(2), position(600 * m))
        self.place(self.early, lane(1), position(100 * m), speed(15 * mps))
        self.place(self.late, lane(2), position(280 * m), speed(15 * mps))

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.standing.remain_stationary(),
            self.broken.remain_stationary(),
            self.early.drive(speed(15 * mps), avoid_collisions(True)),
            self.late.drive(speed(15 * mps), avoid_collisions(True)),
            self._env_fog_serial(),
            duration=30 * s,
        )

    def _env_fog_serial(self) -> Behaviour:
        return Serial(
            "env: serial",
            Wait(elapsed(12 * s)),
            self.env.fog(visual_range=50 * m),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return FogScenario().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(FogScenario))
