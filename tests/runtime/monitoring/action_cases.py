"""Actions that reach what they stand for, each with a change of a state that breaks it."""

from __future__ import annotations

from osc2tx_runtime import (
    Path,
    Point,
    Trajectory,
)

from .cases import (
    END,
    LINE,
    Case,
    course,
    gap,
    kept,
    standing,
)
from .kit import accelerated, ahead, faster, lanes_left, left

ACTION_CASES = [
    Case(
        "speed",
        lambda s: s.a.change_speed(target=12.0),
        faster,
        0.05,
        END,
        slack=0.5,
        action="change_speed",
    ),
    Case("keep_speed", lambda s: s.a.keep_speed(duration=2.0), faster, 0.05, action="keep_speed"),
    Case(
        "acceleration",
        lambda s: s.a.change_acceleration(target=1.0),
        accelerated,
        0.1,
        END,
        slack=0.2,
        last=2,
        action="change_acceleration",
    ),
    Case(
        "keep_acceleration",
        lambda s: s.a.keep_acceleration(duration=2.0),
        accelerated,
        0.1,
        action="keep_acceleration",
    ),
    Case(
        "keep_position",
        lambda s: standing(s, s.a.remain_stationary()),
        left,
        0.1,
        action="remain_stationary",
    ),
    Case(
        "speed",
        lambda s: standing(s, s.a.remain_stationary()),
        faster,
        0.05,
        action="remain_stationary",
    ),
    Case(
        "change_lane",
        lambda s: s.a.change_lane(side="left"),
        lanes_left,
        0.0,
        END,
        action="change_lane",
    ),
    Case("lateral", lambda s: s.a.change_lane(side="left"), left, 0.1, END, action="change_lane"),
    Case(
        "keep_lane", lambda s: s.a.follow_lane(duration=2.0), lanes_left, 0.0, action="follow_lane"
    ),
    Case("lateral", lambda s: s.a.follow_lane(duration=2.0), left, 0.1, action="follow_lane"),
    *(
        Case(name, gap(name, 30.0), ahead, 0.1, END, slack=0.8, action=name)
        for name in ("change_space_gap", "change_space_headway")
    ),
    *(
        Case(name, gap(name, 3.0), ahead, 0.5, END, slack=2.0, action=name)
        for name in ("change_time_gap", "change_time_headway")
    ),
    *(
        Case(name, kept(name), ahead, 0.1, END, slack=0.65, action=name)
        for name in ("keep_space_gap", "keep_space_headway")
    ),
    *(
        Case(name, kept(name), faster, 0.05, END, slack=0.5, action=name)
        for name in ("keep_time_gap", "keep_time_headway")
    ),
    *(
        Case("along", course(name, Path(LINE)), left, 0.1, action=name)
        for name in ("follow_path", "replay_path")
    ),
    *(
        Case(
            "along_trajectory", course(name, Trajectory(LINE, (0.0, 4.0))), ahead, 0.1, action=name
        )
        for name in ("follow_trajectory", "replay_trajectory")
    ),
    Case(
        "change_position",
        lambda s: s.a.change_position(target_xyz=Point(90.0, -8.75, 0.0)),
        ahead,
        0.1,
        END,
        slack=0.55,
        action="change_position",
    ),
]
