"""Scenario `cut_in`.

Another car overtakes the ego vehicle and cuts in with a short gap.

Made by osc2tx from cut_in.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    Parallel,
    Scenario,
    Serial,
    Until,
    Vehicle,
    main,
    require_api,
    rise,
    within,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import kph, m, s

require_api(1)


class CutIn(Scenario):
    name = "cut_in"
    source = "cut_in.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())
        self.other = self.cast("other", Vehicle())

        self.v_ego = self.parameter("v_ego", 70 * kph, unit="kph")
        # Faster than the ego vehicle, but not by much
        self.v_other = self.parameter("v_other", within(80 * kph, 95 * kph), unit="kph")
        self.gap = self.parameter("gap", 8 * m, unit="m")

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(2), position(200 * m), speed(self.v_ego))
        self.place(
            self.other,
            lane(side_of=self.ego, side="left"),
            position(30 * m, behind=self.ego),
            speed(self.v_other),
        )

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self.ego.drive("ego_drives", speed(self.v_ego)),
            self.other_cuts_in(),
        )

    def other_cuts_in(self) -> Behaviour:
        return Serial(
            "other_cuts_in",
            Until(
                self.other.drive("overtake", speed(self.v_other)),
                rise(
                    lambda: self.other.space_gap(reference=self.ego, direction="longitudinal")
                    > self.gap
                ),
            ),
            self.other.change_lane(num_of_lanes=1, side="right"),
            self.other.drive("settle", speed(self.v_ego, at="end"), duration=5 * s),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return CutIn().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(CutIn))
