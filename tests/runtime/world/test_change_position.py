"""Going to a place on a way of one's own."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from osc2tx_runtime import (
    Behaviour,
    Map,
    Person,
    Scenario,
    Vehicle,
)
from osc2tx_runtime.domain.actors import OdrPoint, Point
from osc2tx_runtime.modifiers import position, yaw
from tests.runtime.world.two_cars import TwoCars, scenario

Run = Callable[..., Any]


@pytest.mark.parametrize(
    "target",
    [
        {"target_xyz": Point(150.0, -5.25)},
        {"target_position": OdrPoint("1", "-2", 150.0)},
        {"target_odr": OdrPoint("1", -2, 150.0, 0.0)},
    ],
)
def test_change_position_on_the_road(run: Run, target: dict[str, Any]) -> None:
    done = run(scenario(lambda s: s.a.change_position(**target)))
    assert done.result.status == "success"
    last = done.states("a")[-1]
    assert (last["x"], last["y"]) == pytest.approx((150.0, -5.25), abs=0.55)
    assert (last["lane"], last["h"]) == (-2, pytest.approx(0.0, abs=0.02))


def test_change_position_across_the_grass(run: Run) -> None:
    def body(s: TwoCars) -> Behaviour:
        return s.a.change_position(
            target_xyz=Point(120.0, 30.0), on_road_network=False, interpolation="smooth"
        )

    last = run(scenario(body)).states("a")[-1]
    assert (last["x"], last["y"]) == pytest.approx((120.0, 30.0), abs=0.6)


def test_change_position_behind_is_no_way(run: Run) -> None:
    done = run(scenario(lambda s: s.a.change_position(target_xyz=Point(20.0, -8.75))))
    assert done.result.status == "failure"
    assert "no route along lanes leads" in done.result.reason


def test_a_person_walks_to_a_place(run: Run) -> None:
    class Walk(Scenario):
        name = source = "walk"

        def declare(self) -> None:
            self.road = Map(map_file="crossing")
            self.walker = Person()

        def placement(self) -> None:
            self.place(
                self.walker, position(at_point=Point(250.0, -6.0), project_on_route=False), yaw(0.0)
            )

        def behavior(self) -> Behaviour:
            return self.walker.change_position(target_xyz=Point(250.0, 6.0))

    states = run(Walk).states("walker")
    assert (states[-1]["x"], states[-1]["y"]) == pytest.approx((250.0, 6.0), abs=0.1)


def test_on_a_curved_road_a_path_follows_the_lane(run: Run) -> None:
    class Curved(Scenario):
        name = source = "curved"

        def declare(self) -> None:
            self.road = Map(map_file="crossing")
            self.a = Vehicle()

        def behavior(self) -> Behaviour:
            return self.a.change_position(
                target_xyz=lambda: ahead(self, 60.0), on_road_network=True
            )

    def ahead(s: Any, distance: float) -> Point:
        state, road_map = s.a.state, s.a.context.world.map
        pose = road_map.pose(road_map.advance(state.lane_position, distance).position)
        return Point(pose.x, pose.y, pose.z)

    done = run(Curved)
    assert done.result.status == "success"
    assert max(abs(e["offset"]) for e in done.states("a")) < 0.2
