"""Starts of actors as the behaviors of the library."""

import math

import pytest

from osc2tx.importing.statements import Statement, When, call, composed, elapsed, wait
from osc2tx.importing.wording import with_starts

POINT = 'road.create_odr_point("1", "-1", 10m, 0m)'


def starts(actor: str, point: str = POINT) -> list[Statement]:
    put = call(actor, "assign_position", odr_point=point)
    return [
        Statement(put, length=0.0),
        Statement(call(actor, "assign_speed", "10mps"), length=0.0),
    ]


def keeps(actor: str) -> Statement:
    return Statement(call(actor, "keep_speed"), length=math.inf)


def told(*members: Statement) -> list[str]:
    return list(with_starts(composed("serial", list(members))).lines(0))


def test_a_single_actor_cruises_for_the_time_of_a_scenario() -> None:
    assert told(*starts("ego"), wait(elapsed("5s"))) == [
        f"ego.cruise({POINT}, 10mps, duration: 5s)"
    ]


def test_several_actors_cruise_together() -> None:
    assert told(*starts("ego"), *starts("other"), wait(elapsed("5s"))) == [
        "parallel(duration: 5s):",
        f"    ego.cruise({POINT}, 10mps)",
        f"    other.cruise({POINT}, 10mps)",
    ]


def test_what_follows_a_time_follows_the_cruise() -> None:
    brake = Statement(call("ego", "change_speed", target="0mps"))
    assert told(*starts("ego"), wait(elapsed("5s")), brake) == [
        "serial:",
        f"    ego.cruise({POINT}, 10mps, duration: 5s)",
        "    ego.change_speed(target: 0mps)",
    ]


def test_actors_beside_others_cruise() -> None:
    late = composed("serial", [wait(elapsed("2s")), wait(When("rise(ego.speed < 5mps)"))])
    course = Statement("parallel", members=[keeps("ego"), late], until=[elapsed("9s")])
    assert told(*starts("ego"), *starts("other"), course) == [
        "serial:",
        f"    other.begin({POINT}, 10mps)",
        "    parallel:",
        f"        ego.cruise({POINT}, 10mps)",
        "        serial:",
        "            wait elapsed(2s)",
        "            wait rise(ego.speed < 5mps)",
        "    with:",
        "        until elapsed(9s)",
    ]


SEEN = When("rise(ego.speed > 5mps)")


@pytest.mark.parametrize(
    "course",
    [
        Statement("parallel", members=[keeps("ego"), wait(SEEN)]),
        Statement("parallel", members=[keeps("ego"), keeps("other")], until=[SEEN]),
        Statement("parallel", members=[keeps("ego"), Statement(call("ego", "change_lane"))]),
    ],
)
def test_an_actor_that_is_looked_at_or_does_more_at_once_begins(course: Statement) -> None:
    assert f"    ego.begin({POINT}, 10mps)" in told(*starts("ego"), course)


def test_an_actor_beside_which_another_one_is_put_begins() -> None:
    beside = Statement(
        call("other", "assign_position"), modifiers=["lane(same_as: ego)"], length=0.0
    )
    assert f"    ego.begin({POINT}, 10mps)" in told(*starts("ego"), beside, wait(elapsed("5s")))


def test_starts_that_are_too_long_for_a_line_stay_apart() -> None:
    long = POINT.replace("10m", "s_of_the_start + time_of_the_start * speed_of_the_start")
    assert [each.strip() for each in told(*starts("ego", long), wait(elapsed("5s")))][1:3] == [
        f"ego.assign_position(odr_point: {long})",
        "ego.assign_speed(10mps)",
    ]


def test_an_actor_at_rest_is_only_put_there() -> None:
    assert told(starts("ego")[0], wait(elapsed("5s")))[1:2] == [
        f"    ego.assign_position(odr_point: {POINT})"
    ]
