"""Scenario `own_actions`.

Made by osc2tx from input.osc: edit the scenario, not this module.
OpenSCENARIO DSL 2.1, dialect asam; `one_of` is a race.
"""

from osc2tx_runtime import Behaviour, Map, Parallel, Scenario, Serial, Vehicle, main, require_api
from osc2tx_runtime.modifiers import speed
from osc2tx_runtime.units import kph, mps, s

require_api(1)


class OwnActions(Scenario):
    name = "own_actions"
    source = "input.osc"

    def declare(self) -> None:
        """Cast, events and values."""
        self.road = Map(map_file="highway.xodr")
        self.ego = Vehicle()
        self.other = Vehicle()

    def behavior(self) -> Behaviour:
        return Serial(
            "own_actions",
            self.ego.honk(times=3, loudness=0.5, at_whom=self.ego),
            self.ego_parallel(),
            self.ego.honk(speed(20 * kph), times=2, loudness=0.5, at_whom=self.ego),
        )

    def ego_parallel(self) -> Behaviour:
        return Parallel(
            "ego: parallel",
            self.ego.keep_honking(
                times=1, at_whom=self.other, loudness=0.5, pause=2 * s, duration=6 * s
            ),
            self.ego.drive(speed(10 * mps)),
        )


def create_root() -> Behaviour:
    """Return the behavior tree, for py-trees-render and other viewers."""
    return OwnActions().create_tree()


if __name__ == "__main__":
    raise SystemExit(main(OwnActions))
