"""Scenario `reactions`.

Made by osc2tx from input.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam.
"""

from osc2tx_runtime import (
    Behaviour,
    Emit,
    Event,
    Map,
    On,
    Parallel,
    Scenario,
    Serial,
    Until,
    Vehicle,
    elapsed,
    main,
    require_api,
    rise,
)
from osc2tx_runtime.units import kph, m, s

require_api(1)


class Reactions(Scenario):
    name = "reactions"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())
        self.other = self.cast("other", Vehicle())
        self.seen = Event()
        self.reported = Event()

    def behavior(self) -> Behaviour:
        return Parallel(
            self.name,
            self._ego_drive_serial(),
            # As soon as the other one is near, whatever else happens
            On(
                rise(
                    lambda: self.ego.object_distance(reference=self.other, direction="euclidean")
                    < 20 * m
                ),
                Emit(self.seen),
            ),
            On(
                self.seen,
                # once more
                Emit(self.reported),
                condition=lambda: self.ego.speed > 10 * kph,
            ),
        )

    def _ego_drive_serial(self) -> Behaviour:
        return Serial(
            "do serial",
            Until(
                self.ego.drive(),
                Event(self.reported, condition=lambda: self.other.speed > 1 * kph),
                elapsed(9 * s),
            ),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Reactions().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Reactions))
