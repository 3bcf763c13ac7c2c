"""Flows: an OR of ANDs, and what can be asked of them."""

from dataclasses import replace
from pathlib import Path

import pytest
from lxml import etree

from osc2tx.backends.xosc.conditions.flow import NEVER, Flow, at_time, run_start, single, state_of
from osc2tx.backends.xosc.conditions.flow import Test as Condition
from osc2tx.options import XmlOptions
from osc2tx.xosc import elements as xml
from tests.unit.backends.xosc.documents import compiled, documents

A, B = single(state_of("event", "a")), single(state_of("event", "b"))
EDGE = single(Condition(xml.ByEntityCondition(), "rising"))


def names(flow: Flow) -> list[list[str | None]]:
    return [
        [test.condition.children[0].get("storyboardElementRef") for test in group]
        for group in flow.groups
    ]


def test_and_distributes_over_or() -> None:
    c = single(state_of("event", "c"))
    assert names((A | B) & c) == [["a", "c"], ["b", "c"]]
    assert names(A & A) == [["a"]]
    assert names(A | A) == [["a"]]


def test_never_is_zero_of_or_and_takes_all_with_and() -> None:
    assert A | NEVER == A
    assert (A & NEVER).is_never


def test_only_states_and_times_are_latched() -> None:
    assert (A & B | single(at_time(3.0))).is_latched
    assert not (A & EDGE).is_latched
    assert NEVER.is_latched


def test_later_delays_states_and_moves_times() -> None:
    assert [test.delay for test in (A & B).later(2.0).later(1.0).groups[0]] == [3.0, 3.0]
    (moved,) = single(run_start()).later(2.0).groups[0]
    assert (moved.reached, moved.delay) == (2.0, 0.0)
    assert moved.condition.children[0].get("rule") == "greaterOrEqual"
    assert run_start().condition.children[0].get("rule") == "greaterThan"


def test_of_several_times_the_last_one_counts() -> None:
    both = single(at_time(2.0)) & single(at_time(5.0)) & A
    assert [test.reached for test in both.groups[0]] == [5.0, None]


# --- what follows from other tests is not said ---


def ends(name: str, start: Flow, length: float = 0.0) -> Flow:
    """Return when an event is complete that starts with a flow and takes so long."""
    return single(replace(state_of("event", name), follows=start.followed_after(length)))


@pytest.mark.parametrize(("length", "expected"), [(4.0, ["b"]), (2.0, ["b"]), (1.5, ["b", "a"])])
def test_an_event_that_lasts_long_enough_says_it_all(length: float, expected: list[str]) -> None:
    """`b` takes its time from the end of `a` on; beside it two seconds have to pass."""
    assert names(ends("b", A, length) & A.later(2.0)) == [expected]


def test_what_lies_between_adds_up() -> None:
    b = ends("b", A.later(1.0), 2.0)
    c = ends("c", b.later(3.0), 4.0)
    assert names(c & A.later(10.0)) == [["c"]]
    assert names(c & A.later(10.5)) == [["c", "a"]]
    assert names(c & b.later(7.0)) == [["c"]]
    assert names(c & single(at_time(1.0)) & ends("d", single(at_time(1.0)))) == [["c", "d"]]


@pytest.mark.parametrize(("seconds", "expected"), [(6.0, True), (7.0, False), (7.5, False)])
def test_what_surely_comes_later(seconds: float, expected: bool) -> None:
    """`b` takes 5 s and starts 2 s after the act; at 7 s both come true."""
    act = single(state_of("act", "act", "runningState"))
    b = ends("b", act.later(2.0), 5.0)
    assert b.is_surely_after(act.later(seconds)) is expected
    assert not (b | A).is_surely_after(act.later(seconds))
    assert not b.is_surely_after(act.later(seconds) | A)
    assert not b.is_surely_after(act.later(seconds) & A)


def test_nothing_follows_from_alternatives() -> None:
    assert names(ends("c", A | B, 4.0) & A) == [["c", "a"]]


MEMBERS = """import osc.standard.all

namespace null use std, stdtypes

scenario members:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    length: time{length}

    do serial:
        first: ego.change_lane(side: left, duration: 2s) with:
            lane(2, at: start)
            position(50m, at: start)
            speed(15mps, at: start)
        parallel:
            ego.change_lane(side: right, duration: length){until}
            wait elapsed(3s)
        second: ego.change_lane(side: left, duration: 2s)
"""


@pytest.mark.parametrize(
    ("length", "until", "waits"),
    [
        (" = 4s", "", False),
        (" = 2s", "", True),
        (" = 4s", " with:\n                until rise(ego.speed > 90kph)", True),
        (" with:\n        keep(it in [4s..5s])", "", True),
    ],
)
def test_only_a_length_that_is_sure_counts(
    tmp_path: Path, length: str, until: str, waits: bool
) -> None:
    """What may be cut short is not, nor what a run may choose."""
    path = tmp_path / "members.osc"
    path.write_text(MEMBERS.format(length=length, until=until), encoding="utf-8")
    (made,) = documents(compiled(path), XmlOptions(version="1.3", allow_approx=True))
    assert made.xml is not None, made.report.summary()
    document = etree.fromstring(made.xml.encode())
    (event,) = document.iterfind(".//Event[@name='second']")
    delays = [
        condition.get("delay")
        for condition in event.iter("Condition")
        if condition.find(".//StoryboardElementStateCondition[@storyboardElementRef='first']")
        is not None
    ]
    assert delays == (["3"] if waits else [])
