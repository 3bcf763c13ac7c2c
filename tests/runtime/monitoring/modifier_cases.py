"""Modifiers that hold in a good trace, each with a change of a state that breaks it."""

from __future__ import annotations

from collections.abc import Callable

from osc2tx_runtime import (
    Behaviour,
    Parallel,
    Path,
    Point,
    Serial,
    Trajectory,
    within,
)
from osc2tx_runtime.domain.shapes import (
    AnyAccelerationShape,
    AnyLateralShape,
    AnyPositionShape,
    AnySpeedShape,
    CommonAccelerationShape,
    CommonLateralShape,
    CommonPositionShape,
    CommonSpeedShape,
)
from osc2tx_runtime.modifiers import (
    acceleration,
    along,
    along_trajectory,
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

from .cases import (
    ALL,
    EARLIER,
    END,
    JUMP,
    LINE,
    START,
    Case,
    beside,
    own,
    standing,
    two,
)
from .kit import Body, accelerated, ahead, faster, lanes_left, left, tilted, turned


# One step at 10 m/s is 0.5 m.
# One step at 10 m/s is 0.5 m.
def both(make: Callable[[TwoCars], Behaviour]) -> Body:
    """`a` does something for 2 s while `b` drives."""
    return lambda s: Parallel("both", make(s), s.b.drive(speed(12.0)), duration=2.0)


# One step at 10 m/s is 0.5 m.
MODIFIER_CASES = [
    Case("speed", two(speed(10.0)), faster, 0.05),
    Case("speed", two(speed(10.0, at="start")), faster, 0.05, START),
    Case("speed", two(speed(10.0, at="end")), faster, 0.05, END),
    Case("speed", two(speed(speed_range=within(9.0, 11.0))), faster, 1.05),
    Case("speed", two(speed(0.0, direction="lateral")), turned, 0.005),
    Case("speed", beside(lambda s: speed(2.0, slower_than=s.b)), faster, 0.05),
    Case("speed", beside(lambda s: speed(2.0, slower_than=s.b)), faster, 0.05, ALL, "b"),
    Case("speed", beside(lambda s: speed(-2.0, faster_than=s.b)), faster, 0.05, ALL, "b"),
    Case("speed", beside(lambda s: speed(same_as=s.b, factor=10.0 / 12.0)), faster, 0.05),
    Case(
        "speed",
        beside(lambda s: speed(-2.0, faster_than=s.b, at="end", track="projected")),
        faster,
        0.05,
        END,
    ),
    Case(
        "speed",
        two(speed(12.0, rate_profile="constant", rate_peak=2.0, at="end")),
        faster,
        0.05,
        END,
        slack=0.15,
    ),
    Case(
        "speed",
        two(speed(12.0, shape=CommonSpeedShape("constant", 2.0), at="end")),
        faster,
        0.05,
        END,
        slack=0.15,
    ),
    Case("speed", two(speed(10.0, shape=CommonSpeedShape("constant", 2.0))), faster, 0.05, END),
    Case("speed", two(speed(shape=own(AnySpeedShape(), lambda t: 10.0 + t))), faster, 0.05),
    Case(
        "speed",
        beside(lambda s: speed(faster_than=s.b, shape=own(AnySpeedShape(), lambda t: -2.0 - t))),
        faster,
        0.05,
    ),
    Case("keep_speed", two(keep_speed()), faster, 0.05),
    Case("change_speed", two(change_speed(2.0)), faster, 0.05, END),
    Case("change_speed", two(change_speed(speed_range=within(-1.0, 1.0))), faster, 1.05, END),
    Case(
        "change_speed",
        two(change_speed(2.0, shape=CommonSpeedShape("constant", 2.0))),
        faster,
        0.05,
        END,
        slack=0.15,
    ),
    Case("change_speed", two(change_speed(shape=own(AnySpeedShape(), lambda t: t))), faster, 0.05),
    Case(
        "acceleration",
        two(acceleration(shape=own(AnyAccelerationShape(), lambda t: 0.5 * t))),
        accelerated,
        0.1,
    ),
    Case(
        "acceleration",
        two(acceleration(1.0, shape=CommonAccelerationShape("constant", 1.0))),
        accelerated,
        0.1,
        END,
        last=2,
    ),
    Case("acceleration", two(acceleration(1.0)), accelerated, 0.1),
    Case(
        "acceleration", two(acceleration(1.0, at="start")), accelerated, 0.1 / 1.5, START, first=1
    ),
    Case("acceleration", two(acceleration(1.0, at="end")), accelerated, 0.1, END, last=2),
    Case("acceleration", two(acceleration(acceleration_range=within(-0.5, 0.5))), accelerated, 0.6),
    Case("lane", two(lane(2)), lanes_left, 0.0),
    Case("lane", two(lane(2, at="start")), lanes_left, 0.0, START),
    Case("lane", two(lane(2, at="end")), lanes_left, 0.0, END),
    Case("lane", two(lane(3, from_="left", at="end")), lanes_left, 0.0, END),
    Case("lane", two(lane(2, shape=CommonLateralShape("smooth", 1.0))), lanes_left, 0.0, END),
    Case("lane", beside(lambda s: lane(same_as=s.b)), lanes_left, 0.0, ALL, "b"),
    Case("lane", beside(lambda s: lane(same_as=s.b, at="end")), lanes_left, 0.0, END, "b"),
    Case("lane", beside(lambda s: lane(0, side_of=s.b, side="left")), lanes_left, 0.0, ALL, "b"),
    Case("lane", beside(lambda s: lane(same_as=s.b, track="projected")), lanes_left, 0.0),
    Case("lateral", two(lateral(0.0)), left, 0.1),
    Case("lateral", two(lateral(0.0, at="start")), left, 0.1, START),
    Case("lateral", two(lateral(0.0, at="end")), left, 0.1, END),
    Case("lateral", two(JUMP, lateral(0.5, side="right")), left, 0.1),
    Case("lateral", two(lateral(distance_range=within(-0.5, 0.5))), left, 0.6),
    Case(
        "lateral",
        two(lateral(0.8, side="left", measure_by="right_to_right", at="start")),
        left,
        0.1,
        START,
    ),
    Case("lateral", two(lateral(shape=own(AnyLateralShape(), lambda t: 0.1 * t * t))), left, 0.1),
    Case(
        "lateral",
        two(lateral(0.0, shape=CommonLateralShape("smooth", 1.0))),
        left,
        0.1,
        END,
        slack=0.05,
    ),
    Case("lateral", beside(lambda s: lateral(0.0, side_of=s.b)), left, 0.1, ALL, "b"),
    Case("lateral", beside(lambda s: lateral(0.0, side_of=s.b, track="projected")), left, 0.1),
    Case("position", two(position(50.0, at="start")), ahead, 0.1, START),
    Case("position", two(position(70.0, at="end")), ahead, 0.1, END, slack=0.65),
    Case("position", beside(lambda s: position(40.0, behind=s.b, at="start")), ahead, 0.1, START),
    Case(
        "position",
        beside(lambda s: position(44.0, behind=s.b, at="end")),
        ahead,
        0.1,
        END,
        slack=0.65,
    ),
    Case(
        "position",
        beside(lambda s: position(-44.0, ahead_of=s.b, at="end", track="projected")),
        ahead,
        0.1,
        END,
        slack=0.65,
    ),
    Case(
        "position",
        beside(lambda s: position(time=4.4, behind=s.b, at="end")),
        ahead,
        0.1,
        END,
        slack=0.65,
    ),
    Case(
        "position",
        beside(lambda s: position(distance_range=within(43.0, 45.0), behind=s.b, at="end")),
        ahead,
        1.1,
        END,
        slack=0.65,
    ),
    Case(
        "position",
        two(position(at_point=Point(70.0, -8.75, 0.0), at="end")),
        ahead,
        0.1,
        END,
        slack=0.65,
    ),
    Case(
        "position",
        two(position(20.0, ahead_of_point=Point(50.0, -8.75, 0.0), at="end")),
        ahead,
        0.1,
        END,
        slack=0.65,
    ),
    Case(
        "position",
        two(position(30.0, behind_point=Point(100.0, -8.75, 0.0), at="end")),
        ahead,
        0.1,
        END,
        slack=0.65,
    ),
    Case(
        "position",
        two(position(shape=own(AnyPositionShape(), lambda t: 50.0 + 10.0 * t))),
        ahead,
        0.1,
    ),
    Case(
        "position",
        two(JUMP, position(70.0, shape=CommonPositionShape("constant", 10.0))),
        ahead,
        0.1,
        END,
        slack=0.65,
    ),
    Case("position", two(position(x=70.0, y=-8.75, at="end")), ahead, 0.1, END, slack=0.65),
    Case(
        "position",
        two(position(at_point=Point(50.0, -8.75, 0.0), project_on_route=False, at="start")),
        ahead,
        0.1,
        START,
    ),
    Case(
        "position",
        beside(lambda s: position(time_range=within(4.3, 4.5), behind=s.b, at="end")),
        ahead,
        1.1,
        END,
        slack=0.8,
    ),
    Case("yaw", two(yaw(0.0)), turned, 0.01),
    Case("yaw", two(yaw(0.0, at="start")), turned, 0.01, START),
    Case("yaw", two(yaw(0.0, at="end")), turned, 0.01, END),
    Case("yaw", two(yaw(angle_range=within(-0.05, 0.05))), turned, 0.06),
    Case(
        "yaw",
        beside(lambda s: yaw(0.0, relative_to=s.b, measure_by="length_to_length")),
        turned,
        0.01,
        ALL,
        "b",
    ),
    Case(
        "yaw",
        beside(
            lambda s: yaw(0.0, relative_to=s.b, measure_by="length_to_length", track="projected")
        ),
        turned,
        0.01,
    ),
    Case(
        "orientation",
        beside(lambda s: orientation(yaw=0.0, relative_to=s.b, track="projected")),
        turned,
        0.01,
    ),
    Case("orientation", two(orientation(yaw=0.0)), turned, 0.01),
    Case("orientation", two(orientation(yaw=0.0, at="start")), turned, 0.01, START),
    Case("orientation", two(orientation(yaw=0.0, at="end")), turned, 0.01, END),
    Case("orientation", two(orientation(pitch=0.0, roll=0.0)), tilted, 0.01),
    Case(
        "orientation",
        beside(lambda s: orientation(yaw=0.0, relative_to=s.b, measure_by="relative_to_reference")),
        turned,
        0.01,
        ALL,
        "b",
    ),
    Case(
        "change_lane",
        lambda s: Serial(
            "all", s.a.change_lane(side="right"), s.a.drive(change_lane(2, "left"), duration=8.0)
        ),
        lanes_left,
        0.0,
        END,
    ),
    Case(
        "change_lane",
        lambda s: Serial(
            "all", s.a.change_lane(side="left"), s.a.drive(change_lane(1, "right"), duration=5.0)
        ),
        lanes_left,
        0.0,
        END,
    ),
    Case("keep_lane", two(keep_lane()), lanes_left, 0.0),
    Case("distance", two(distance(20.0)), ahead, 0.1, END, slack=1.7),
    Case("keep_position", lambda s: standing(s, s.a.drive(keep_position())), ahead, 0.1),
    Case("along", lambda s: s.a.drive(along(Path(LINE))), left, 0.1),
    Case(
        "along",
        lambda s: s.a.drive(along(Path(EARLIER), start_offset=1.0, end_offset=5.0)),
        left,
        0.1,
    ),
    Case(
        "along_trajectory",
        lambda s: s.a.drive(along_trajectory(Trajectory(LINE, (0.0, 4.0)))),
        ahead,
        0.1,
    ),
    Case(
        "along_trajectory",
        lambda s: s.a.drive(
            JUMP, along_trajectory(Trajectory(LINE, (0.0, 4.0)), start_offset=1.0, end_offset=5.0)
        ),
        ahead,
        0.1,
    ),
]
