"""Scenario `semantic_validation`.

C35 Semantic validation: names, types, units, events and the domain of each value are checked
before anything is built. The tests break this scenario in many ways and look for the report.

Made by osc2tx from capabilities/C35_semantic_validation.osc: edit the scenario, not this module.
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
    main,
    require_api,
    rise,
    within,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import m, mps

require_api(1)


class SemanticValidation(Scenario):
    name = "semantic_validation"
    source = "capabilities/C35_semantic_validation.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())
        self.other = self.cast("other", Vehicle())

        self.v_ego = self.parameter("v_ego", within(10 * mps, 20 * mps), unit="mps")
        self.v_other = self.parameter("v_other", 12 * mps, unit="mps")
        self.gap = self.parameter("gap", 15 * m, unit="m")

        self.near = Event(
            rise(
                lambda: self.ego.object_distance(reference=self.other, direction="euclidean")
                < 2 * self.gap
            )
        )

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.ego, lane(2), position(50 * m), speed(self.v_ego))
        self.place(self.other, lane(2), position(60 * m, ahead_of=self.ego), speed(self.v_other))

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self._ego_approach_then_evade(),
            self.other.drive(speed(self.v_other)),
        )

    def _ego_approach_then_evade(self) -> Behaviour:
        return Serial(
            "ego: serial",
            Until(
                self.ego.drive("approach", speed(self.v_other + 5 * mps)),
                self.near,
            ),
            self.ego.change_lane("evade", num_of_lanes=1, side="left"),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return SemanticValidation().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(SemanticValidation))
