"""Scenario `trigger_measures`.

C32 Triggers by measures: time to collision, gaps and headways in time and space, each noted with
its value in the instant in which it falls below its limit.

Made by osc2tx from capabilities/C32_measures.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Event,
    Map,
    Parallel,
    Scenario,
    Serial,
    Until,
    Vehicle,
    fall,
    main,
    require_api,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import m, mps, s

require_api(1)


class TriggerMeasures(Scenario):
    name = "trigger_measures"
    source = "capabilities/C32_measures.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())
        self.slow = self.cast("slow", Vehicle())

        self.ttc_low = Event(fall(lambda: self.ego.time_to_collision(reference=self.slow) > 4 * s))
        self.gap_low = Event(
            fall(lambda: self.slow.time_gap(reference=self.ego, direction="longitudinal") > 2.5 * s)
        )
        self.headway_low = Event(
            fall(lambda: self.ego.time_headway(reference=self.slow) > 1.52 * s)
        )
        self.near = Event(fall(lambda: self.ego.space_headway(reference=self.slow) > 20.2 * m))
        self.ttc = self.sample(
            lambda: self.ego.time_to_collision(reference=self.slow), self.ttc_low, 0 * s
        )
        self.gap = self.sample(
            lambda: self.slow.time_gap(reference=self.ego, direction="longitudinal"),
            self.gap_low,
            0 * s,
        )
        self.headway = self.sample(
            lambda: self.ego.time_headway(reference=self.slow), self.headway_low, 0 * s
        )
        self.space = self.sample(
            lambda: self.ego.space_headway(reference=self.slow), self.near, 0 * m
        )

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.slow, lane(2), position(150 * m), speed(10 * mps))
        self.place(self.ego, lane(2), position(50 * m), speed(20 * mps))

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.slow.drive(speed(10 * mps)),
            self._ego_approach_then_evade(),
        )

    def _ego_approach_then_evade(self) -> Behaviour:
        return Serial(
            "ego: serial",
            Until(
                self.ego.drive("approach", speed(20 * mps)),
                self.near,
            ),
            self.ego.change_lane("evade", side="left", duration=1.5 * s),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return TriggerMeasures().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(TriggerMeasures))
