"""Scenario `overlaps`.

C31 Overlaps: how the second member of a parallel lies in time to the first one, which takes 4 s:
within it, around it, at its start, at its end, and by offsets of starts and ends.

Made by osc2tx from capabilities/C31_overlaps.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam; `one_of` is a race.
"""

from osc2tx_runtime import Behaviour, Map, Parallel, Scenario, Serial, Vehicle, main, require_api
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import m, mps, s

require_api(1)


class Overlaps(Scenario):
    """Scenario `overlaps` (capabilities/C31_overlaps.osc:7)."""

    name = "overlaps"
    source = "capabilities/C31_overlaps.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = Map(map_file="highway.xodr")
        self.ego = Vehicle()
        self.other = Vehicle()

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(1), position(50 * m), speed(15 * mps))
        self.place(self.other, lane(3), position(150 * m), speed(15 * mps))

    def behavior(self) -> Behaviour:  # capabilities/C31_overlaps.osc:12
        return Serial(
            "overlaps",
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

    def begin(self) -> Behaviour:  # capabilities/C31_overlaps.osc:13
        return Parallel(
            "begin",
            self.ego.drive(speed(15 * mps), duration=1 * s),
            self.other.drive(speed(15 * mps), duration=1 * s),
        )

    def equal(self) -> Behaviour:  # capabilities/C31_overlaps.osc:22
        return Parallel(
            "equal",
            self.ego.change_lane(side="left", duration=4 * s, label="e1"),
            self.other.change_lane(side="right", duration=4 * s, label="e2"),
            overlap="equal",
        )

    def inside(self) -> Behaviour:  # capabilities/C31_overlaps.osc:25
        return Parallel(
            "inside",
            self.ego.change_lane(side="right", duration=4 * s, label="i1"),
            self.other.drive(duration=2 * s, label="i2"),
            overlap="inside",
        )

    def initial(self) -> Behaviour:  # capabilities/C31_overlaps.osc:28
        return Parallel(
            "initial",
            self.ego.change_lane(side="left", duration=4 * s, label="n1"),
            self.other.drive(duration=2 * s, label="n2"),
            overlap="initial",
        )

    def final(self) -> Behaviour:  # capabilities/C31_overlaps.osc:31
        return Parallel(
            "final",
            self.ego.change_lane(side="right", duration=4 * s, label="f1"),
            self.other.drive(duration=6 * s, label="f2"),
            overlap="final",
        )

    def full(self) -> Behaviour:  # capabilities/C31_overlaps.osc:34
        return Parallel(
            "full",
            self.ego.change_lane(side="left", duration=4 * s, label="u1"),
            self.other.drive(duration=6 * s, label="u2"),
            overlap="full",
        )

    def any_way(self) -> Behaviour:  # capabilities/C31_overlaps.osc:37
        return Parallel(
            "any_way",
            self.ego.change_lane(side="right", duration=4 * s, label="a1"),
            self.other.drive(duration=2 * s, label="a2"),
            overlap="any",
        )

    def offsets(self) -> Behaviour:  # capabilities/C31_overlaps.osc:40
        return Parallel(
            "offsets",
            self.ego.change_lane(side="left", duration=4 * s, label="o1"),
            self.other.drive(duration=5 * s, label="o2"),
            start_to_start=1 * s,
        )

    def ends(self) -> Behaviour:  # capabilities/C31_overlaps.osc:43
        return Parallel(
            "ends",
            self.ego.change_lane(side="right", duration=4 * s, label="d1"),
            self.other.drive(duration=3 * s, label="d2"),
            overlap="any",
            end_to_end=2 * s,
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Overlaps().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Overlaps))
