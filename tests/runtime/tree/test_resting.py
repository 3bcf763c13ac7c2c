"""Who has nothing to do is not visited, and is when it has."""

from collections import Counter

import pytest

from osc2tx_runtime import (
    Behaviour,
    Map,
    Parallel,
    RunSettings,
    Scenario,
    Serial,
    Until,
    Vehicle,
    elapsed,
    rise,
    run_scenario,
)
from osc2tx_runtime.language.tree import Event, Wait
from osc2tx_runtime.language.tree.base import Leaf, Node
from osc2tx_runtime.language.tree.compositions import Composition
from osc2tx_runtime.modifiers import lane, position, speed


class Waiting(Scenario):
    """All that a tree can wait for: a time, a condition, an event, the end of an action."""

    name = source = "waiting"

    def declare(self) -> None:
        self.road = self.cast("road", Map(map_file="highway"))
        self.car = self.cast("car", Vehicle())
        self.go = Event()

    def placement(self) -> None:
        self.place(self.car, lane(2), position(20.0), speed(10.0))

    def behavior(self) -> Behaviour:
        return Parallel(
            "all",
            Serial("timed", Wait(elapsed(20.0)), self.car.change_lane(num_of_lanes=1, side="left")),
            Serial("told", Wait(self.go), Wait(elapsed(1.0))),
            Until(
                self.car.drive(speed(15.0)),
                rise(lambda: self.car.position.x > 500.0),
            ),
        )


def test_a_tree_that_waits_is_not_visited(monkeypatch: pytest.MonkeyPatch) -> None:
    visits: Counter[str] = Counter()

    def counted(kind: type[Node]) -> None:
        pulse = kind.pulse

        def pulse_and_count(node: Node) -> object:
            visits[node.name] += 1
            return pulse(node)

        monkeypatch.setattr(kind, "pulse", pulse_and_count)

    for kind in (Leaf, Composition, Until):
        counted(kind)
    result = run_scenario(Waiting, RunSettings(signal={"go": 5.0}))
    assert result.status == "success"
    assert result.steps > 400
    assert max(visits.values()) <= 30, visits
