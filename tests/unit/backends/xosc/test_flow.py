"""Flows: an OR of ANDs, and what can be asked of them."""

from osc2tx.backends.xosc.conditions.flow import NEVER, Flow, at_time, run_start, single, state_of
from osc2tx.backends.xosc.conditions.flow import Test as Condition
from osc2tx.backends.xosc.xml.tree import element

A, B = single(state_of("event", "a")), single(state_of("event", "b"))
EDGE = single(Condition(element("ByEntityCondition"), "rising"))


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
