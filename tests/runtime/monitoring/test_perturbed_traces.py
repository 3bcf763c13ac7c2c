"""A good trace has no violation; perturbed beyond its tolerance, it has the one of the modifier."""

from __future__ import annotations

import math
from dataclasses import dataclass

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from osc2tx_runtime import Behaviour, Parallel, Path, Point, Pose, Serial, Trajectory
from osc2tx_runtime.domain.modifiers import MODIFIERS
from osc2tx_runtime.domain.monitoring.registry import CLARIFIED, MONITORS, UNMONITORED
from osc2tx_runtime.modifiers import (
    acceleration,
    along,
    change_lane,
    change_speed,
    distance,
    keep_lane,
    keep_position,
    keep_speed,
    lane,
    lateral,
    orientation,
    position,
    speed,
    yaw,
)
from tests.runtime.world.two_cars import TwoCars

from .kit import (
    Body,
    Change,
    accelerated,
    ahead,
    faster,
    found,
    lanes_left,
    left,
    tilted,
    turned,
)

ALL, START, END = "all", "start", "end"


@dataclass(frozen=True)
class Case:
    """A modifier or action that holds in a trace, and what breaks it.

    Attributes:
        name: Of the modifier, or of the action that states it.
        body: The behavior.
        change: What changes in the state of `actor`.
        tolerance: By how much it may change (of the unit of the change).
        at: At which states it counts.
        actor: Whose state it is.
        slack: What may change within the last step on top.
    """

    name: str
    body: Body
    change: Change
    tolerance: float
    at: str = ALL
    actor: str = "a"
    slack: float = 0.0

    def __str__(self) -> str:
        return f"{self.name}-{self.at}-{self.change.__name__}-{self.actor}"


def two(*modifiers: object) -> Body:
    """Both drive for 2 s, `a` with modifiers."""
    return lambda s: Parallel("both", s.a.drive(*modifiers), s.b.drive(speed(12.0)), duration=2.0)


def beside(make: object) -> Body:
    """Likewise, with a modifier that refers to `b`."""
    return lambda s: Parallel(
        "both", s.a.drive(make(s)), s.b.drive(speed(12.0)), duration=2.0  # type: ignore[operator]
    )


LINE = (Pose(50.0, -8.75, 0.0), Pose(90.0, -8.75, 0.0))
"""Straight on from where `a` starts, in 4 s."""


def gap(action: str) -> Body:
    """`a` gets to a gap of 30 m behind `b`."""
    return lambda s: getattr(s.a, action)(target=30.0, direction="behind", reference=s.b)


def kept(action: str) -> Body:
    """`a` keeps a gap or headway to `b`, which is as fast."""
    return lambda s: Serial(
        "all",
        s.b.change_speed(target=10.0),
        Parallel("kept", getattr(s.a, action)(reference=s.b), s.b.keep_speed(), duration=2.0),
    )


def standing(s: TwoCars, action: Behaviour) -> Behaviour:
    """`a` stands for 2 s."""
    return Serial("all", s.a.assign_speed(speed=0.0), Parallel("stands", action, duration=2.0))


# One step at 10 m/s is 0.5 m.
CASES = [
    Case("speed", two(speed(10.0)), faster, 0.05),
    Case("speed", two(speed(10.0, at="end")), faster, 0.05, END),
    Case("speed", beside(lambda s: speed(2.0, slower_than=s.b)), faster, 0.05),
    Case("speed", beside(lambda s: speed(2.0, slower_than=s.b)), faster, 0.05, ALL, "b"),
    Case("keep_speed", two(keep_speed()), faster, 0.05),
    Case("change_speed", two(change_speed(2.0)), faster, 0.05, END),
    Case("acceleration", two(acceleration(1.0)), accelerated, 0.1),
    Case("lane", two(lane(2)), lanes_left, 0.0),
    Case("lane", two(lane(2, at="end")), lanes_left, 0.0, END),
    Case("lane", beside(lambda s: lane(same_as=s.b)), lanes_left, 0.0, ALL, "b"),
    Case("lane", beside(lambda s: lane(same_as=s.b, at="end")), lanes_left, 0.0, END, "b"),
    Case("keep_lane", two(keep_lane()), lanes_left, 0.0),
    Case("lateral", two(lateral(0.0)), left, 0.1),
    Case("lateral", two(lateral(0.0, at="end")), left, 0.1, END),
    Case("lateral", beside(lambda s: lateral(0.0, side_of=s.b)), left, 0.1, ALL, "b"),
    Case(
        "position",
        beside(lambda s: position(40.0, behind=s.b, at="end")),
        ahead,
        0.1,
        END,
        slack=0.65,
    ),
    Case("yaw", two(yaw(0.0)), turned, 0.01),
    Case("orientation", two(orientation(yaw=0.0)), turned, 0.01),
    Case(
        "change_lane",
        lambda s: s.a.drive(change_lane(1, "left"), duration=5.0),
        lanes_left,
        0.0,
        END,
    ),
    Case("distance", two(distance(20.0)), ahead, 0.1, END, slack=1.7),
    # --- actions ---
    Case("speed", lambda s: s.a.change_speed(target=12.0), faster, 0.05, END, slack=0.5),
    Case("keep_speed", lambda s: s.a.keep_speed(duration=2.0), faster, 0.05),
    Case("change_lane", lambda s: s.a.change_lane(side="left"), lanes_left, 0.0, END),
    Case("lateral", lambda s: s.a.change_lane(side="left"), left, 0.1, END),
    Case("keep_lane", lambda s: s.a.follow_lane(duration=2.0), lanes_left, 0.0),
    Case("lateral", lambda s: s.a.follow_lane(duration=2.0), left, 0.1),
    Case("change_space_gap", gap("change_space_gap"), ahead, 0.1, END, slack=0.65),
    Case("change_space_headway", gap("change_space_headway"), ahead, 0.1, END, slack=0.65),
    Case("keep_space_gap", kept("keep_space_gap"), ahead, 0.1, END, slack=0.65),
    Case("keep_space_headway", kept("keep_space_headway"), ahead, 0.1, END, slack=0.65),
    Case("keep_time_headway", kept("keep_time_headway"), faster, 0.05, END, slack=0.5),
    Case("keep_position", lambda s: standing(s, s.a.drive(keep_position())), ahead, 0.1),
    Case("keep_position", lambda s: standing(s, s.a.remain_stationary()), left, 0.1),
    Case("along", lambda s: s.a.follow_path(absolute=Path(LINE)), left, 0.1),
    Case("along", lambda s: s.a.drive(along(Path(LINE))), left, 0.1),
    Case(
        "along_trajectory",
        lambda s: s.a.follow_trajectory(absolute=Trajectory(LINE, (0.0, 4.0))),
        ahead,
        0.1,
    ),
    Case(
        "change_position",
        lambda s: s.a.change_position(target_xyz=Point(90.0, -8.75, 0.0)),
        ahead,
        0.1,
        END,
        slack=0.55,
    ),
]


@pytest.mark.parametrize("case", CASES, ids=str)
def test_a_good_trace_has_none(case: Case) -> None:
    assert found(case.body) == []


@settings(max_examples=20, deadline=None)
@given(step=st.integers(1, 39), by=st.floats(-3.0, 3.0))
@pytest.mark.parametrize("case", CASES, ids=str)
def test_a_perturbed_one_has_that_of_the_modifier(case: Case, step: int, by: float) -> None:
    size = math.copysign(1.0, by) if case.change is lanes_left else by
    if case.change in (turned, tilted):
        size = 0.1 * by
    if abs(abs(size) - case.tolerance) < 1e-3 + case.slack:
        return
    where = -1 if case.at == END else step
    names = {each.modifier for each in found(case.body, [(case.actor, where, case.change, size)])}
    assert (case.name in names) == (abs(size) > case.tolerance)


def test_every_modifier_has_a_monitor_or_a_reason() -> None:
    of_the_map = {name for name, kind in MODIFIERS.items() if ".map." in kind.__module__}
    assert MODIFIERS.keys() - of_the_map == MONITORS.keys() | (
        UNMONITORED.keys() & MODIFIERS.keys()
    )
    assert not MONITORS.keys() & UNMONITORED.keys()
    assert not CLARIFIED.keys() & UNMONITORED.keys()
