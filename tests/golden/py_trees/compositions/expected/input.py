"""Scenario `compositions`.

Made by osc2tx from input.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam; `one_of` is a race.
"""

from osc2tx_runtime import (
    Behaviour,
    Map,
    OneOf,
    Parallel,
    Scenario,
    Serial,
    Until,
    Vehicle,
    Wait,
    elapsed,
    main,
    require_api,
)
from osc2tx_runtime.units import s

require_api(1)


class Compositions(Scenario):
    name = "compositions"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = self.cast("road", Map(map_file="highway.xodr"))
        self.ego = self.cast("ego", Vehicle())
        self.other = self.cast("other", Vehicle())

    def behavior(self) -> Behaviour:
        """Everything at once."""
        return Parallel(
            self.name,
            self._ego_drive_then_keep_speed(),
            self.with_limit(),
            self.other.keep_speed(duration=1 * s),
            duration=20 * s,
            overlap="any",
        )

    def _ego_drive_then_keep_speed(self) -> Behaviour:
        """the ego vehicle."""
        return Serial(
            "ego: serial",
            self.ego.drive(duration=2 * s),
            # deep inside
            OneOf(
                "ego: keep_speed or inner",
                self.ego.keep_speed(duration=4 * s),
                self.inner(),
                # nothing below
            ),
        )

    def inner(self) -> Behaviour:
        return Serial(
            "inner",
            Wait(elapsed(1 * s)),
            self.ego.change_lane(num_of_lanes=1, side="left"),
        )

    def with_limit(self) -> Behaviour:
        """the other one."""
        return Until(
            Serial(
                "with_limit",
                self.other.drive(),
                duration=(3 * s, 5 * s),
            ),
            elapsed(4 * s),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return Compositions().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(Compositions))
