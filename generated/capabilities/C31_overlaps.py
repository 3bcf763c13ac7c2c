"""Scenario `overlaps`.

C31 Overlaps: how the second member of a parallel lies in time to the first one, which takes 4 s:
within it, around it, at its start, at its end, and by offsets of starts and ends.

Made by osc2tx from capabilities/C31_overlaps.osc: edit the scenario, not this module.
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


class Overlaps(Scenario):
    name = "overlaps"
    source = "capabilities/C31_overlaps.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())
        self.other = self.cast("other", Vehicle())

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(1), position(50 * m), speed(15 * mps))
        self.place(self.other, lane(3), position(150 * m), speed(15 * mps))

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.begin(),
            self.equal(),
            self.inside(),
            self.initial(),
            self.final(),
            self.full(),
            self.any_way(),
            self.offsets(),
            self.ends(),
        )

    def begin(self) -> Behaviour:
        return Parallel(
            "begin",
            self.ego.drive(speed(15 * mps), duration=1 * s),
            self.other.drive(speed(15 * mps), duration=1 * s),
        )

    def equal(self) -> Behaviour:
        return Parallel(
            "equal",
            self.ego.change_lane("e1", side="left", duration=4 * s),
            self.other.change_lane("e2", side="right", duration=4 * s),
            overlap="equal",
        )

    def inside(self) -> Behaviour:
        return Parallel(
            "inside",
            self.ego.change_lane("i1", side="right", duration=4 * s),
            self.other.drive("i2", duration=2 * s),
            overlap="inside",
        )

    def initial(self) -> Behaviour:
        return Parallel(
            "initial",
            self.ego.change_lane("n1", side="left", duration=4 * s),
            self.other.drive("n2", duration=2 * s),
            overlap="initial",
        )

    def final(self) -> Behaviour:
        return Parallel(
            "final",
            self.ego.change_lane("f1", side="right", duration=4 * s),
            self.other.drive("f2", duration=6 * s),
            overlap="final",
        )

    def full(self) -> Behaviour:
        return Parallel(
            "full",
            self.ego.change_lane("u1", side="left", duration=4 * s),
            self.other.drive("u2", duration=6 * s),
            overlap="full",
        )

    def any_way(self) -> Behaviour:
        return Parallel(
            "any_way",
            self.ego.change_lane("a1", side="right", duration=4 * s),
            self.other.drive("a2", duration=2 * s),
            overlap="any",
        )

    def offsets(self) -> Behaviour:
        return Parallel(
            "offsets",
            self.ego.change_lane("o1", side="left", duration=4 * s),
            self.other.drive("o2", duration=5 * s),
            overlap="any",
            start_to_start=1 * s,
        )

    def ends(self) -> Behaviour:
        return Parallel(
            "ends",
            self.ego.change_lane("d1", side="right", duration=4 * s),
            self.other.drive("d2", duration=3 * s),
            overlap="any",
            end_to_end=2 * s,
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Overlaps().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Overlaps))
