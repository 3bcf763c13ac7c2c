"""Scenario `parallel_execution`.

C31 Parallel execution: speed and lane of one car at the same time, a second car beside it, and
members that meet at their ends.

Made by osc2tx from capabilities/C31_parallel.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    Parallel,
    Scenario,
    Serial,
    Vehicle,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import m, mps, s

require_api(1)


class ParallelExecution(Scenario):
    name = "parallel_execution"
    source = "capabilities/C31_parallel.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())
        self.other = self.cast("other", Vehicle())

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(2), position(50 * m), speed(10 * mps))
        self.place(self.other, lane(1), position(50 * m), speed(12 * mps))

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.together(),
            self.same_end(),
        )

    def together(self) -> Behaviour:
        return Parallel(
            "together",
            self.ego.change_speed("faster", target=16 * mps, rate_profile="smooth", duration=4 * s),
            self.ego.change_lane("swerve", side="left", duration=5 * s),
            self.other.drive(speed(12 * mps), duration=3 * s),
        )

    def same_end(self) -> Behaviour:
        return Parallel(
            "same_end",
            self.ego.change_lane("long", side="right", duration=5 * s),
            self.other.change_speed(
                "short", target=16 * mps, rate_profile="constant", duration=2 * s
            ),
            overlap="end",
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return ParallelExecution().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(ParallelExecution))
