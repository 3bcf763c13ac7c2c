"""Ninety more readings of §8.8 and §8.9, judged by states alone.

The outcomes are those of `test_modifiers_to_the_letter`: they were worked out from the text before
anything ran.
"""

from __future__ import annotations

from itertools import pairwise

import pytest

from tests.unit.cli.shell import Shell

from .test_modifiers_to_the_letter import (
    ALONE,
    DRIVE,
    DT,
    FASTER,
    FOLLOW,
    HERE,
    Case,
    Trace,
    judge,
    near,
    never,
    steady,
    within,
)

PLACED = "lane(2, at: start); position(30m, at: start)"
AT = f"drive() with: {PLACED}; "
ON = "drive() with: "


def rates(t: Trace, since: int = 0) -> list[float]:
    """Return the accelerations of npc over each step from `since` on."""
    return [(b - a) / DT for a, b in pairwise(t.all("v")[since:])]


def beside(t: Trace) -> float:
    """Return how far npc is to the left of ego at the end."""
    return float(t.end("y") - t.end("y", "ego"))


CASES = {
    # 8.9.3 speed()
    "faster than ego": Case(
        AT + "speed(5mps, faster_than: ego)", "succeeds", lambda t: within(t.all("v"), 15, 15)
    ),
    "slower than ego": Case(
        AT + "speed(5mps, slower_than: ego)", "succeeds", lambda t: within(t.all("v"), 5, 5)
    ),
    "faster by a factor too": Case(
        AT + "speed(1mps, faster_than: ego, factor: 1.5)",
        *("succeeds", lambda t: steady(t.all("v")) and within(t.all("v"), 16, 16.5)),
    ),
    "as fast as one that gets faster": Case(
        AT + "speed(same_as: ego)",
        *(
            "succeeds",
            lambda t: all(
                near(a, b, 0.2) for a, b in zip(t.all("v"), t.all("v", "ego"), strict=True)
            ),
        ),
        ego=FASTER,
    ),
    "one value of a range": Case(
        AT + "speed([8mps..12mps])",
        *("succeeds", lambda t: steady(t.all("v")) and within(t.all("v"), 8, 12)),
    ),
    "values of a range": Case(
        AT + "speed(speed_range: [8mps..12mps])", "succeeds", lambda t: within(t.all("v"), 8, 12)
    ),
    "speeds at both ends": Case(
        AT + "speed(10mps, at: start); speed(14mps, at: end)",
        *("succeeds", lambda t: near(t.all("v")[0], 10) and near(t.end("v"), 14)),
    ),
    "two speeds": Case(AT + "speed(10mps); speed(12mps)", "fails", never),
    "another speed at the start": Case(
        AT + "speed(10mps, at: start); speed(12mps)", "warns", never
    ),
    "another speed at the end": Case(AT + "speed(10mps); speed(12mps, at: end)", "warns", never),
    "a range at the end": Case(
        AT + "speed(15mps, at: start); speed(speed_range: [8mps..12mps], at: end)",
        *("succeeds", lambda t: within([t.end("v")], 8, 12)),
    ),
    "a speed and its range": Case(
        AT + "speed(speed: 10mps, speed_range: [8mps..12mps])", "fails", never
    ),
    "faster and slower": Case(
        AT + "speed(1mps, faster_than: ego, slower_than: ego)", "fails", never
    ),
    # 8.9.2 position()
    "from the start of the road": Case(
        ON + "lane(3, at: start); position(100m, at: start); speed(10mps)",
        *("succeeds", lambda t: near(t["npc"][0]["s"], 100)),
    ),
    "a range from the start of the road": Case(
        ON + "lane(3, at: start); position([50m..60m], at: start); speed(10mps)",
        *("succeeds", lambda t: within([t["npc"][0]["s"]], 50, 60)),
    ),
    "a place at the end": Case(AT + "speed(10mps); position(90m, at: end)", "fails", never),
    "a place at the end, speeds open": Case(
        AT + "speed(10mps, at: start); position(90m, at: end)",
        *("succeeds", lambda t: near(t.end("s"), 90, 0.1)),
    ),
    "a negative distance ahead": Case(
        ON + "lane(2, at: start); position(-20m, ahead_of: ego, at: start); speed(10mps)",
        *("succeeds", lambda t: near(t.gaps()[0], -20)),
    ),
    "a headway at the start": Case(
        ON + "lane(2, at: start); position(time: 2s, behind: ego, at: start); speed(10mps)",
        *("succeeds", lambda t: near(t.gaps()[0], -20, 0.1)),
    ),
    "ahead and behind": Case(
        ON + "position(20m, ahead_of: ego, behind: ego, at: start); speed(10mps)", "fails", never
    ),
    "a distance and a time": Case(
        ON + "position(distance: 20m, time: 1s, ahead_of: ego, at: start); speed(10mps)",
        *("fails", never),
    ),
    "neither distance nor time": Case(
        ON + "position(ahead_of: ego, at: start); speed(10mps)", "fails", never
    ),
    "a range at the start": Case(
        ON + "lane(2, at: start); speed(10mps);"
        " position(distance_range: [15m..25m], behind: ego, at: start)",
        *("succeeds", lambda t: within([-t.gaps()[0]], 15, 25)),
    ),
    "in the place of ego": Case(
        ON + "lane(same_as: ego, at: start); position(0m, ahead_of: ego, at: start); speed(10mps)",
        *("fails", never),
    ),
    "kept behind one that gets faster": Case(
        ON + "lane(same_as: ego); position(20m, behind: ego)",
        *("succeeds", lambda t: within(t.gaps(), -20, -20, 0.2)),
        ego=FASTER,
    ),
    "two places at the end": Case(
        AT + "speed(10mps, at: start); position(20m, behind: ego, at: end);"
        " position(30m, behind: ego, at: end)",
        *("fails", never),
    ),
    # 8.9.6 lateral()
    "left of the centre": Case(
        DRIVE + "lateral(0.5m, side: left)", "succeeds", lambda t: near(t.end("offset"), 0.5)
    ),
    "less than nothing to the left": Case(
        DRIVE + "lateral(distance: -0.5m, side: left)",
        *("succeeds", lambda t: near(t.end("offset"), -0.5)),
    ),
    "right at the end": Case(
        DRIVE + "lateral(0m, at: start); lateral(0.5m, side: right, at: end)",
        *("succeeds", lambda t: near(t.all("offset")[0], 0) and near(t.end("offset"), -0.5)),
    ),
    "beside ego, centres": Case(
        DRIVE + "lateral(3.5m, side_of: ego, side: left, measure_by: center_to_center, at: end)",
        *("succeeds", lambda t: near(beside(t), 3.5)),
    ),
    "beside ego, sides": Case(
        DRIVE + "lateral(1m, side_of: ego, side: left, measure_by: right_to_left, at: end)",
        *("succeeds", lambda t: within([beside(t)], 2.5, 3.5)),
    ),
    "left and right": Case(
        DRIVE + "lateral(0.5m, side: left); lateral(0.5m, side: right)", "fails", never
    ),
    # 8.9.7 yaw(), 8.9.10 orientation()
    "along the lane": Case(DRIVE + "yaw(0deg)", "succeeds", lambda t: within(t.all("h"), 0, 0)),
    "across the lane": Case(DRIVE + "yaw(90deg)", "warns", never),
    "turned at the end": Case(DRIVE + "yaw(90deg, at: end); keep_lane()", "warns", never),
    "orientation along the lane": Case(
        DRIVE + "orientation(yaw: 0deg)", "succeeds", lambda t: within(t.all("h"), 0, 0)
    ),
    # 8.9.13 distance()
    "40 m": Case(DRIVE + "distance(40m)", "succeeds", lambda t: near(t.end("s"), 70, 0.1), ALONE),
    "30 to 50 m": Case(
        DRIVE + "distance([30m..50m])", "succeeds", lambda t: within([t.end("s")], 60, 80), ALONE
    ),
    "40 m in 4 s": Case(DRIVE + "distance(40m)", "succeeds", lambda t: near(t.end("s"), 70, 0.1)),
    "40 m of 80": Case(AT + "speed(20mps); distance(40m)", "fails", never),
    "60 m in 4 s": Case(
        AT + "speed(10mps, at: start); distance(60m)",
        *("succeeds", lambda t: near(t.end("s"), 90, 0.1)),
    ),
    # 8.9.5 acceleration()
    "2 m/s2": Case(
        AT + "speed(10mps, at: start); acceleration(2mpss)",
        *("succeeds", lambda t: near(t.end("v"), 18)),
    ),
    "-2 m/s2": Case(
        AT + "speed(10mps, at: start); acceleration(-2mpss)",
        *("succeeds", lambda t: near(t.end("v"), 2)),
    ),
    "braking after the stop": Case(
        AT + "speed(10mps, at: start); acceleration(-5mpss)", "warns", never
    ),
    "one acceleration of a range": Case(
        AT + "speed(10mps, at: start); acceleration([1mpss..2mpss])",
        *("succeeds", lambda t: steady(rates(t)) and within(rates(t), 1, 2)),
    ),
    "accelerations of a range": Case(
        AT + "speed(10mps, at: start); acceleration(acceleration_range: [1mpss..2mpss])",
        *("succeeds", lambda t: within(rates(t), 1, 2)),
    ),
    "an acceleration at one speed": Case(AT + "speed(10mps); acceleration(2mpss)", "warns", never),
    "an acceleration to another speed": Case(
        AT + "speed(10mps, at: start); acceleration(1mpss); speed(16mps, at: end)", "fails", never
    ),
    "an acceleration to a speed": Case(
        AT + "speed(12mps, at: start); acceleration(1mpss); speed(16mps, at: end)",
        *("succeeds", lambda t: near(t.all("v")[0], 12) and near(t.end("v"), 16)),
    ),
    # 8.9.14 lane()
    "lane by default": Case(
        ON + "lane(); position(30m, at: start); speed(10mps)",
        *("succeeds", lambda t: within(t.all("lane"), -4, -4)),
    ),
    "lane from the left": Case(
        ON + "lane(1, from: left); position(30m, at: start); speed(10mps)",
        *("succeeds", lambda t: within(t.all("lane"), -1, -1)),
    ),
    "left of ego": Case(
        ON + "lane(side_of: ego, side: left); position(30m, at: start); speed(10mps)",
        *("succeeds", lambda t: within(t.all("lane"), -2, -2)),
    ),
    "one or two to the right at the end": Case(
        DRIVE + "lane([1..2], side_of: ego, side: right, at: end)",
        *("succeeds", lambda t: t.end("lane") == -4),
    ),
    "two to the left at the start": Case(
        ON + "lane(2, side_of: ego, side: left, at: start); position(30m, at: start); speed(10mps)",
        *("succeeds", lambda t: t.all("lane")[0] == -1),
    ),
    "no such lane": Case(ON + "lane(9); position(30m, at: start); speed(10mps)", "fails", never),
    "one lane to another": Case(
        ON + "lane(3, at: start); lane(2, at: end); position(30m, at: start); speed(10mps)",
        *("succeeds", lambda t: t.all("lane")[0] == -2 and t.end("lane") == -3),
    ),
    "another lane throughout": Case(ON + "speed(10mps); lane(3)", "warns", never, before="npc"),
    "two lanes": Case(
        ON + "lane(2); lane(3); position(30m, at: start); speed(10mps)", "fails", never
    ),
    "same lane and a side": Case(
        ON + "lane(same_as: ego, side_of: ego); position(30m, at: start); speed(10mps)",
        *("fails", never),
    ),
    # 8.9.15 change_lane(), 8.9.16 keep_lane(), 8.9.4 keep_speed(), keep_position()
    "change to the left": Case(
        DRIVE + "change_lane(side: left)", "succeeds", lambda t: t.end("lane") == -2
    ),
    "change by one or two": Case(
        ON + "lane(3, at: start); position(30m, at: start); speed(10mps);"
        " change_lane([1..2], right)",
        *("succeeds", lambda t: t.end("lane") in (-3, -4)),
        "parallel(duration: 6s)",
    ),
    "change to either side": Case(
        DRIVE + "change_lane()", "succeeds", lambda t: t.end("lane") in (-2, -4)
    ),
    "change beyond the road": Case(DRIVE + "change_lane(2, right)", "fails", never),
    "keep the lane": Case(
        DRIVE + "keep_lane()", "succeeds", lambda t: within(t.all("lane"), -3, -3)
    ),
    "keep the lane and leave it": Case(DRIVE + "keep_lane(); lane(3, at: end)", "fails", never),
    "keep the speed": Case(
        ON + "keep_speed()", "succeeds", lambda t: within(t.all("v"), 10, 10), before="npc"
    ),
    "keep the speed and change it": Case(
        ON + "keep_speed(); speed(15mps, at: end)", "fails", never, before="npc"
    ),
    "keep the place": Case(
        AT + "keep_position()", "succeeds", lambda t: within(t.all("s"), 30, 30)
    ),
    "keep the place while rolling": Case(ON + "keep_position()", "warns", never, before="npc"),
    # 8.9.17 physical_movement(), 8.9.18 avoid_collisions()
    "a jump of the speed": Case(
        ON + "speed(20mps); physical_movement(prefer_non_physical)",
        *("succeeds", lambda t: within(t.all("v")[22:], 20, 20)),
        before="npc",
    ),
    "no jump of the speed": Case(
        ON + "speed(20mps); physical_movement(must_be_physical)", "fails", never, before="npc"
    ),
    "no collision": Case(
        FOLLOW + "speed(15mps, at: start); avoid_collisions(true)",
        *("either", lambda t: t.collisions == 0),
        ego="drive() with: lane(2, at: start); position(80m, at: start); speed(0mps)",
    ),
    # 8.8 actions
    "stationary": Case(
        f"remain_stationary() with: {PLACED}", "succeeds", lambda t: within(t.all("v"), 0, 0)
    ),
    "stationary while rolling": Case("remain_stationary()", "warns", never, before="npc"),
    "a change of speed": Case(
        "change_speed(15mps)", "succeeds", lambda t: near(t.end("v"), 15), ALONE, before="npc"
    ),
    "a smooth change of speed": Case(
        "change_speed(target: 15mps, rate_profile: smooth, rate_peak: 2mpss)",
        *("succeeds", lambda t: near(t.end("v"), 15) and near(max(rates(t, 20)), 2.0, 0.05)),
        how=ALONE,
        before="npc",
    ),
    "a change of speed in 2 s": Case(
        "change_speed(16mps, duration: 2s)",
        *("succeeds", lambda t: near(t.end("v"), 16) and near(t["npc"][-1]["t"], 3.0)),
        how=ALONE,
        before="npc",
    ),
    "no change of speed": Case(
        "change_speed(10mps)", "succeeds", lambda t: near(t.end("v"), 10), ALONE, before="npc"
    ),
    "a speed that is kept": Case(
        "keep_speed()", "succeeds", lambda t: within(t.all("v"), 10, 10), before="npc"
    ),
    "an acceleration": Case(
        "change_acceleration(1mpss)",
        *("succeeds", lambda t: near(t.end("a"), 1.0, 0.15)),  # of a trace: the mean over a step
        how=ALONE,
        before="npc",
    ),
    "a lane that is followed": Case(
        "follow_lane()", "succeeds", lambda t: within(t.all("offset"), 0, 0), before="npc"
    ),
    "an offset in the lane": Case(
        "follow_lane(offset: 0.5m)", "either", lambda t: near(t.end("offset"), 0.5), before="npc"
    ),
    "offsets of a range": Case(
        "follow_lane(offset_range: [-0.3m..0.3m])",
        *("succeeds", lambda t: within(t.all("offset"), -0.3, 0.3)),
        before="npc",
    ),
    "a lane to the right": Case(
        "change_lane(side: right)", "succeeds", lambda t: t.end("lane") == -4, ALONE, before="npc"
    ),
    "two lanes to the left": Case(
        "change_lane(num_of_lanes: 2, side: left)",
        *("succeeds", lambda t: t.end("lane") == -1, ALONE),
        before="npc",
    ),
    "left of where ego is": Case(
        "change_lane(num_of_lanes: 1, side: left, reference: ego)",
        *("succeeds", lambda t: t.end("lane") == -2),
        "parallel",
        before="npc",
    ),
    "the own lane as the target": Case(
        "change_lane(num_of_lanes: 0, side: left)", "fails", never, ALONE, before="npc"
    ),
    "a lane and an offset": Case(
        "change_lane(side: left, offset: 0.5m)",
        *("succeeds", lambda t: t.end("lane") == -2 and near(t.end("offset"), 0.5)),
        how=ALONE,
        before="npc",
    ),
    "a change of lane in 3 s": Case(
        "change_lane(side: left, duration: 3s)",
        *("succeeds", lambda t: t.end("lane") == -2 and near(t["npc"][-1]["t"], 4.0)),
        how=ALONE,
        before="npc",
    ),
    "headway in time": Case(
        "change_time_headway(target: 3s, direction: behind, reference: ego)",
        *("either", lambda t: within([-t.gaps()[-1] / t.end("v")], 2.4, 3.6)),
        "parallel",
        before="npc",
    ),
    "an assigned speed": Case(
        "assign_speed(15mps)", "succeeds", lambda t: near(t.end("v"), 15), ALONE, before="npc"
    ),
    "an action of a range of durations": Case(
        f"drive(duration: [2s..3s]) with: {HERE}",
        *("succeeds", lambda t: within([t["npc"][-1]["t"]], 2, 3, 0.06), ALONE),
    ),
    "an action that ends before the other": Case(
        f"drive(duration: 3s) with: {HERE}",
        "succeeds",
        lambda t: near(t.end("v"), 10),
        "parallel",
        ego="drive(duration: 4s) with: lane(2, at: start); position(80m, at: start); speed(10mps)",
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_a_success_is_what_the_text_demands(name: str, shell: Shell) -> None:
    judge(CASES[name], shell)
