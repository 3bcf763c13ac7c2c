"""What cannot be: the run fails and says which action, at which place, when, and why."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from osc2tx_runtime import Behaviour, OdrPoint, Parallel, Person, Point, Pose, Serial, Wait, elapsed
from osc2tx_runtime.domain.map.roads_and_lanes import Lane, MapSegment
from osc2tx_runtime.domain.paths.path_values import Path, RelativePathSt, Trajectory
from osc2tx_runtime.domain.points_and_poses import RoutePoint
from osc2tx_runtime.modifiers import (
    along,
    change_lane,
    keep_lane,
    lane,
    lateral,
    physical_movement,
    position,
    speed,
    yaw,
)
from tests.runtime.world.two_cars import TwoCars, scenario

Run = Callable[..., Any]
MUST = physical_movement("must_be_physical")
BEND = (Pose(55.0, -8.75), Pose(100.0, -8.75), Pose(160.0, -40.0), Pose(300.0, -90.0))
OFF_ROAD = Path(BEND)


class WithWalker(TwoCars):
    """Two cars, and somebody on the grass."""

    def declare(self) -> None:
        super().declare()
        self.walker = Person()

    def placement(self) -> None:
        super().placement()
        point = Point(100.0, -45.0)
        self.place(self.walker, position(at_point=point, project_on_route=False))


def lane_of(road: str, number: int) -> Lane:
    """A lane of the map, as the solver finds it."""
    lane_ = Lane()
    lane_.choose(MapSegment("lane", road, 0, number))
    return lane_


# Action after one second, its name in the message, the instant of its failure (s), why.
AT_ONCE = 1.0
CASES: list[tuple[Callable[[Any], Behaviour], str, float, str]] = [
    (
        lambda s: s.a.change_lane(num_of_lanes=6, side="left"),
        "a.change_lane",
        1.05,
        "there are not 6 driving lanes to the left of lane -3 of road 1 at s = 60.0 m",
    ),
    (
        lambda s: s.a.drive(lane(7)),
        "a.drive",
        AT_ONCE,
        "road 1 has no lane 7 from the right at s = 60.0 m",
    ),
    (
        lambda s: s.a.drive(change_lane(3, side="right")),
        "a.drive",
        1.05,
        "there are not 3 driving lanes to the right of lane -3 of road 1 at s = 60.0 m",
    ),
    (
        lambda s: s.a.drive(change_lane(2, side="right"), lateral(0.3)),
        "a.drive",
        AT_ONCE,
        "there is no such lane to the right of lane -3 of road 1 at s = 60.0 m",
    ),
    (
        lambda s: s.a.drive(lane(side_of=s.walker, side="left"), duration=3.0),
        "a.drive",
        AT_ONCE,
        "walker is not on a road, so it has no lane",
    ),
    (
        lambda s: s.a.change_speed(MUST, target=60.0, duration=2.0),
        "a.change_speed",
        AT_ONCE,
        "a change from 10.0 to 60.0 m/s in 2 s requires more than 4 m/s^2",
    ),
    (
        lambda s: s.a.change_acceleration(target=5.0),
        "a.change_acceleration",
        AT_ONCE,
        "an acceleration of 5.00 m/s^2 exceeds its limit of 4 m/s^2",
    ),
    (
        lambda s: s.a.drive(MUST, lane(3, at="end"), duration=0.5),
        "a.drive",
        AT_ONCE,
        "a lateral displacement of 3.5 m in 0.5 s requires more than 3 m/s^2;"
        " the shortest possible duration is 2.40 s",
    ),
    (
        lambda s: s.a.change_lane(side="left", rate_peak=lambda: -1.0),
        "a.change_lane",
        AT_ONCE,
        "rate_peak -1 m/s is not positive",
    ),
    (
        lambda s: s.a.change_lane(side="left", rate_peak=1.0, duration=3.0),
        "a.change_lane",
        AT_ONCE,
        "with rate_peak 1 m/s it takes 5.50 s, not 3 s",  # pi / 2 * 3.5 / 1
    ),
    (
        lambda s: s.a.change_lane(MUST, side="left", duration=1.0),
        "a.change_lane",
        AT_ONCE,
        "a lateral displacement of 3.5 m in 1 s requires more than 3 m/s^2;"
        " the shortest possible duration is 2.40 s",
    ),
    (
        lambda s: s.a.change_lane(target=lane_of("2", -1)),
        "a.change_lane",
        AT_ONCE,
        "a is on road 1, so it cannot change to lane -1 of road 2",
    ),
    (
        lambda s: s.a.follow_lane(target=lane_of("1", 4), duration=2.0),
        "a.follow_lane",
        AT_ONCE,
        "lane 4 of road 1 is not a driving lane",
    ),
    (
        lambda s: s.a.drive(position(20.0, at="end")),
        "a.drive",
        AT_ONCE,
        "its target position is 40.0 m behind it",
    ),
    (
        lambda s: s.a.drive(position(at_point=Point(30.0, -8.75), at="end")),
        "a.drive",
        AT_ONCE,
        "its target position is 30.0 m behind it",
    ),
    (
        lambda s: s.a.drive(position(at_point=Point(100.0, 8.75), at="end")),
        "a.drive",
        AT_ONCE,
        "no route along lanes leads from a to (100, 8.75)",
    ),
    (
        lambda s: s.a.change_position(target_odr=OdrPoint("9", "-1", 5.0)),
        "a.change_position",
        AT_ONCE,
        "there is no road `9`",
    ),
    (
        lambda s: s.a.change_position(target_xyz=Point(100.0, 60.0)),
        "a.change_position",
        AT_ONCE,
        "there is no driving lane at (100, 60)",
    ),
    (
        lambda s: s.a.change_position(target_odr=OdrPoint("1", "-3", 30.0)),
        "a.change_position",
        AT_ONCE,
        "no route along lanes leads from lane -3 of road 1 to lane -3 of road 1, s = 30.0 m",
    ),
    (
        lambda s: s.a.assign_position(odr_point=OdrPoint("1", "-9", 5.0)),
        "a.assign_position",
        AT_ONCE,
        "road `1` has no lane -9 at s = 5.000 m; it has -5, -4, -3, -2, -1, 1, 2, 3, 4",
    ),
    (
        lambda s: s.a.follow_path(absolute=Path((Pose(900.0, 0.0), Pose(950.0, 0.0)))),
        "a.follow_path",
        AT_ONCE,
        "the path is 840 m away, too far to get there",
    ),
    (
        lambda s: s.a.follow_path(absolute=Path((Pose(70.0, -8.0),))),
        "a.follow_path",
        AT_ONCE,
        "the path has no length: it needs two different points",
    ),
    (
        lambda s: s.walker.follow_path(
            relative=RelativePathSt((RoutePoint(None, 0.0), RoutePoint(None, 20.0))),
            transform="lane_relative",
        ),
        "walker.follow_path",
        AT_ONCE,
        "the reference is on no road",
    ),
    (
        lambda s: s.a.drive(along(OFF_ROAD, start_offset=900.0)),
        "a.drive",
        AT_ONCE,
        "start_offset 900 m and end_offset 0 m leave nothing of a path of",
    ),
    (
        lambda s: s.a.follow_trajectory(
            absolute=Trajectory((Pose(60.0, -8.75), Pose(90.0, -8.75)), (3.0, 1.0))
        ),
        "a.follow_trajectory",
        AT_ONCE,
        "the time stamps of a trajectory start at 0 s or later, and ascend",
    ),
    (
        lambda s: s.a.follow_trajectory(
            absolute=Trajectory((Pose(60.0, -8.75), Pose(900.0, -8.75)), (0.0, 4.0)),
        ),
        "a.follow_trajectory",
        15.1,
        "m from the end, 10 s after its time",
    ),
    (
        lambda s: s.a.keep_space_gap(reference=s.b, direction="lateral", duration=2.0),
        "a.keep_space_gap",
        AT_ONCE,
        "a is in the lane of b, so there is no gap to keep",
    ),
    (
        lambda s: s.a.change_time_gap(target=2.0, direction="right", reference=s.b),
        "a.change_time_gap",
        AT_ONCE,
        "it is not to the right of b",
    ),
    (
        lambda s: s.a.disconnect_trailer(),
        "a.disconnect_trailer",
        AT_ONCE,
        "a tows no trailer",
    ),
    (
        lambda s: s.a.drive(yaw(1.2), duration=2.0),
        "a.drive",
        AT_ONCE,
        "a follows its lane and can turn 28.6 degrees from it, not 68.8",
    ),
    (
        lambda s: s.a.change_speed(target=14.0, duration=(0.1, 0.3)),
        "a.change_speed",
        AT_ONCE,
        "a change from 10.0 to 14.0 m/s in 0.3 s requires more than 12 m/s^2",
    ),
]


@pytest.mark.parametrize(
    ("act", "node", "time", "why"), CASES, ids=[f"{c[1]}-{i}" for i, c in enumerate(CASES)]
)
def test_a_failure_says_what_where_when_and_why(
    run: Run, act: Callable[[Any], Behaviour], node: str, time: float, why: str
) -> None:
    class Failing(WithWalker):
        def behavior(self) -> Behaviour:
            return Serial("all", Wait(elapsed(1.0)), act(self))

    done = run(Failing)
    assert done.result.status == "failure"
    name, _, rest = done.result.reason.partition(" (two_cars.osc) ")
    assert name.startswith(f"{node}(")
    assert rest.startswith(f"failed at {time:.3f} s: ")
    assert why in done.result.reason
    (line,) = done.actions(node.replace(".", " "), "fail")
    assert line["t"] == pytest.approx(time)
    assert line["reason"] in done.result.reason


@pytest.mark.parametrize(
    ("act", "why"),
    [
        (lambda s: s.a.change_lane(side="left"), "is not on a road, so it has no lane"),
        (lambda s: s.a.follow_lane(duration=2.0), "is not on a road, so it has no lane"),
        (lambda s: s.a.drive(lane(2), duration=2.0), "is not on a road, so it has no lane"),
        (lambda s: s.a.drive(lateral(0.5), duration=2.0), "is not on a road, so it has no lane"),
        (
            lambda s: s.a.change_space_gap(target=9.0, direction="behind", reference=s.b),
            "there is no route along lanes to b",
        ),
        (
            lambda s: s.a.drive(speed(0.3, direction="lateral"), duration=2.0),
            "cannot change or follow one",
        ),
    ],
)
def test_who_has_left_the_road_has_no_lane(
    run: Run, act: Callable[[TwoCars], Behaviour], why: str
) -> None:
    def body(s: TwoCars) -> Behaviour:
        return Serial("all", s.a.follow_path(absolute=OFF_ROAD), act(s))

    done = run(scenario(body))
    assert done.actions("a follow_path", "end")
    assert done.result.status == "failure"
    assert why in done.result.reason


@pytest.mark.parametrize(
    ("modifiers", "why"),
    [
        (lambda s: [position(30.0, behind=s.b)], "there is no route along lanes to b"),
        (lambda s: [lane(same_as=s.b)], "lane -5 of road 1 is not a driving lane"),
        (lambda s: [lateral(3.0, side_of=s.b)], "there is no route along lanes to b"),
        (
            lambda s: [speed(5.0), position(2.0, behind=s.b, at="end")],
            "there is no route along lanes to b",
        ),
    ],
)
def test_a_reference_that_leaves_the_road(
    run: Run, modifiers: Callable[[TwoCars], list[Any]], why: str
) -> None:
    far = Path(tuple(Pose(p.x + 40.0, p.y - 200.0 * (i == 3)) for i, p in enumerate(BEND)))

    def body(s: TwoCars) -> Behaviour:
        given = modifiers(s)
        time = None if len(given) > 1 else 40.0
        act = s.a.drive(*given, duration=time)
        return Parallel("both", act, s.b.follow_path(absolute=far))

    done = run(scenario(body))
    assert done.result.reason.startswith("a.drive(*given, duration=time) (two_cars.osc) failed at ")
    assert why in done.result.reason


def test_the_end_of_the_lane(run: Run) -> None:
    class End(TwoCars):
        def placement(self) -> None:
            self.place(self.a, lane(2), speed(10.0))
            self.place(self.b, lane(1))

        def behavior(self) -> Behaviour:
            return self.a.drive(speed(10.0), keep_lane(), duration=20.0)

    done = run(End, spawn={"a": ("1", -3, 1980.0)})
    assert "a has reached the end of lane -3 of road 1" in done.result.reason
