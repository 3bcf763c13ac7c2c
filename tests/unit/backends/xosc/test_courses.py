"""Courses of the speed that the XML draws, against their closed forms."""

import math
from itertools import pairwise
from math import pi, sqrt

import pytest

from osc2tx.backends.xosc.actions.position.position_actions import arrival
from osc2tx.backends.xosc.actions.speed.acceleration import ramp
from osc2tx.backends.xosc.actions.speed.courses import Computed, points_for, through_points
from osc2tx.backends.xosc.facts.actors import Cosine, Linear, Quintic, SCurve, steepest
from osc2tx.backends.xosc.facts.curves import Line, Waypoint, sample_curve
from osc2tx.losses.entries import Inexpressible
from osc2tx.xosc import elements as xml
from osc2tx.xosc.arithmetic import evaluated
from osc2tx.xosc.expressions import Symbol


def way(course: Computed, pieces: int = 1000) -> float:
    """Return the way (m) by the midpoint rule."""
    step = course.duration / pieces
    return sum(course.value((index + 0.5) * step) * step for index in range(pieces))


@pytest.mark.parametrize("time", [0.5, 1.0, 2.0, 3.5])
def test_an_acceleration_that_builds_up(time: float) -> None:
    course = ramp(10.0, Linear(0.0, 1.5, 2.0), 3.5)  # jerk 0.75 m/s^3 for 2 s, then 1.5 m/s^2
    expected = 10.0 + 0.375 * time**2 if time <= 2.0 else 11.5 + 1.5 * (time - 2.0)
    assert course.value(time) == pytest.approx(expected, abs=1e-9)


def test_a_smooth_change_of_the_acceleration_has_the_mean_of_both() -> None:
    course = ramp(10.0, Quintic(-1.0, 2.0, 4.0), 4.0)
    assert course.value(4.0) == pytest.approx(12.0, abs=1e-6)


def test_who_brakes_comes_to_a_stand() -> None:
    assert ramp(1.0, Linear(-2.0, -2.0, 1.0), 1.0).value(1.0) == 0.0


@pytest.mark.parametrize("missing", [-20.0, 30.0])
def test_who_has_to_arrive_covers_the_way(missing: float) -> None:
    course = arrival(15.0, missing, 6.0)
    assert way(course) == pytest.approx(90.0 + missing, abs=1e-4)
    assert course.value(6.0) == pytest.approx(15.0 + 1.5 * missing / 6.0)


@pytest.mark.parametrize(
    ("missing", "duration"), [(30.0, 6.0), (30.0, 3.0), (-60.0, 9.0), (3.0, 6.0)]
)
def test_a_course_has_as_many_points_as_its_bend_asks_for(missing: float, duration: float) -> None:
    """Straight stretches of a parabola are off by T^3 |v''| / (12 n^2), and |v''| is 3 m / T^3."""
    course = arrival(15.0, missing, duration)
    count = points_for(course)
    fewest = next(n for n in range(4, 48) if abs(missing) / (4.0 * n**2) <= 0.03)
    steps = {n: duration / n / 0.05 for n in range(fewest, 2 * fewest + 1)}
    in_steps = [n for n, each in steps.items() if math.isclose(each, round(each))]
    assert count == (in_steps[0] if in_steps else fewest)
    assert len(list(through_points(course, count).below(xml.SpeedProfileEntry))) == count


def test_points_on_a_straight_line_are_left_out() -> None:
    """esmini joins such entries, and never ends while it has fewer than there were."""
    course = ramp(10.0, Linear(0.0, -2.0, 1.0), 4.0)  # jerk for 1 s, then -2 m/s^2 for 3 s
    entries = list(through_points(course, 8).below(xml.SpeedProfileEntry))
    assert [(each.time, each.speed) for each in entries] == [(0.5, 9.75), (0.5, 9.0), (3.0, 3.0)]


POINTS = (
    Waypoint(0.0, 0.0, 0.0, 0.0),
    Waypoint(2.0, 30.0, 0.0, 0.0),
    Waypoint(5.0, 30.0, 40.0, 0.0),
)


def test_offsets_cut_a_path() -> None:
    line = sample_curve(Line(POINTS, offsets=(10.0, 15.0)))
    assert [(p.x, p.y) for p in line] == [(10.0, 0.0), (30.0, 0.0), (30.0, 25.0)]
    assert {p.h for p in line} == {None}  # at a corner the way has two headings


def test_times_of_a_trajectory_stay() -> None:
    line = sample_curve(Line(POINTS, is_timed=True))
    assert [p.time for p in line] == [0.0, 2.0, 5.0]


def test_a_smooth_path_goes_through_its_points() -> None:
    line = sample_curve(Line(POINTS, is_smooth=True))
    assert len(line) > 20
    assert min((p.x - 30.0) ** 2 + p.y**2 for p in line) < 1e-12
    assert all(p.h is not None for p in line)


def test_offsets_that_leave_nothing_are_refused() -> None:
    with pytest.raises(Inexpressible, match="leave nothing"):
        sample_curve(Line(POINTS, offsets=(40.0, 40.0)))


@pytest.mark.parametrize("kind", [Linear, Cosine, Quintic])
@pytest.mark.parametrize(("start", "end"), [(10.0, 25.0), (25.0, 10.0), (0.0, -3.0)])
def test_the_steepest_of_a_course_is_that_of_its_differences(
    kind: type[Linear | Cosine | Quintic], start: float, end: float
) -> None:
    course, pieces = kind(start, end, 7.0), 20_000
    step = course.duration / pieces
    speeds = [abs(course.value(index * step)) for index in range(pieces + 1)]
    rates = [(after - before) / step for before, after in pairwise(speeds)]
    expected = (max(*rates, 0.0), max(-min(rates), 0.0))
    assert steepest(course) == pytest.approx(expected, abs=1e-4)


def test_the_steepest_of_a_course_to_an_open_speed_is_an_expression() -> None:
    course = Cosine(10.0, Symbol(30.0, "$v"), 5.0)
    faster, slower = steepest(course)
    assert float(faster) == pytest.approx(0.5 * pi * 20.0 / 5.0)
    assert isinstance(faster, Symbol)
    assert evaluated(faster.attribute, {"v": 40.0}) == pytest.approx(0.5 * pi * 30.0 / 5.0)
    assert slower == 0.0


@pytest.mark.parametrize(
    ("course", "expected"),
    [
        (SCurve(10.0, 25.0, 4.0, 10.0), (4.0, 0.0)),
        (SCurve(25.0, 10.0, 4.0, 10.0), (0.0, 4.0)),
        (SCurve(10.0, 11.0, 4.0, 10.0), (sqrt(10.0), 0.0)),  # too short for the limit
        (SCurve(10.0, 25.0, 4.0, 10.0, 6.0), (6.0, 0.0)),
        (SCurve(10.0, 25.0, 4.0, 10.0, -3.0), (4.0, 3.0)),
    ],
)
def test_the_steepest_of_a_limited_course_is_its_limit_or_its_start(
    course: SCurve, expected: tuple[float, float]
) -> None:
    assert steepest(course) == pytest.approx(expected, abs=1e-6)
