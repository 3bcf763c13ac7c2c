"""Scenario `entering`.

C30 Serial execution: actors whose first action begins later are there by then.

Made by osc2tx from capabilities/C30_entering.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
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
from osc2tx_runtime.modifiers import lane, position, speed, yaw
from osc2tx_runtime.units import deg, m, mps, s

require_api(1)


class Entering(Scenario):
    name = "entering"
    source = "capabilities/C30_entering.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.lead = self.cast("lead", Vehicle())
        # Drives beside the lead from the start, since it has to be ahead of it by then.
        self.merging = self.cast("merging", Vehicle())
        # Waits off the road until it is time to set out.
        self.walker = self.cast("walker", Person())
        self.kerb = self.argument("kerb", Point(x=300 * m, y=-20 * m, z=0 * m))

    def placement(self) -> None:
        """Where the actors are when the scenario starts."""
        self.place(self.lead, position(50 * m), lane(2), speed(15 * mps))

    def behavior(self) -> Behaviour:
        return Serial(
            self.name,
            self.cruise(),
            self.merge(),
        )

    def cruise(self) -> Behaviour:
        return Parallel(
            "cruise",
            self.lead.drive(lane(2), speed(15 * mps)),
            Wait(elapsed(4 * s)),
        )

    def merge(self) -> Behaviour:
        return Parallel(
            "merge",
            self.lead.drive(speed(15 * mps)),
            self.merging.drive(
                position(20 * m, ahead_of=self.lead, at="start"),
                lane(1, at="start"),
                speed(18 * mps),
            ),
            self.walker.walk(
                position(at_point=self.kerb, project_on_route=False, at="start"),
                yaw(90 * deg, at="start"),
                speed(1.4 * mps),
            ),
            duration=3 * s,
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Entering().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Entering))
