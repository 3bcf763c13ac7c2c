"""Measures against closed forms: what paper says of straight motions."""

from __future__ import annotations

import math
import random
import tracemalloc
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from osc2tx.campaigns import CampaignError
from osc2tx.campaigns.sampling import wanted_rows
from osc2tx_runtime.campaigns import Condition, Executor, Row
from osc2tx_runtime.errors import SettingsError
from osc2tx_runtime.kpis import MEASURES, encroachment, measures_by_name, registry
from osc2tx_runtime.kpis.measure import Measure, Moving, Scene
from osc2tx_runtime.kpis.pairs import MinGap, MinTimeGap, MinTimeToCollision, box_distance
from osc2tx_runtime.kpis.registry import (
    MaxDeceleration,
    MaxJerk,
    MaxLateralAcceleration,
    MinEncroachment,
)
from osc2tx_runtime.world.actor_dimensions import Shape
from osc2tx_runtime.world.measuring.collision import Box, box_of
from osc2tx_runtime.world.state import ActorState
from tests.campaigns.kit import DRIVES, plan_of

DT = 0.05
CAR = Shape(4.0, 2.0, 1.5, 2.0)  # the reference point is the centre

Course = Callable[[float], tuple[float, float, float, float, float]]
"""Time to x, y, heading, speed and acceleration."""


def observed(measure: Measure, seconds: float, **courses: Course) -> dict[str, float | None]:
    """Return what a measure makes of actors on their courses."""
    context: Any = None
    for step in range(round(seconds / DT) + 1):
        actors = []
        for name, course in courses.items():
            x, y, h, v, a = course(step * DT)
            state = ActorState(x, y, 0.0, h, v, a, None, 0.0, CAR)
            box = box_of(state)
            reach = math.hypot(box.half_length, box.half_width)
            actors.append(Moving(name, state, box, v * math.cos(h), v * math.sin(h), reach))
        measure.observe(Scene(step, step * DT, DT, tuple(actors), context))
    return dict(measure.results())


def along(start: float, speed: float, y: float = 0.0) -> Course:
    return lambda t: (start + speed * t, y, 0.0, speed, 0.0)


def across(start: float, speed: float, x: float = 0.0) -> Course:
    return lambda t: (x, start + speed * t, math.pi / 2, speed, 0.0)


def test_time_to_collision_of_one_behind_the_other() -> None:
    """50 m - 4 m between the bumpers at 10 m/s: 4.6 s at first, 2.6 s after 2 s."""
    found = observed(MinTimeToCollision(), 2.0, a=along(0.0, 30.0), b=along(50.0, 20.0))
    assert found["min_ttc"] == found["min_ttc(a,b)"] == pytest.approx(2.6)


def test_time_to_collision_of_two_that_cross() -> None:
    """Both need to come to within 1 + 2 m of the crossing, the front of `a` after 1.7 s."""
    found = observed(MinTimeToCollision(), 0.0, a=along(-20.0, 10.0), b=across(-20.0, 10.0))
    assert found["min_ttc"] == pytest.approx(1.7)


def test_no_time_to_collision_without_such_a_course() -> None:
    assert observed(MinTimeToCollision(), 1.0, a=along(0.0, 20.0), b=along(50.0, 30.0)) == {
        "min_ttc": None
    }
    beside = observed(MinTimeToCollision(), 1.0, a=along(0.0, 30.0), b=along(50.0, 20.0, y=2.1))
    assert beside == {"min_ttc": None}


def test_gap_is_that_between_bumpers() -> None:
    found = observed(MinGap(), 3.0, a=along(0.0, 30.0), b=along(50.0, 20.0))
    assert found["min_gap"] == pytest.approx(46.0 - 30.0)
    aside = observed(MinGap(), 10.0, a=along(0.0, 30.0), b=along(50.0, 20.0, y=3.5))
    assert aside["min_gap"] == pytest.approx(1.5)


def test_time_gap_is_that_of_the_one_behind() -> None:
    found = observed(MinTimeGap(), 1.0, a=along(0.0, 20.0), b=along(34.0, 20.0))
    assert found == {"min_time_gap": pytest.approx(1.5), "min_time_gap(a,b)": pytest.approx(1.5)}
    assert observed(MinTimeGap(), 1.0, a=along(0.0, 20.0), b=along(34.0, 20.0, y=2.1)) == {
        "min_time_gap": None
    }


def test_post_encroachment_time_at_a_crossing() -> None:
    """`a` has left the 2 m wide way of `b` at 13 m, after 1.3 s; `b` enters it at 17 m, 1.7 s."""
    found = observed(MinEncroachment(), 5.0, a=along(-10.0, 10.0), b=across(-20.0, 10.0))
    assert found["min_pet"] == pytest.approx(0.4, abs=2 * DT)
    apart = observed(MinEncroachment(), 5.0, a=along(0.0, 10.0), b=along(0.0, 10.0, y=2.1))
    assert apart == {"min_pet": None}


def test_post_encroachment_time_of_who_follows_is_the_time_gap_and_a_length() -> None:
    """The place of a rear bumper is free until the front bumper behind comes: 30 m at 20 m/s."""
    found = observed(MinEncroachment(), 5.0, a=along(0.0, 20.0), b=along(34.0, 20.0))
    assert found["min_pet"] == pytest.approx(1.5, abs=2 * DT)


def test_braking_and_jerk() -> None:
    def brakes(t: float) -> tuple[float, float, float, float, float]:
        """Speed 20 m/s; from 1 s on its acceleration falls by 2 m/s^3, down to -4 m/s^2."""
        ramp = min(max(t - 1.0, 0.0), 2.0)
        speed = 20.0 - ramp * ramp - 4.0 * max(t - 3.0, 0.0)
        return 0.0, 0.0, 0.0, speed, -2.0 * ramp

    assert observed(MaxDeceleration(), 4.0, a=brakes)["max_deceleration"] == pytest.approx(4.0)
    assert observed(MaxJerk(), 4.0, a=brakes)["max_jerk"] == pytest.approx(2.0)


def test_acceleration_to_the_side_is_that_of_a_circle() -> None:
    def circle(t: float) -> tuple[float, float, float, float, float]:
        angle = 15.0 / 45.0 * t  # 15 m/s around 45 m, through the jump of the heading at pi
        heading = math.remainder(angle + math.pi / 2, math.tau)
        return 45.0 * math.cos(angle), 45.0 * math.sin(angle), heading, 15.0, 0.0

    found = observed(MaxLateralAcceleration(), 20.0, a=circle)
    assert found["max_lateral_acceleration"] == pytest.approx(15.0**2 / 45.0)


def test_distance_of_boxes_is_the_least_of_all_their_points() -> None:
    """Compared with points on the edges of both, a millimetre or so apart."""
    generator = random.Random(1)
    for _ in range(40):
        boxes = [_box(generator) for _ in range(2)]
        least = min(math.dist(p, q) for p in _edge(boxes[0]) for q in _edge(boxes[1]))
        found = box_distance(*boxes)
        assert found == box_distance(*reversed(boxes)) or math.isclose(
            found, box_distance(*reversed(boxes))
        )
        if found > 0.0:
            assert found <= least + 1e-9 and least - found < 0.2


def _box(generator: random.Random) -> Box:
    x, y, h = (generator.uniform(-6.0, 6.0) for _ in range(3))
    return box_of(ActorState(x, y, 0.0, h, 0.0, 0.0, None, 0.0, CAR))


def _edge(box: Box) -> list[tuple[float, float]]:
    points = []
    for index in range(41):
        share = index / 20.0 - 1.0
        for i, j in ((share, 1.0), (share, -1.0), (1.0, share), (-1.0, share)):
            along_, across_ = i * box.half_length, j * box.half_width
            x = box.x + along_ * box.cos - across_ * box.sin
            points.append((x, box.y + along_ * box.sin + across_ * box.cos))
    return points


CRASH = """import osc.standard

scenario crash:
    slow: vehicle
    fast: vehicle
    do parallel(duration: 6s):
        slow.drive() with:
            lane(2, at: start)
            position(100m, at: start)
            speed(10mps)
        fast.drive() with:
            lane(2, at: start)
            position(50m, at: start)
            speed(25mps)
"""


def test_a_run_measures_its_collision() -> None:
    """Told to drive through: the contact is at 15 m/s, time to collision goes down to nothing."""
    executor = Executor(plan_of(CRASH, *MEASURES))
    result = executor.run(Row(0, 0))
    executor.close()
    assert result.status == "success"
    assert result.measures["collisions"] == 1.0
    assert result.measures["collision_speed"] == pytest.approx(15.0)
    ((time, one, other, speed),) = result.collisions
    assert {one, other} == {"slow", "fast"} and speed == pytest.approx(15.0)
    assert 2.5 < time < 3.5  # 50 m less the parts of the cars that stick out, at 15 m/s
    assert result.measures["min_gap"] == result.measures["min_pet"] == 0.0
    assert result.measures["min_ttc"] == 0.0
    assert result.measures["off_road"] == result.measures["red_lights"] == 0.0


@pytest.mark.parametrize(
    ("condition", "status"),
    [("min_gap<=0", "failure"), ("collision_speed>15.1", "success"), ("min_gap<0", "success")],
)
def test_a_row_fails_if_a_measure_says_so(condition: str, status: str) -> None:
    plan = replace(plan_of(CRASH, "min_gap", "collisions"), fail_if=(Condition.parse(condition),))
    executor = Executor(plan)
    result = executor.run(Row(0, 0))
    executor.close()
    assert result.status == status
    assert (result.reason == "min_gap 0 <= 0") == (status == "failure")


@pytest.mark.parametrize("text", ["min_ttc", "min_ttc=1", "min_ttc<soon"])
def test_what_is_no_condition(text: str) -> None:
    with pytest.raises(SettingsError, match="write MEASURE<NUMBER"):
        Condition.parse(text)


def test_a_condition_on_a_value_that_no_measure_has_is_refused() -> None:
    """It would never hold, and no row would fail."""
    plan = plan_of(CRASH, "min_gap", "collisions")
    good = ("min_gap<1", "min_gap(ego,other)<1", "collision_speed>1")
    wanted_rows(replace(plan, fail_if=tuple(map(Condition.parse, good))), None, 1, 3)
    for text in ("min_gab<1", "min_ttc<1"):
        with pytest.raises(CampaignError, match="available: min_gap, collisions, collision_speed"):
            wanted_rows(replace(plan, fail_if=(Condition.parse(text),)), None, 1, 3)


def test_measures_do_not_change_the_run() -> None:
    text = f"import osc.standard\n\nscenario plain:{DRIVES}"
    digests = set()
    for measures in ((), tuple(MEASURES)):
        executor = Executor(replace(plan_of(text, *measures), digests=True))
        digests.add(executor.run(Row(0, 0)).digest)
        executor.close()
    assert len(digests) == 1


def test_own_measures_are_found_by_their_entry_point(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "own_kpis.py").write_text(
        "class Steps:\n"
        "    def __init__(self): self.count = 0\n"
        "    def observe(self, scene): self.count = scene.step\n"
        "    def results(self): return {'steps': float(self.count)}\n"
    )
    info = tmp_path / "own_kpis-1.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: own-kpis\nVersion: 1\n")
    (info / "entry_points.txt").write_text("[osc2tx.kpis]\nsteps = own_kpis:Steps\n")
    monkeypatch.syspath_prepend(str(tmp_path))
    executor = Executor(plan_of(f"import osc.standard\n\nscenario plain:{DRIVES}", "steps"))
    result = executor.run(Row(0, 0))
    executor.close()
    assert result.measures == {"steps": float(result.steps)}
    with pytest.raises(SettingsError, match="there is no such measure; available: min_ttc"):
        measures_by_name(["min_tttc"])


@pytest.mark.parametrize(
    ("results", "reason"),
    [
        ("{'steps': '3'}", "measure Steps: its value steps is '3', no number or None"),
        ("1 / 0", "measure Steps raised ZeroDivisionError"),
        ("3", "measure Steps raised TypeError"),
    ],
)
def test_what_own_measures_do_wrong_is_an_error_of_the_row(
    results: str, reason: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Steps:
        def observe(self, scene: Scene) -> None: ...

        def results(self) -> Any:
            return eval(results)

    monkeypatch.setattr(registry, "MEASURES", {"steps": Steps})
    executor = Executor(plan_of(f"import osc.standard\n\nscenario plain:{DRIVES}", "steps"))
    result = executor.run(Row(0, 0))
    executor.close()
    assert (result.status, result.measures) == ("error", {})
    assert reason in result.reason


def test_encroachment_is_that_of_all_pairs_of_places(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(encroachment, "_MOST", 50)
    compared = 0
    for seed in range(20):
        chance = random.Random(seed)
        ways = {name: wandering(chance) for name in ("one", "other")}
        found = observed(MinEncroachment(), 6.0, **ways)["min_pet"]
        boxes = [
            [(step * DT, boxed(*way(step * DT))) for step in range(121)] for way in ways.values()
        ]
        gaps = [
            abs(one[0] - other[0])
            for one in boxes[0]
            for other in boxes[1]
            if box_distance(one[1], other[1]) == 0.0
        ]
        assert found == (pytest.approx(min(gaps), abs=1e-9) if gaps else None)
        compared += bool(gaps)
    assert 5 < compared < 20


def boxed(x: float, y: float, h: float, v: float, a: float) -> Box:
    return box_of(ActorState(x, y, 0.0, h, v, a, None, 0.0, CAR))


def wandering(chance: random.Random) -> Course:
    """A circle, with a pause."""
    x, y, turn = chance.uniform(-15, 15), chance.uniform(-15, 15), chance.uniform(-0.5, 0.5)

    def at(time: float) -> tuple[float, float, float, float, float]:
        gone = min(time, 2.0) + max(time - 3.0, 0.0)
        h = turn * gone
        return x + 5.0 * gone * math.cos(h), y + 5.0 * gone * math.sin(h), h, 5.0, 0.0

    return at


def test_long_ways_take_little_memory() -> None:
    """20,000 steps: a table of all pairs of them would take 3 GB."""
    count = 20_000
    places = np.column_stack([np.arange(count), np.arange(count), 0.5 * np.arange(count)])
    rest = np.tile([0.0, 1.0, 0.0, 2.0, 1.0], (count, 1))
    one = np.hstack([places, rest])
    other = one + np.array([100.0, 100.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    tracemalloc.start()
    try:
        assert encroachment._least(one, other) == 92.0  # boxes of 4 m, half a metre each step
        assert tracemalloc.get_traced_memory()[1] < 200e6
    finally:
        tracemalloc.stop()
